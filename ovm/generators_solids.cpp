#include "ovm/generators_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "ovm/errors.h"

namespace hexweft {
namespace {

using Eigen::AlignedBox3d;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

AlignedBox3d box_of(const Vector3d& half) { return {Vector3d(-half), half}; }

Quaterniond quarter_turn(const Vector3d& axis) { return Quaterniond(AngleAxisd(kPi / 2, axis)); }

// ---- Samples ----

Solid plate_with_12_holes() { return plate_with_holes(12); }

Solid oblique_box() { return turned(box_solid({0.9, 0.6, 0.45}), random_rotation(1)); }

// A box with a slanted end of 35 degrees.
Solid wedge() {
  const double angle = 35 * kPi / 180;
  const Vector3d normal(std::sin(angle), 0, std::cos(angle));
  const Solid half_space{[=](const Vector3d& p) { return normal.dot(p); }, box_of({2, 2, 2})};
  return intersect(box_solid({1, 0.6, 0.6}), half_space);
}

// Two plates at a right angle with a rib between them, two holes in each.
Solid bracket() {
  Solid s = unite(moved(box_solid({1, 0.6, 0.18}), {0, 0, -0.6}),
                  moved(box_solid({0.18, 0.6, 0.78}), {-0.82, 0, 0}));
  const Solid half_space{
      [](const Vector3d& p) { return Vector3d(1, 0, 1).normalized().dot(p) + 0.42; },
      box_of({2, 2, 2})};
  const Solid rib = intersect(moved(box_solid({0.6, 0.13, 0.6}), {-0.4, 0, -0.1}), half_space);
  s = unite(s, rib);
  const Solid bore = cylinder_solid(0.17, 0.5);
  for (double y : {-0.35, 0.35}) {
    s = subtract(s, moved(bore, {0.55, y, -0.6}));
    s = subtract(s, moved(turned(bore, quarter_turn(Vector3d::UnitY())), {-0.82, y, 0.35}));
  }
  return s;
}

Solid bored_cylinder() { return subtract(cylinder_solid(0.8, 0.9), cylinder_solid(0.35, 2)); }

// Two pipes that cross, open inside: the wall is a ball with handles.
Solid pipe_cross() {
  const auto both = [](double radius, double half_length) {
    const Solid along_z = cylinder_solid(radius, half_length);
    return unite(turned(along_z, quarter_turn(Vector3d::UnitX())),
                 turned(along_z, quarter_turn(Vector3d::UnitY())));
  };
  return subtract(both(0.45, 1), both(0.22, 2));
}

Solid stepped_shaft() {
  Solid s = unite(cylinder_solid(0.25, 1), moved(cylinder_solid(0.5, 0.3), {0, 0, -0.3}));
  s = unite(s, moved(cylinder_solid(0.7, 0.12), {0, 0, 0.12}));
  return turned(s, quarter_turn(Vector3d::UnitY()));
}

// Eight rounded teeth and a bore.
Solid gear() {
  const Solid teeth{[](const Vector3d& p) {
                      const double angle = std::atan2(p.y(), p.x());
                      const double radius = 0.8 + 0.16 * std::cos(8 * angle);
                      // The flanks are steep: without the factor far from a distance.
                      return 0.6 * (std::hypot(p.x(), p.y()) - radius);
                    },
                    box_of({1, 1, 1})};
  const Solid disk = intersect(teeth, box_solid({1, 1, 0.25}));
  return subtract(disk, cylinder_solid(0.3, 1));
}

// A cap of a spherical shell.
Solid thin_cap() {
  const double radius = 1.4, half_thickness = 0.05;
  const Solid shell =
      subtract(ball_solid(radius + half_thickness), ball_solid(radius - half_thickness));
  Solid cap = intersect(moved(shell, {0, 0, -1.2}), box_solid({0.9, 0.7, 0.5}));
  cap.box = AlignedBox3d(Vector3d(-0.9, -0.7, -0.5), Vector3d(0.9, 0.7, 0.25));
  return cap;
}

Solid thin_plate() { return box_solid({1, 0.7, 0.055}); }

// A tube along a closed polygon of points.
Solid tube(const std::vector<Vector3d>& points, double radius) {
  AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  box.min().array() -= radius;
  box.max().array() += radius;
  const auto distance = [points, radius](const Vector3d& p) {
    double least = 1e300;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d& a = points[i];
      const Vector3d ab = points[(i + 1) % points.size()] - a;
      const double t = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (a + t * ab - p).squaredNorm());
    }
    return std::sqrt(least) - radius;
  };
  return {distance, box, false};
}

Solid trefoil() {
  constexpr int n = 72;
  std::vector<Vector3d> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * kPi * i / n;
    points.push_back(0.3 * Vector3d(std::sin(t) + 2 * std::sin(2 * t),
                                    std::cos(t) - 2 * std::cos(2 * t), -2 * std::sin(3 * t)));
  }
  return tube(points, 0.16);
}

Solid hollow_ball() {
  Solid s = subtract(ball_solid(1), ball_solid(0.45));
  s.sharp = false;
  return s;
}

Solid ball_in_shell() {
  Solid s = unite(subtract(ball_solid(1), ball_solid(0.68)), ball_solid(0.38));
  s.sharp = false;
  return s;
}

Solid linked_rings() {
  const Solid ring = ring_solid(0.6, 0.19);
  Solid s = unite(moved(ring, {-0.3, 0, 0}),
                  moved(turned(ring, quarter_turn(Vector3d::UnitX())), {0.3, 0, 0}));
  s.sharp = false;
  return s;
}

// Five pieces of different kinds and sizes.
Solid pieces() {
  Solid s = moved(ball_solid(0.4), {-0.6, -0.5, 0});
  s = unite(s, moved(box_solid({0.35, 0.3, 0.3}), {0.55, -0.55, 0}));
  s = unite(s, moved(ring_solid(0.3, 0.13), {-0.55, 0.5, 0}));
  s = unite(s, moved(turned(box_solid({0.25, 0.25, 0.2}), random_rotation(3)), {0.3, 0.45, 0}));
  return unite(s, moved(cylinder_solid(0.16, 0.4), {0.85, 0.3, 0}));
}

constexpr std::array kSamples{
    SampleSolid{"oblique-box", 1, 1, 0, 8, oblique_box},
    SampleSolid{"wedge", 1, 1, 0, 10, wedge},
    SampleSolid{"bracket", 1, 1, 4, 20, bracket},
    SampleSolid{"bored-cylinder", 1, 1, 1, 10, bored_cylinder},
    SampleSolid{"pipe-cross", 1, 1, 3, 20, pipe_cross},
    SampleSolid{"stepped-shaft", 1, 1, 0, 16, stepped_shaft},
    SampleSolid{"gear", 1, 1, 1, 20, gear},
    SampleSolid{"plate-with-holes", 1, 1, 12, 32, plate_with_12_holes},
    SampleSolid{"thin-plate", 1, 1, 0, 12, thin_plate},
    SampleSolid{"thin-cap", 1, 1, 0, 20, thin_cap},
    SampleSolid{"trefoil", 1, 1, 1, 24, trefoil},
    SampleSolid{"hollow-ball", 1, 2, -1, 10, hollow_ball},
    SampleSolid{"ball-in-shell", 2, 3, -1, 20, ball_in_shell},
    SampleSolid{"linked-rings", 2, 2, 2, 24, linked_rings},
    SampleSolid{"pieces", 5, 5, 1, 28, pieces},
};

}  // namespace

Solid box_solid(const Vector3d& half_sides) {
  const auto distance = [=](const Vector3d& p) {
    const Vector3d q = p.cwiseAbs() - half_sides;
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  return {distance, box_of(half_sides)};
}

Solid ball_solid(double radius) {
  return {[=](const Vector3d& p) { return p.norm() - radius; }, box_of(Vector3d::Constant(radius)),
          false};
}

Solid cylinder_solid(double radius, double half_height) {
  const auto distance = [=](const Vector3d& p) {
    return std::max(std::hypot(p.x(), p.y()) - radius, std::abs(p.z()) - half_height);
  };
  return {distance, box_of({radius, radius, half_height})};
}

Solid ring_solid(double major_radius, double minor_radius) {
  const auto distance = [=](const Vector3d& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - major_radius, p.z()) - minor_radius;
  };
  const double outer = major_radius + minor_radius;
  return {distance, box_of({outer, outer, minor_radius}), false};
}

Solid unite(const Solid& a, const Solid& b) {
  return {[=](const Vector3d& p) { return std::min(a.distance(p), b.distance(p)); },
          a.box.merged(b.box)};
}

Solid intersect(const Solid& a, const Solid& b) {
  return {[=](const Vector3d& p) { return std::max(a.distance(p), b.distance(p)); },
          a.box.intersection(b.box)};
}

Solid subtract(const Solid& a, const Solid& b) {
  return {[=](const Vector3d& p) { return std::max(a.distance(p), -b.distance(p)); }, a.box};
}

Solid moved(const Solid& solid, const Vector3d& by) {
  AlignedBox3d box = solid.box;
  box.translate(by);
  return {[=](const Vector3d& p) { return solid.distance(p - by); }, box, solid.sharp};
}

Solid turned(const Solid& solid, const Quaterniond& rotation) {
  const Eigen::Matrix3d back = rotation.conjugate().toRotationMatrix();
  AlignedBox3d box;
  for (int i = 0; i < 8; ++i) {
    box.extend(rotation * solid.box.corner(static_cast<AlignedBox3d::CornerType>(i)));
  }
  return {[=](const Vector3d& p) { return solid.distance(back * p); }, box, solid.sharp};
}

Quaterniond random_rotation(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  // Uniform over rotations: a random point of the sphere in four dimensions.
  const double a = unit(), b = 2 * kPi * unit(), c = 2 * kPi * unit();
  return {std::sqrt(1 - a) * std::sin(b), std::sqrt(1 - a) * std::cos(b),
          std::sqrt(a) * std::sin(c), std::sqrt(a) * std::cos(c)};
}

Solid plate_with_holes(int n) {
  if (n < 0) throw InputError("a plate needs a count of holes of at least 0");
  const int n_columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(1.5 * n))));
  const int n_rows = std::max(1, (n + n_columns - 1) / n_columns);
  const double pitch = 2.0 / n_columns;
  Solid s = box_solid({1, pitch * n_rows / 2, std::min(0.3, 0.3 * pitch)});
  for (int i = 0; i < n; ++i) {
    const int column = i % n_columns, row = i / n_columns;
    const Vector3d center(pitch * (column + 0.5) - 1, pitch * (row + 0.5 - 0.5 * n_rows), 0);
    s = subtract(s, moved(cylinder_solid(0.25 * pitch, 1), center));
  }
  return s;
}

std::span<const SampleSolid> sample_solids() { return kSamples; }

}  // namespace hexweft
