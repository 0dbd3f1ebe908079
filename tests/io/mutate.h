// Random damage to files.
#pragma once

#include "tests/io/gmsh_samples.h"
#include "tests/io/vtu_files.h"

namespace hexweft::test {

/// Small files of every format and layout, with data.
inline std::vector<std::string> intact_files() {
  HexMesh mesh = shaken_grid(2);
  named_property<VertexTag, int>(mesh, "fixed", 3);
  named_property<VertexTag, bool>(mesh, "flag", true);
  named_property<CellTag, Eigen::Vector3d>(mesh, "axis", Eigen::Vector3d(0, 0, 1));
  named_property<CellTag, Eigen::VectorXd>(mesh, "stress", Eigen::VectorXd::Ones(6));
  const std::string cube = "POINTS 8 float\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n";
  VtuFile raw({.format = "raw", .order = std::endian::big, .header_bytes = 8});
  VtuFile compressed({.format = "binary", .block_size = 40});
  for (VtuFile* file : {&raw, &compressed}) {
    add_cube_piece(*file);
    add_cube_piece(*file);
  }
  std::vector<std::string> files{
      write_hex_mesh_text(mesh),
      write_hex_mesh_text(mesh, {.binary = true}),
      write_hex_mesh_text(mesh, {.format = "medit"}),
      write_hex_mesh_text(mesh, {.format = "ovm"}),
      write_hex_mesh_text(mesh, {.format = "ovmb"}),
      "# vtk DataFile Version 5.1\nx\nASCII\nFIELD FieldData 1\nTIME 1 1 double\n0.5\n"
      "DATASET UNSTRUCTURED_GRID\n" +
          cube +
          "METADATA\nINFORMATION 0\n\nCELLS 3 10\nOFFSETS vtktypeint64\n0 8 10\n"
          "CONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7 0 1\nCELL_TYPES 2\n12\n3\n"
          "CELL_DATA 2\nCOLOR_SCALARS rgb 3\n1 0 0 0 1 0\nLOOKUP_TABLE t 1\n1 1 1 1\n"
          "FIELD f 2\nid 1 2 long\n4 5\nnames 1 2 string\na\nb\n",
      write_hex_mesh_text(mesh, {.format = "vtu"}),
      raw.text(),
      compressed.text(),
      write_hex_mesh_text(mesh, {.format = "gmsh"}),
      write_hex_mesh_text(mesh, {.format = "gmsh", .binary = true})};
  for (const char* version : kGmshVersions) {
    for (GmshCoding coding : kGmshCodings) files.push_back(gmsh_tower(version, coding));
  }
  return files;
}

/// One to four changes: bytes overwritten, removed, repeated, replaced by a telling number or word,
/// the end cut off, a piece of another file put in.
inline std::string mutate(std::string text, const std::vector<std::string>& others, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
  static const std::vector<std::string> kWords{"-1",
                                               "0",
                                               "1",
                                               "2147483647",
                                               "2147483648",
                                               "-9223372036854775808",
                                               "1e309",
                                               "nan",
                                               "8",
                                               "#",
                                               "99999999999999999999",
                                               "CELLS",
                                               "POINTS",
                                               "METADATA",
                                               "FIELD",
                                               "string",
                                               "bit",
                                               "$Nodes",
                                               "$EndElements",
                                               "Bit",
                                               "UInt64",
                                               "binary",
                                               "<",
                                               "</DataArray>",
                                               "<Piece NumberOfPoints=\"9\"",
                                               "\n",
                                               std::string(1, '\0'),
                                               " "};
  for (std::size_t change = 1 + below(4); change > 0; --change) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min<std::size_t>(1 + below(20), text.size() - at);
    switch (below(7)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), 1 + below(60)));
        break;
      case 3:
        text.replace(at, 1 + below(4), kWords[below(kWords.size())]);
        break;
      case 4:
        text.resize(text.size() - below(text.size() / 4));
        break;
      case 5: {
        const std::string& other = others[below(others.size())];
        text.insert(at, other.substr(below(other.size()), 1 + below(200)));
        break;
      }
      default: {  // a whole word
        const std::size_t begin = text.find_last_of(" \n", at) + 1;
        const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
        if (begin < end) text.replace(begin, end - begin, kWords[below(kWords.size())]);
      }
    }
    if (text.empty()) break;
  }
  return text;
}

}  // namespace hexweft::test
