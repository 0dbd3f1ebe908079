// Times of the kernel on a grid of 500,000 cells and, where it is there, on a real mesh of 25,347.
#include <filesystem>
#include <fstream>
#include <vector>

#include <benchmark/benchmark.h>

#include "ovm/dual.h"
#include "ovm/generators.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

// Points and hexahedra of a legacy VTK file in ASCII; no mesh if there is no file.
HexMesh read_points_and_cells(const std::filesystem::path& path) {
  std::ifstream in(path);
  HexMesh mesh;
  std::string word;
  int n = 0, k = 0;
  while (in >> word && word != "CELL_TYPES") {
    if (word == "POINTS") {
      in >> n >> word;
      for (Eigen::Vector3d p; n > 0 && in >> p.x() >> p.y() >> p.z(); --n) mesh.add_vertex(p);
    } else if (word == "CELLS") {
      in >> n >> k;
      for (CellVertices c; n > 0 && in >> k; --n) {
        for (VertexHandle& v : c) in >> v.idx;
        mesh.add_cell(c);
      }
    }
  }
  return mesh;
}

const HexMesh& grid() {
  static const HexMesh mesh = make_grid({100, 100, 50});
  return mesh;
}
const HexMesh& bimba() {
  static const HexMesh mesh = read_points_and_cells(HEXWEFT_SHARED_DATA "/octree/bimba.vtk");
  return mesh;
}

using MeshGetter = const HexMesh& (*)();

bool skip_without_mesh(benchmark::State& state, const HexMesh& mesh) {
  if (mesh.n_cells() == 0) state.SkipWithError("the mesh is not there");
  return mesh.n_cells() == 0;
}

void build(benchmark::State& state, MeshGetter get) {
  const HexMesh& mesh = get();
  if (skip_without_mesh(state, mesh)) return;
  std::vector<CellVertices> cells;
  for (CellHandle c : mesh.cells()) cells.push_back(mesh.vertices(c));
  for (auto _ : state) {
    HexMesh built;
    built.reserve(mesh.n_vertices(), mesh.n_cells());
    for (VertexHandle v : mesh.vertices()) built.add_vertex(mesh.point(v));
    for (const CellVertices& c : cells) built.add_cell(c);
    benchmark::DoNotOptimize(built.n_faces());
  }
}

// Runs visit(mesh) and reports the time of one of n elements.
template <class Visit>
void per_element(benchmark::State& state, MeshGetter get, int n, Visit&& visit) {
  for (auto _ : state) benchmark::DoNotOptimize(visit(get()));
  using benchmark::Counter;
  state.counters["per_element"] = Counter(n, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void cell_neighbors(benchmark::State& state, MeshGetter get) {
  if (skip_without_mesh(state, get())) return;
  per_element(state, get, get().n_cells(), [](const HexMesh& mesh) {
    long sum = 0;
    for (CellHandle c : mesh.cells()) {
      for (CellHandle n : neighbors(mesh, c)) sum += n.idx;
    }
    return sum;
  });
}

void edge_cells(benchmark::State& state, MeshGetter get) {
  if (skip_without_mesh(state, get())) return;
  per_element(state, get, get().n_edges(), [](const HexMesh& mesh) {
    long sum = 0;
    for (EdgeHandle e : mesh.edges()) {
      for (CellHandle c : mesh.cells(e)) sum += c.idx;
    }
    return sum;
  });
}

void vertex_cells(benchmark::State& state, MeshGetter get) {
  if (skip_without_mesh(state, get())) return;
  per_element(state, get, get().n_vertices(), [](const HexMesh& mesh) {
    long sum = 0;
    for (VertexHandle v : mesh.vertices()) {
      for (CellHandle c : mesh.cells(v)) sum += c.idx;
    }
    return sum;
  });
}

// One whole-mesh operation a turn.
template <class Operation>
void whole(benchmark::State& state, MeshGetter get, Operation operation) {
  if (skip_without_mesh(state, get())) return;
  for (auto _ : state) benchmark::DoNotOptimize(operation(get()));
}

// Deletes the cells round some vertices and takes it back: the cost of a trial that fails.
void rollback(benchmark::State& state, MeshGetter get) {
  HexMesh mesh = get();
  if (skip_without_mesh(state, mesh)) return;
  for (auto _ : state) {
    Transaction trial(mesh);
    for (int i = 0; i < 100; ++i) {
      const VertexHandle v(mesh.vertex_slots() / 2 + 11 * i);
      const auto range = mesh.cells(v);
      for (CellHandle c : std::vector<CellHandle>(range.begin(), range.end())) mesh.delete_cell(c);
    }
  }
}

void register_all() {
  const std::pair<const char*, MeshGetter> meshes[] = {{"grid", grid}, {"bimba", bimba}};
  for (const auto& [name, get] : meshes) {
    const auto add = [&, mesh = get](const std::string& what, auto run) {
      benchmark::RegisterBenchmark((what + '/' + name).c_str(), run, mesh)
          ->Unit(benchmark::kMillisecond);
    };
    const auto add_whole = [&](const std::string& what, auto operation) {
      add(what, [operation](benchmark::State& s, MeshGetter g) { whole(s, g, operation); });
    };
    add("build", build);
    add("cell_neighbors", cell_neighbors);
    add("edge_cells", edge_cells);
    add("vertex_cells", vertex_cells);
    add_whole("dual_sheets", [](const HexMesh& m) { return extract_dual_sheets(m).n_sheets; });
    add_whole("dual_chords", [](const HexMesh& m) { return extract_dual_chords(m).n_chords; });
    add_whole("copy", [](const HexMesh& m) { return HexMesh(m).n_cells(); });
    add_whole("check_topology", [](const HexMesh& m) { return check_topology(m).size(); });
    add_whole("quality", [](const HexMesh& m) { return summarize_quality(m).n_inverted; });
    add("delete_and_rollback", rollback);
  }
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  hexweft::register_all();
  benchmark::RunSpecifiedBenchmarks();
}
