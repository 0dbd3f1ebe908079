// Gmsh files put together number by number, the same in every version and coding.
#pragma once

#include <bit>
#include <sstream>

#include "tests/io/sample_meshes.h"

namespace hexweft::test {

enum class GmshCoding { text, little_endian, big_endian };
inline constexpr GmshCoding kGmshCodings[] = {GmshCoding::text, GmshCoding::little_endian,
                                              GmshCoding::big_endian};
inline constexpr const char* kGmshVersions[] = {"2.2", "4.0", "4.1"};

class GmshFile {
 public:
  GmshFile(const std::string& version, GmshCoding coding) : coding_(coding) {
    text("$MeshFormat\n" + version + (is_binary() ? " 1 8\n" : " 0 8\n"));
    if (is_binary()) ints({1});
    end("MeshFormat");
  }
  bool is_binary() const { return coding_ != GmshCoding::text; }
  const std::string& str() const { return file_; }

  GmshFile& text(const std::string& text) {  // in every coding
    file_ += text;
    return *this;
  }
  GmshFile& ints(const std::vector<std::int64_t>& values) {
    for (std::int64_t x : values) put(static_cast<std::int32_t>(x));
    return *this;
  }
  GmshFile& sizes(const std::vector<std::int64_t>& values) {
    for (std::int64_t x : values) put(x);
    return *this;
  }
  GmshFile& reals(const std::vector<double>& values) {
    for (double x : values) put(x);
    return *this;
  }
  GmshFile& end_row() { return is_binary() ? *this : text("\n"); }
  GmshFile& end(const std::string& section) {
    return text((is_binary() ? "\n$End" : "$End") + section + "\n");
  }

 private:
  template <class T>
  void put(T value) {
    if (!is_binary()) {
      std::ostringstream out;
      out << value << ' ';
      file_ += out.str();
      return;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    const bool is_little = std::endian::native == std::endian::little;
    if (is_little != (coding_ == GmshCoding::little_endian)) {
      std::reverse(bytes, bytes + sizeof(T));
    }
    file_.append(bytes, sizeof(T));
  }

  GmshCoding coding_;
  std::string file_;
};

/// Two cells one on the other, cell 0 below, with tags in no order.
inline constexpr std::int64_t kTowerNodes[] = {40, 7, 1000000007, 3, 12, 11, 10, 9, 2, 1, 500, 600};
inline constexpr std::int64_t kTowerHexahedra[] = {20, 5};

inline Eigen::Vector3d tower_point(int i) {
  return {double(kCornerCoords[i % 4][0]), double(kCornerCoords[i % 4][1]), double(i / 4)};
}

inline std::vector<std::int64_t> tower_cell(int c) {
  return {kTowerNodes + 4 * c, kTowerNodes + 4 * c + 8};
}

inline void add_tower_entities(GmshFile& file, bool is_v41) {
  file.text("$Entities\n").sizes({1, 1, 1, 2}).end_row();
  file.ints({1}).reals({0, 0, 0});
  if (!is_v41) file.reals({0, 0, 0});
  file.sizes({1}).ints({8}).end_row();
  const auto box = [&](int tag, const std::vector<std::int64_t>& groups,
                       const std::vector<std::int64_t>& bounds) {
    file.ints({tag}).reals({0, 0, 0, 1, 1, 1e22}).sizes({std::ssize(groups)}).ints(groups);
    file.sizes({std::ssize(bounds)}).ints(bounds).end_row();
  };
  box(1, {}, {1, -1});
  box(3, {6}, {1});
  box(1, {7, 8}, {3});
  box(2, {9}, {-3});
  file.end("Entities");
}

// From version 4 on: four nodes with parameters on surface 3, the others in volume 1.
inline void add_tower_node_blocks(GmshFile& file, bool is_v41) {
  file.text("$Nodes\n").sizes({2, 12});
  if (is_v41) file.sizes({1, 1000000007});
  file.end_row();
  for (int block = 0; block < 2; ++block) {
    const int first = 4 * block, end = block == 0 ? 4 : 12;
    const std::int64_t dimension = block == 0 ? 2 : 3, entity = block == 0 ? 3 : 1;
    is_v41 ? file.ints({dimension, entity}) : file.ints({entity, dimension});
    file.ints({block == 0}).sizes({end - first}).end_row();
    for (int i = first; is_v41 && i < end; ++i) file.sizes({kTowerNodes[i]}).end_row();
    for (int i = first; i < end; ++i) {
      if (!is_v41) file.ints({kTowerNodes[i]});
      const Eigen::Vector3d p = tower_point(i);
      file.reals({p[0], p[1], p[2]});
      if (block == 0) file.reals({0.25, 0.75});
      file.end_row();
    }
  }
  file.end("Nodes");
}

inline void add_tower_element_blocks(GmshFile& file, bool is_v41) {
  const auto numbers = [&](const std::vector<std::int64_t>& values) {
    is_v41 ? file.sizes(values) : file.ints(values);
    file.end_row();
  };
  const auto block = [&](std::int64_t dimension, std::int64_t entity, std::int64_t type) {
    is_v41 ? file.ints({dimension, entity, type}) : file.ints({entity, dimension, type});
    file.sizes({1}).end_row();
  };
  file.text("$Elements\n").sizes({3, 3});
  if (is_v41) file.sizes({1, 20});
  file.end_row();
  block(2, 3, 3);
  numbers({1, 40, 7, 1000000007, 3});
  for (int c = 0; c < 2; ++c) {
    block(3, c + 1, 5);
    std::vector<std::int64_t> row = tower_cell(c);
    row.insert(row.begin(), kTowerHexahedra[c]);
    numbers(row);
  }
  file.end("Elements");
}

inline void add_tower_of_version_2(GmshFile& file) {
  file.text("$Nodes\n12\n");
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d p = tower_point(i);
    file.ints({kTowerNodes[i]}).reals({p[0], p[1], p[2]}).end_row();
  }
  file.end("Nodes").text("$Elements\n4\n");
  const auto element = [&](std::int64_t tag, std::int64_t type,
                           const std::vector<std::int64_t>& groups,
                           const std::vector<std::int64_t>& nodes) {
    if (file.is_binary()) file.ints({type, 1, std::ssize(groups), tag});
    if (!file.is_binary()) file.ints({tag, type, std::ssize(groups)});
    file.ints(groups).ints(nodes).end_row();
  };
  element(1, 3, {6, 3}, {40, 7, 1000000007, 3});
  element(20, 5, {7, 1}, tower_cell(0));
  element(21, 5, {8, 1}, tower_cell(0));  // in a second group
  element(5, 5, {9, 2, 1, 4}, tower_cell(1));
  file.end("Elements");
}

/// The tower with a name of a group, a value of each node and a vector of cell 1 and of a face.
inline std::string gmsh_tower(const std::string& version, GmshCoding coding) {
  GmshFile file(version, coding);
  file.text("$PhysicalNames\n1\n3 7 \"below\"\n$EndPhysicalNames\n");
  if (version == "2.2") {
    add_tower_of_version_2(file);
  } else {
    add_tower_entities(file, version == "4.1");
    add_tower_node_blocks(file, version == "4.1");
    add_tower_element_blocks(file, version == "4.1");
  }
  file.text("$NodeData\n1\n\"heat, 100%\"\n1\n0.5\n3\n0\n1\n12\n");
  for (int i = 11; i >= 0; --i) file.ints({kTowerNodes[i]}).reals({i + 0.5}).end_row();
  file.end("NodeData").text("$ElementData\n2\n\"axis\"\n\"scheme\"\n0\n4\n0\n3\n2\n0\n");
  file.ints({5}).reals({1, 2, 3}).end_row().ints({1}).reals({4, 5, 6}).end_row();
  return file.end("ElementData").str();
}

}  // namespace hexweft::test
