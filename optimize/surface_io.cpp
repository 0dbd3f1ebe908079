#include "optimize/surface_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <system_error>

// The readers must be known before the mesh type.
#include <OpenMesh/Core/IO/MeshIO.hh>
// clang-format keeps this below the readers.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "optimize/triangle_mesh.h"
#include "ovm/errors.h"

namespace hexweft {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using PolygonMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

constexpr std::array<std::string_view, 4> kExtensions = {".obj", ".off", ".ply", ".stl"};

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem) {
  throw FormatError(path.string() + ": " + problem);
}

// OpenMesh takes its counts from the header unseen, and makes room for them. An ASCII OFF file has at
// least two characters a vertex and a face.
void check_off_header(std::istream& file, const std::filesystem::path& path, std::uintmax_t size) {
  std::string word;
  while (file >> word && word.front() == '#') std::getline(file, word);
  if (word.size() < 3 || word.compare(word.size() - 3, 3, "OFF") != 0) {
    fail(path, "starts with \"" + word.substr(0, 20) + "\", expected OFF");
  }
  std::vector<std::uintmax_t> counts;
  while (counts.size() < 2 && file >> word) {
    if (word == "BINARY") return;
    std::uintmax_t count = 0;
    if (word.front() == '#') {
      std::getline(file, word);
    } else if (std::from_chars(word.data(), word.data() + word.size(), count).ec == std::errc()) {
      counts.push_back(count);
    } else {
      break;
    }
  }
  if (counts.size() < 2 || counts[0] > size / 2 || counts[1] > size / 2) {
    fail(path, "has no counts of vertices and faces in its header that fit its size");
  }
}

// By its size, as the text of the header may begin like that of a text file.
bool is_binary_stl(std::istream& file, std::uintmax_t size) {
  constexpr std::uintmax_t kHeader = 84, kTriangle = 50;
  std::array<unsigned char, kHeader> header;
  if (!file.read(reinterpret_cast<char*>(header.data()), kHeader)) return false;
  std::uintmax_t n = 0;
  for (int i = 3; i >= 0; --i) n = n << 8 | header[80 + i];
  return size == kHeader + kTriangle * n;
}

PolygonMesh read_polygons(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  if (!file || std::filesystem::is_directory(path, error)) {
    const int reason = error ? error.value() : file ? EISDIR : errno;
    fail(path, "cannot be read: " + std::generic_category().message(reason));
  }
  const std::string extension = extension_of(path);
  PolygonMesh mesh;
  OpenMesh::IO::Options options;
  const SilentOpenMesh silent;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (extension == ".off") check_off_header(file, path, size);
  if (extension == ".stl" && is_binary_stl(file, size)) options += OpenMesh::IO::Options::Binary;
  file.clear();
  file.seekg(0);
  bool done = false;
  try {
    done = OpenMesh::IO::read_mesh(mesh, file, extension, options);
  } catch (const std::bad_alloc&) {  // counts that are none
  } catch (const std::length_error&) {
  }
  if (!done) fail(path, "is no surface in the format " + extension.substr(1));
  return mesh;
}

}  // namespace

std::span<const std::string_view> surface_extensions() { return kExtensions; }

bool is_surface_file(const std::filesystem::path& path) {
  return std::find(kExtensions.begin(), kExtensions.end(), extension_of(path)) != kExtensions.end();
}

ReferenceSurface read_surface(const std::filesystem::path& path, double feature_angle_deg,
                              const FeatureOptions& features) {
  if (!is_surface_file(path)) fail(path, "expected a surface: .obj, .off, .ply or .stl");
  const PolygonMesh mesh = read_polygons(path);
  Eigen::Matrix3Xd points(3, mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    for (int k = 0; k < 3; ++k) points(k, v.idx()) = mesh.point(v)[k];
  }
  std::vector<std::array<int, 3>> triangles;
  for (const auto f : mesh.faces()) {
    std::vector<int> corners;
    for (auto v = mesh.cfv_iter(f); v.is_valid(); ++v) corners.push_back(v->idx());
    for (std::size_t i = 2; i < corners.size(); ++i) {
      triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  if (triangles.empty()) fail(path, "has no triangles");
  if (!points.allFinite()) fail(path, "has a coordinate that is not finite");
  return {std::move(points), std::move(triangles), feature_angle_deg, features};
}

}  // namespace hexweft
