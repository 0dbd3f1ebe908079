// Quality and time of every distortion energy, in smoothing and in the simplification, on a mesh made
// in code and, where the shared data is at hand, on two of its meshes. Prints a Markdown table. Seconds
// are the processor's, of all threads, so that other programs do not count.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/hex_mesh_io.h"
#include "optimize/energies/table.h"
#include "optimize/smooth.h"
#include "ovm/generators.h"
#include "ovm/quality.h"
#include "simplify/simplify.h"

namespace hexweft {
namespace {

double seconds_of_processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Sample {
  std::string name;
  HexMesh mesh;
};

std::vector<Sample> samples() {
  std::vector<Sample> result;
  result.push_back({"blob", make_octree_like(Shape::blob, 16)});
  for (const char* name : {"dancer", "bone"}) {
    const auto path =
        std::filesystem::path(HEXWEFT_SHARED_DATA) / "octree" / (std::string(name) + ".vtk");
    if (std::filesystem::exists(path)) result.push_back({name, read_hex_mesh(path)});
  }
  return result;
}

void print_smoothing(HexMesh mesh, const Energy& energy) {
  const double begin = seconds_of_processor();
  const ReferenceSurface surface = make_reference_surface(mesh);
  SmoothingOptions options = {.hausdorff_limit_rel = 0.005};
  options.parametrization.energy = energy;
  const SmoothingReport r = smooth(mesh, surface, options);
  std::printf(" %.3f | %.3f | %.2f | %.1f |", r.min_scaled_jacobian, r.mean_scaled_jacobian,
              100 * r.hausdorff_rel, seconds_of_processor() - begin);
}

void print_simplification(HexMesh mesh, const Energy& energy) {
  const double begin = seconds_of_processor();
  SimplifyOptions options;
  options.parametrization.energy = energy;
  const SimplifyReport r = simplify(mesh, options);
  const double rate = 1 - static_cast<double>(r.after.components) / r.before.components;
  std::printf(" %d | %.4f | %.3f | %.3f | %.2f | %.1f |", r.after.components, rate,
              r.after.min_scaled_jacobian, r.after.mean_scaled_jacobian, 100 * r.hausdorff_ratio,
              seconds_of_processor() - begin);
}

void bench(const Sample& sample) {
  const QualitySummary q = summarize_quality(sample.mesh, 0);
  std::printf("\n%s: %d hexahedra, MSJ %.3f, ASJ %.3f\n\n", sample.name.c_str(),
              sample.mesh.n_cells(), q.min_scaled_jacobian, q.mean_scaled_jacobian);
  std::printf("| energy | MSJ | ASJ | HR %% | s | BC | R | MSJ | ASJ | HR %% | s |\n");
  std::printf("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Energy& energy : all_energies()) {
    std::printf("| %s |", std::string(energy.name()).c_str());
    print_smoothing(sample.mesh, energy);
    print_simplification(sample.mesh, energy);
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace hexweft

int main() {
  std::printf("Per energy: hexweft-optimize (4 columns), then hexweft-simplify (6 columns).\n");
  for (const hexweft::Sample& sample : hexweft::samples()) hexweft::bench(sample);
}
