/// \file
/// The closest point of a triangle, in double precision.
#pragma once

#include <Eigen/Core>

namespace hexweft {

/// A point of a triangle and its barycentric coordinates.
struct TrianglePoint {
  Eigen::Vector3d point;
  Eigen::Vector3d weights;  ///< ≥ 0, sum 1
};

/// \param a, b, c  corners; the triangle may be degenerate
/// Finds the Voronoi region of p among corners, edges and face. Source [Ericson2005, §5.1.5].
inline TrianglePoint closest_point(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const auto at = [&](double u, double v, double w) -> TrianglePoint {
    return {u * a + v * b + w * c, {u, v, w}};
  };
  const auto ratio = [](double part, double whole) { return whole > 0 ? part / whole : 0; };
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return at(1, 0, 0);
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return at(0, 1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = ratio(d1, d1 - d3);
    return at(1 - t, t, 0);
  }
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return at(0, 0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = ratio(d2, d2 - d6);
    return at(1 - t, 0, t);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
    return at(0, 1 - t, t);
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return at(1, 0, 0);  // no area left
  return at(va / sum, vb / sum, vc / sum);
}

}  // namespace hexweft
