// What the geometry costs: the energy of a hexahedron, a region relaxed, a closest point, a trial's
// distance.
#include <filesystem>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "io/hex_mesh_io.h"
#include "optimize/hausdorff.h"
#include "optimize/local_parametrization.h"
#include "optimize/relaxation.h"
#include "optimize/surface_distance.h"
#include "ovm/generators.h"
#include "ovm/neighborhood.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

/// toy2 (14,288 hexahedra) where the shared data is at hand, else a mesh made in code.
const HexMesh& sample_mesh() {
  static const HexMesh mesh = [] {
    const std::filesystem::path path = HEXWEFT_SHARED_DATA "/octree/toy2.vtk";
    return std::filesystem::exists(path) ? read_hex_mesh(path)
                                         : make_octree_like(Shape::double_torus, 40);
  }();
  return mesh;
}

/// About n cells round the middle one.
std::vector<CellHandle> ball_of_cells(const HexMesh& mesh, std::size_t n) {
  const CellHandle seed[1] = {CellHandle(mesh.cell_slots() / 2)};
  std::vector<CellHandle> cells;
  for (int rings = 0; cells.size() < n && rings < 100; ++rings)
    cells = grow_cells(mesh, seed, rings);
  if (cells.size() > n) cells.resize(n);
  return cells;
}

RelaxationProblem make_problem(const HexMesh& mesh, const ReferenceSurface& reference,
                               std::size_t n) {
  const Region region = make_region(mesh, ball_of_cells(mesh, n));
  RelaxationProblem problem;
  problem.points = region.points;
  problem.n_free = region.n_free;
  problem.hexes = region.hexes;
  problem.targets = target_cuboids(region, {.blend_passes = 0});
  SurfaceConstraint constraint(region, reference);
  constraint.pulls(region.points, constraint.goals(region), 1e3, problem.pulls);
  return problem;
}

void energy(benchmark::State& state, const Energy& kind, InstructionSet set) {
  const RelaxationProblem p =
      make_problem(sample_mesh(), make_reference_surface(sample_mesh()), 8000);
  Eigen::Matrix3Xd gradient(3, p.points.cols());
  for (auto _ : state) {
    gradient.setZero();
    benchmark::DoNotOptimize(hex_energy(kind, p.points, p.hexes, p.targets, &gradient, set));
  }
  state.counters["per_hex"] = benchmark::Counter(
      static_cast<double>(p.hexes.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(energy, symmetric_dirichlet, SymmetricDirichlet{}, InstructionSet::automatic);
BENCHMARK_CAPTURE(energy, symmetric_dirichlet_portable, SymmetricDirichlet{},
                  InstructionSet::portable);
BENCHMARK_CAPTURE(energy, foldover_free, FoldoverFree{}, InstructionSet::automatic);

/// Until 99 % of the reachable drop of the energy is done, from the mesh as it is.
void relax_to_99_percent(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const RelaxationProblem start =
      make_problem(sample_mesh(), make_reference_surface(sample_mesh()), n);
  RelaxationProblem p = start;
  const RelaxationReport best =
      relax(p, SymmetricDirichlet{},
            {.max_iterations = 500, .iterations_per_restart = 20, .tolerance_rel = 1e-8});
  const double goal = best.initial_energy - 0.99 * (best.initial_energy - best.final_energy);
  RelaxationOptions options{.iterations_per_restart = 20, .tolerance_rel = 1e-8};
  for (options.max_iterations = 1;; ++options.max_iterations) {
    p = start;
    if (relax(p, SymmetricDirichlet{}, options).final_energy <= goal) break;
  }
  for (auto _ : state) {
    p = start;
    benchmark::DoNotOptimize(relax(p, SymmetricDirichlet{}, options));
  }
  state.counters["iterations"] = options.max_iterations;
}
BENCHMARK(relax_to_99_percent)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);

void parametrize_region(benchmark::State& state) {
  HexMesh mesh = sample_mesh();
  const ReferenceSurface reference = make_reference_surface(mesh);
  const auto cells = ball_of_cells(mesh, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    Transaction trial(mesh);
    benchmark::DoNotOptimize(parametrize(mesh, cells, reference));
  }
}
BENCHMARK(parametrize_region)->Arg(500)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);

void closest_point_query(benchmark::State& state) {
  const ReferenceSurface surface = make_reference_surface(sample_mesh());
  std::mt19937 random(1);
  std::vector<Eigen::Vector3d> queries;
  const double step = 0.005 * surface.bounding_box_diagonal() / std::mt19937::max();
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d p = surface.points().col(random() % surface.points().cols());
    const double x = step * random(), y = step * random();
    queries.push_back(p + Eigen::Vector3d(x, y, step * random()));
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(surface.closest(queries[i++ % queries.size()]));
}
BENCHMARK(closest_point_query);

/// A twentieth of the surface moves by a thousandth of the diagonal.
void distance_of_a_trial(benchmark::State& state) {
  HexMesh mesh = sample_mesh();
  SurfaceDistance distance(mesh, make_reference_surface(mesh));
  const double size = distance.reference().bounding_box_diagonal();
  std::vector<VertexHandle> boundary;
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.is_boundary(v)) boundary.push_back(v);
  }
  const Eigen::Vector3d centre = mesh.point(boundary[boundary.size() / 2]);
  std::sort(boundary.begin(), boundary.end(), [&](VertexHandle a, VertexHandle b) {
    return (mesh.point(a) - centre).norm() < (mesh.point(b) - centre).norm();
  });
  boundary.resize(boundary.size() / 20);
  for (auto _ : state) {
    Transaction trial(mesh);
    for (VertexHandle v : boundary) {
      mesh.set_point(v, mesh.point(v) + 1e-3 * size * Eigen::Vector3d::Ones());
    }
    benchmark::DoNotOptimize(distance.after_change(mesh, 0.01 * size));
    distance.rollback();
  }
}
BENCHMARK(distance_of_a_trial)->Unit(benchmark::kMillisecond);

void hausdorff_at_full_sampling(benchmark::State& state) {
  HexMesh mesh = sample_mesh();
  const ReferenceSurface reference = make_reference_surface(mesh);
  std::vector<CellHandle> cells = ball_of_cells(mesh, static_cast<std::size_t>(mesh.n_cells()));
  parametrize(mesh, cells, reference);
  for (auto _ : state) benchmark::DoNotOptimize(hausdorff_distance(mesh, reference));
}
BENCHMARK(hausdorff_at_full_sampling)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hexweft

BENCHMARK_MAIN();
