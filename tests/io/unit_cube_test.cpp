// Where each format puts which corner of a cell.
#include <sstream>

#include "io/formats.h"
#include "tests/io/ovm_samples.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

struct CubeFile {
  std::string format, text;
};

// Written by hand after each format's definition: points 0 to 7 of the unit cube, then one cell.
const std::vector<CubeFile> kCubes{
    {"vtk",
     "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
     "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
     "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n"},
    {"vtu",
     "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
     "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
     "<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\">\n<Points>\n"
     "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n"
     "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n</DataArray>\n</Points>\n<Cells>\n"
     "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n"
     "0 1 2 3 4 5 6 7\n</DataArray>\n"
     "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n8\n</DataArray>\n"
     "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n12\n</DataArray>\n"
     "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"},
    {"medit",
     "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n"
     "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\n"
     "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\nEnd\n"},
    {"ovm", kOvmCube},
    {"ovmb", ovmb_cube()},
    {"gmsh",
     "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n"
     "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n"
     "$Elements\n1\n1 5 2 0 0 1 2 3 4 5 6 7 8\n$EndElements\n"}};

TEST(UnitCube, EveryFormatHasOne) {
  for (const Format& format : formats()) {
    const bool found = std::any_of(kCubes.begin(), kCubes.end(), [&](const CubeFile& cube) {
      return cube.format == format.name;
    });
    EXPECT_TRUE(found) << format.name;
  }
}

TEST(UnitCube, IsReadWithItsCornersInVtkOrder) {
  for (const CubeFile& cube : kCubes) {
    SCOPED_TRACE(cube.format);
    ReadReport report;
    const HexMesh mesh = read_hex_mesh_text(cube.text, "cube", {}, &report);
    EXPECT_EQ(report.format, cube.format);
    EXPECT_THAT(report.notes, testing::IsEmpty());
    expect_same_mesh(mesh, unit_cube());
  }
}

TEST(UnitCube, IsWrittenSo) {
  for (const CubeFile& cube : kCubes) {
    SCOPED_TRACE(cube.format);
    const std::string text = write_hex_mesh_text(unit_cube(), {.format = cube.format});
    if (cube.format == "vtk") {  // the title is free
      EXPECT_EQ(text.substr(text.find("ASCII")), cube.text.substr(cube.text.find("ASCII")));
    } else {
      EXPECT_EQ(text, cube.text);
    }
  }
}

TEST(UnitCube, VoxelIsRenumbered) {
  const HexMesh mesh = read_hex_mesh_text(
      "# vtk DataFile Version 2.0\nvoxel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 int\n"
      "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n"
      "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n11\n",
      "voxel.vtk");
  for (int i = 0; i < 8; ++i) {
    const auto& x = kCornerCoords[i];
    EXPECT_EQ(mesh.point(mesh.vertices(CellHandle(0))[i]), Eigen::Vector3d(x[0], x[1], x[2]));
  }
}

TEST(UnitCube, CellsAreTurnedIfMoreThanHalfAreMirrored) {
  // A tower of cells, one on the other.
  const auto tower = [](const std::vector<bool>& mirrored) {
    const int n = static_cast<int>(mirrored.size());
    std::ostringstream text;
    text << "MeshVersionFormatted 1 Dimension 3 Vertices " << 4 * (n + 1);
    for (int z = 0; z <= n; ++z) {
      for (const char* corner : {"0 0", "1 0", "1 1", "0 1"})
        text << '\n' << corner << ' ' << z << " 0";
    }
    text << "\nHexahedra " << n;
    for (int c = 0; c < n; ++c) {
      text << '\n';
      for (int i = 0; i < 8; ++i) text << 4 * c + 1 + (mirrored[c] ? (i + 4) % 8 : i) << ' ';
      text << '0';
    }
    return text.str();
  };
  for (const auto& [mirrored, note] :
       {std::pair<std::vector<bool>, std::string>{{false, false}, ""},
        {{true, false}, ""},
        {{true, true}, "all hexahedra were numbered mirrored; they were turned into VTK order"},
        {{true, false, true},
         "2 of 3 hexahedra were numbered mirrored; all were turned into VTK order"}}) {
    ReadReport report;
    const HexMesh mesh = read_hex_mesh_text(tower(mirrored), "m", {}, &report);
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const bool is_inverted = mesh.vertices(CellHandle(c))[0].idx != 4 * c;
      EXPECT_EQ(is_inverted, note.empty() ? mirrored[c] : !mirrored[c]);
    }
    EXPECT_EQ(report.notes, note.empty() ? std::vector<std::string>() : std::vector{note});
  }
}

}  // namespace
}  // namespace hexweft::test
