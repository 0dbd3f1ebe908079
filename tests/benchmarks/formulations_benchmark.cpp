// Seconds until 90 %, 99 % and 99.9 % of the energy's reachable drop, for every formulation on
// regions of growing size, in one process; building the problem counts. Prints a table. Seconds are
// the processor's, of all threads, so that other programs do not count.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/hex_mesh_io.h"
#include "optimize/region.h"
#include "optimize/relaxation.h"
#include "optimize/surface_constraint.h"
#include "optimize/target_shape.h"
#include "ovm/generators.h"
#include "ovm/neighborhood.h"

namespace hexweft {
namespace {

double seconds_of_processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
constexpr double kParts[] = {0.9, 0.99, 0.999};

/// toy2 (14,288 hexahedra) where the shared data is at hand, else a mesh made in code.
HexMesh sample_mesh() {
  const std::filesystem::path path = HEXWEFT_SHARED_DATA "/octree/toy2.vtk";
  return std::filesystem::exists(path) ? read_hex_mesh(path)
                                       : make_octree_like(Shape::double_torus, 40);
}

/// About n cells round the middle one, the rim fixed, the surface held on its tangent planes.
RelaxationProblem make_problem(const HexMesh& mesh, const ReferenceSurface& reference,
                               std::size_t n) {
  const CellHandle seed[1] = {CellHandle(mesh.cell_slots() / 2)};
  std::vector<CellHandle> cells;
  for (int rings = 0; cells.size() < n && rings < 100; ++rings) {
    cells = grow_cells(mesh, seed, rings);
  }
  if (cells.size() > n) cells.resize(n);
  const Region region = make_region(mesh, cells);
  RelaxationProblem problem;
  problem.points = region.points;
  problem.n_free = region.n_free;
  problem.hexes = region.hexes;
  problem.targets = target_cuboids(region, {.blend_passes = 0});
  SurfaceConstraint constraint(region, reference);
  constraint.pulls(region.points, constraint.goals(region), 1e3, problem.pulls);
  return problem;
}

/// Energies with the seconds it took to get there.
struct Course {
  double initial = 0;
  std::vector<std::pair<double, double>> steps;  // seconds, energy

  double least() const {
    double e = initial;
    for (const auto& s : steps) e = std::min(e, s.second);
    return e;
  }
  double seconds_to(double energy) const {
    for (const auto& [seconds, e] : steps) {
      if (e <= energy) return seconds;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

Course run(const RelaxationProblem& start, const Energy& energy, RelaxationOptions options) {
  RelaxationProblem problem = start;
  Course course;
  const double begin = seconds_of_processor();
  options.observer = [&](const RelaxationProgress& p) {
    course.steps.emplace_back(seconds_of_processor() - begin, p.energy);
  };
  course.initial = relax(problem, energy, options).initial_energy;
  return course;
}

RelaxationOptions options_of(Formulation formulation) {
  RelaxationOptions options;
  options.formulation = formulation;
  options.max_iterations = formulation == Formulation::residual_blocks ? 30 : 150;
  options.iterations_per_restart = 20;
  options.tolerance_rel = 1e-7;
  return options;
}

int bench(const Energy& energy, const std::vector<std::size_t>& sizes) {
  const HexMesh mesh = sample_mesh();
  const ReferenceSurface reference = make_reference_surface(mesh);
  std::printf("%s, seconds to 90, 99 and 99.9 %% of the drop\n",
              std::string(energy.name()).c_str());
  for (const std::size_t n : sizes) {
    const RelaxationProblem problem = make_problem(mesh, reference, n);
    std::map<Formulation, Course> courses;
    for (const Formulation f :
         {Formulation::lbfgs, Formulation::slim_by_edges, Formulation::residual_blocks}) {
      courses[f] = run(problem, energy, options_of(f));
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [f, course] : courses) least = std::min(least, course.least());
    std::printf("%zu hexahedra, %d free vertices, excess energy a hexahedron %.6g to %.6g\n",
                problem.hexes.size(), problem.n_free, courses.begin()->second.initial, least);
    const Course& yardstick = courses[Formulation::residual_blocks];
    for (const auto& [f, course] : courses) {
      std::printf("  %-16s", std::string(name(f)).c_str());
      for (const double part : kParts) {
        const double goal = course.initial - part * (course.initial - least);
        const double seconds = course.seconds_to(goal);
        std::printf("  %8.4f (x %6.1f)", seconds, yardstick.seconds_to(goal) / seconds);
      }
      std::printf("  least %.6g in %zu steps\n", course.least(), course.steps.size());
    }
  }
  return 0;
}

}  // namespace
}  // namespace hexweft

/// Arguments: an energy's name (symmetric-dirichlet unless given), then numbers of hexahedra.
/// Options, as of the other benchmarks, are passed over.
int main(int argc, char** argv) {
  std::string energy = "symmetric-dirichlet";
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("-")) continue;
    const std::size_t size = std::strtoul(argv[i], nullptr, 10);
    if (size > 0) {
      sizes.push_back(size);
    } else {
      energy = argument;
    }
  }
  if (sizes.empty()) sizes = {2000, 8000, 14000};
  return hexweft::bench(hexweft::make_energy(energy), sizes);
}
