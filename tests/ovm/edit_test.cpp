// Edits and their rollback.
#include <algorithm>
#include <functional>
#include <memory>
#include <random>

#include <gmock/gmock.h>

#include "ovm/edit/insert_sheet.h"
#include "ovm/edit/split_sheet.h"
#include "ovm/errors.h"
#include "ovm/hex_mesh.h"
#include "ovm/topology_check.h"
#include "ovm/transaction.h"
#include "tests/mesh_families.h"
#include "tests/ovm/brute_force.h"
#include "tests/ovm/mesh_dump.h"

namespace hexweft {
namespace {

// Everything at once: a value on each kind of element.
struct AllProperties {
  explicit AllProperties(HexMesh& mesh)
      : vertex(mesh, 1.5),
        edge(mesh, -1),
        half_edge(mesh, 7),
        face(mesh, false),
        half_face(mesh, Eigen::Vector3d::Zero()),
        cell(mesh, "none") {
    for (VertexHandle v : mesh.vertices()) vertex[v] = 0.25 * v.idx;
    for (EdgeHandle e : mesh.edges()) edge[e] = 3 * e.idx;
    for (FaceHandle f : mesh.faces()) face[f] = f.idx % 3 == 0;
    for (CellHandle c : mesh.cells()) {
      cell[c] = std::to_string(c.idx);
      for (HalfFaceHandle hf : mesh.halffaces(c)) half_face[hf] = Eigen::Vector3d::Constant(hf.idx);
    }
  }
  template <class Tag, class T, class Range>
  static std::vector<T> values(const Property<Tag, T>& p, const Range& elements) {
    std::vector<T> result;
    for (auto h : elements) result.push_back(p[h]);
    return result;
  }
  auto dump(const HexMesh& mesh) const {
    std::vector<Eigen::Vector3d> sides;
    std::vector<int> halves;
    for (CellHandle c : mesh.cells()) {
      for (HalfFaceHandle hf : mesh.halffaces(c)) sides.push_back(half_face[hf]);
    }
    for (EdgeHandle e : mesh.edges()) {
      for (int i = 0; i < 2; ++i) halves.push_back(half_edge[HalfEdgeHandle(2 * e.idx + i)]);
    }
    const std::vector<int> sizes{vertex.size(), edge.size(),      half_edge.size(),
                                 face.size(),   half_face.size(), cell.size()};
    return std::tuple(values(vertex, mesh.vertices()), values(edge, mesh.edges()), halves,
                      values(face, mesh.faces()), sides, values(cell, mesh.cells()), sizes);
  }

  VertexProperty<double> vertex;
  EdgeProperty<int> edge;
  Property<HalfEdgeTag, int> half_edge;
  FaceProperty<bool> face;
  HalfFaceProperty<Eigen::Vector3d> half_face;
  CellProperty<std::string> cell;
};

template <class Range>
auto listed(const Range& range) {
  return std::vector<typename Range::iterator::value_type>(range.begin(), range.end());
}

// Seeded random edits, of every kind the kernel has.
class RandomEditor {
 public:
  RandomEditor(HexMesh& mesh, AllProperties& properties, unsigned seed)
      : mesh_(mesh), properties_(properties), random_(seed) {}

  void edit() {
    if (mesh_.n_cells() == 0) return add_lone_cell();
    switch (random_() % 8) {
      case 0:
        return mesh_.delete_cell(some(mesh_.cells()));
      case 1:
        return add_lone_cell();
      case 2:
        return merge();
      case 3:
        if (mesh_.n_cells() < 500) split_sheet(mesh_, some(mesh_.edges()));
        return;
      case 4: {
        const CellHandle c = some(mesh_.cells());
        insert_sheet(mesh_, std::array{c}, {.include_boundary = random_() % 2 == 0});
        return;
      }
      case 5:
        return mesh_.set_point(some(mesh_.vertices()),
                               Eigen::Vector3d::Constant(double(random_() % 9)));
      case 6:
        return write_properties();
      default:
        return delete_lonely_vertices();
    }
  }

 private:
  template <class Range>
  typename Range::iterator::value_type some(const Range& range) {
    const auto all = listed(range);
    return all[random_() % all.size()];
  }
  void add_lone_cell() {
    CellVertices v;
    for (int i = 0; i < kCorners; ++i) {
      const auto& x = kCornerCoords[i];
      v[i] = mesh_.add_vertex({double(x[0]), double(x[1]), double(x[2])});
    }
    properties_.cell[mesh_.add_cell(v)] = "alone";
  }
  void merge() {
    const std::array pairs{VertexMerge{some(mesh_.vertices()), some(mesh_.vertices())}};
    if (pairs[0].keep == pairs[0].drop) return;
    const MeshDump before(mesh_);
    try {
      mesh_.merge_vertices(pairs);
    } catch (const InputError&) {
      EXPECT_TRUE(MeshDump(mesh_) == before) << "a refused merge changed the mesh";
    }
  }
  void write_properties() {
    properties_.vertex[some(mesh_.vertices())] = -1;
    properties_.edge[some(mesh_.edges())] = 12345;
    properties_.half_edge[HalfEdgeHandle(2 * some(mesh_.edges()).idx + 1)] = 3;
    const FaceHandle f = some(mesh_.faces());
    properties_.face[f] = !properties_.face[f];
    properties_.half_face[mesh_.halfface(f)].setConstant(-5);
  }
  void delete_lonely_vertices() {
    std::vector<VertexHandle> lonely;
    for (VertexHandle v : mesh_.vertices()) {
      if (mesh_.cells(v).empty()) lonely.push_back(v);
    }
    for (VertexHandle v : lonely) mesh_.delete_vertex(v);
  }
  HexMesh& mesh_;
  AllProperties& properties_;
  std::mt19937_64 random_;
};

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, RollbackRestoresEveryHandlePropertyAndCoordinate) {
  HexMesh mesh = GetParam().make();
  AllProperties properties(mesh);
  const MeshDump before(mesh);
  const auto values_before = properties.dump(mesh);
  for (unsigned seed = 0; seed < 5; ++seed) {
    Transaction trial(mesh);
    RandomEditor editor(mesh, properties, seed);
    for (int i = 0; i < 20; ++i) editor.edit();
    EXPECT_FALSE(MeshDump(mesh) == before) << "nothing was edited, seed " << seed;
    trial.rollback();
    ASSERT_TRUE(MeshDump(mesh) == before) << "seed " << seed;
    ASSERT_EQ(properties.dump(mesh), values_before) << "seed " << seed;
  }
}

TEST_P(EveryMeshFamily, NestedTransactionsUndoTheirOwnEdits) {
  HexMesh mesh = GetParam().make();
  AllProperties properties(mesh);
  const MeshDump before(mesh);
  const auto values_before = properties.dump(mesh);
  {
    Transaction outer(mesh);
    RandomEditor editor(mesh, properties, 11);
    for (int i = 0; i < 8; ++i) editor.edit();
    const MeshDump between(mesh);
    const auto values_between = properties.dump(mesh);
    {
      Transaction inner(mesh);
      for (int i = 0; i < 8; ++i) editor.edit();
    }
    EXPECT_TRUE(MeshDump(mesh) == between);
    EXPECT_EQ(properties.dump(mesh), values_between);
    {
      Transaction inner(mesh);
      for (int i = 0; i < 8; ++i) editor.edit();
      inner.commit();
    }
  }
  EXPECT_TRUE(MeshDump(mesh) == before) << "the outer rollback undoes inner commits too";
  EXPECT_EQ(properties.dump(mesh), values_before);
}

TEST_P(EveryMeshFamily, EditsKeepIncidencesCurrent) {
  HexMesh mesh = GetParam().make();
  AllProperties properties(mesh);
  RandomEditor editor(mesh, properties, 23);
  for (int i = 0; i < 30; ++i) {
    editor.edit();
    const BruteForce expected(mesh);
    ASSERT_EQ(mesh.n_edges(), static_cast<int>(expected.cells_of_edge.size()));
    for (EdgeHandle e : mesh.edges()) {
      const auto ends = BruteForce::sorted(mesh.vertices(e));
      ASSERT_EQ(mesh.valence(e), static_cast<int>(expected.cells_of_edge.at(ends).size()));
    }
    for (VertexHandle v : mesh.vertices()) {
      const auto it = expected.cells_of_vertex.find(v);
      const int n = it == expected.cells_of_vertex.end() ? 0 : static_cast<int>(it->second.size());
      ASSERT_EQ(mesh.cells(v).size(), n);
    }
  }
  EXPECT_EQ(properties.vertex.size(), mesh.vertex_slots());
  EXPECT_EQ(properties.half_face.size(), 6 * mesh.cell_slots());
}

TEST_P(EveryMeshFamily, CompactionAfterEditsKeepsPropertiesWithTheirElements) {
  HexMesh mesh = GetParam().make();
  AllProperties properties(mesh);
  RandomEditor editor(mesh, properties, 31);
  for (int i = 0; i < 25; ++i) editor.edit();
  auto before = properties.dump(mesh);
  std::get<6>(before).clear();
  mesh.collect_garbage();
  auto after = properties.dump(mesh);
  EXPECT_EQ(std::get<6>(after), (std::vector{mesh.n_vertices(), mesh.n_edges(), 2 * mesh.n_edges(),
                                             mesh.n_faces(), 6 * mesh.n_cells(), mesh.n_cells()}));
  std::get<6>(after).clear();
  EXPECT_EQ(after, before);
  const MeshDump compact(mesh);
  mesh.collect_garbage();
  EXPECT_TRUE(MeshDump(mesh) == compact) << "compacting twice changes nothing";
}

// Those of the slots that are live, in order, are the ones that there are then.
template <class Handles>
void expect_renumbered(const Renumbering& now, const Handles& before, int slots,
                       const Handles& after) {
  using H = typename Handles::value_type;
  Handles renumbered;
  for (int i = 0; i < slots; ++i) {
    const bool live = std::binary_search(before.begin(), before.end(), H(i));
    EXPECT_EQ(now[H(i)].valid(), live);
    if (live) renumbered.push_back(now[H(i)]);
  }
  EXPECT_EQ(renumbered, after);
  EXPECT_FALSE(now[H()].valid());
}

TEST_P(EveryMeshFamily, CompactionTellsTheNewHandles) {
  HexMesh mesh = GetParam().make();
  AllProperties properties(mesh);
  RandomEditor editor(mesh, properties, 37);
  for (int i = 0; i < 25; ++i) editor.edit();
  const HexMesh old = mesh;
  const Renumbering now = mesh.collect_garbage();
  expect_renumbered(now, listed(old.vertices()), old.vertex_slots(), listed(mesh.vertices()));
  expect_renumbered(now, listed(old.edges()), old.edge_slots(), listed(mesh.edges()));
  expect_renumbered(now, listed(old.faces()), old.face_slots(), listed(mesh.faces()));
  expect_renumbered(now, listed(old.cells()), old.cell_slots(), listed(mesh.cells()));
  for (EdgeHandle e : old.edges()) {
    const HalfEdgeHandle h(2 * e.idx + 1);
    EXPECT_EQ(mesh.from(now[h]), now[old.from(h)]);
  }
  for (CellHandle c : old.cells()) {
    for (HalfFaceHandle hf : old.halffaces(c)) {
      EXPECT_EQ(mesh.cell(now[hf]), now[c]);
      EXPECT_EQ(mesh.opposite(now[hf]), now[old.opposite(hf)]);
      EXPECT_EQ(mesh.face(now[hf]), now[old.face(hf)]);
    }
  }
  for (HalfFaceHandle gone(0); gone.idx < 6 * old.cell_slots(); ++gone.idx)
    EXPECT_EQ(now[gone].valid(), old.is_live(CellHandle(gone.idx / 6)));
}

TEST_P(EveryMeshFamily, SerialNumbersStayWithTheirElements) {
  HexMesh mesh = GetParam().make();
  AllProperties properties(mesh);
  RandomEditor editor(mesh, properties, 41);
  VertexProperty<int> of_vertex(mesh, -1);
  CellProperty<int> of_cell(mesh, -1);
  int last_vertex = -1, last_cell = -1;
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 8; ++i) editor.edit();
    std::vector<int> vertices, cells;
    const int old_vertex = last_vertex, old_cell = last_cell;
    const auto look_at = [](int serial, int& known, int& last, int old, std::vector<int>& all) {
      // A new element may have taken over a property, but not the number.
      if (serial <= old) {
        EXPECT_EQ(known, serial);
      }
      known = serial;
      last = std::max(last, serial);
      all.push_back(serial);
    };
    for (VertexHandle v : mesh.vertices())
      look_at(mesh.serial(v), of_vertex[v], last_vertex, old_vertex, vertices);
    for (CellHandle c : mesh.cells())
      look_at(mesh.serial(c), of_cell[c], last_cell, old_cell, cells);
    EXPECT_TRUE(std::is_sorted(vertices.begin(), vertices.end(), std::less_equal()));
    EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end(), std::less_equal()));
    mesh.collect_garbage();
    const HexMesh copy = mesh;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      EXPECT_EQ(mesh.serial(VertexHandle(static_cast<int>(i))), vertices[i]);
      EXPECT_EQ(copy.serial(VertexHandle(static_cast<int>(i))), vertices[i]);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      EXPECT_EQ(mesh.serial(CellHandle(static_cast<int>(i))), cells[i]);
      EXPECT_EQ(copy.serial(CellHandle(static_cast<int>(i))), cells[i]);
    }
  }
}

TEST(Merge, FoldsASheetOfAGridAway) {
  HexMesh mesh = make_grid({3, 2, 2});
  std::vector<CellHandle> layer;
  std::vector<VertexMerge> merges;
  for (CellHandle c : mesh.cells()) {
    if (c.idx % 3 == 1) layer.push_back(c);
  }
  for (VertexHandle v : mesh.vertices()) {
    if (v.idx % 4 == 1) merges.push_back({v, VertexHandle(v.idx + 1)});
  }
  for (CellHandle c : layer) mesh.delete_cell(c);
  mesh.merge_vertices(merges);
  EXPECT_EQ(mesh.n_cells(), 8);
  EXPECT_EQ(mesh.n_vertices(), 27);
  EXPECT_EQ(mesh.n_edges(), 54);
  EXPECT_EQ(mesh.n_faces(), 36);
  EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
}

TEST(Merge, RefusesTwoCornersOfACellAndLeavesTheMesh) {
  HexMesh mesh = make_grid({2, 1, 1});
  const MeshDump before(mesh);
  const std::array merges{VertexMerge{VertexHandle(0), VertexHandle(5)},
                          VertexMerge{VertexHandle(1), VertexHandle(2)}};
  EXPECT_THROW(mesh.merge_vertices(merges), InputError);
  EXPECT_TRUE(MeshDump(mesh) == before);
}

TEST(Merge, RefusesVerticesThatAreNotLiveAndThoseOfTwoPairs) {
  HexMesh mesh = make_grid({1, 1, 1});
  std::array<VertexHandle, 4> v;
  for (VertexHandle& lone : v) lone = mesh.add_vertex(Eigen::Vector3d::Zero());
  mesh.delete_vertex(v[3]);
  const VertexHandle corner(0), beyond(mesh.vertex_slots());
  const std::vector<std::vector<VertexMerge>> refused{{{v[0], v[0]}},
                                                      {{v[0], v[3]}},
                                                      {{v[3], v[0]}},
                                                      {{v[0], beyond}},
                                                      {{VertexHandle(), v[0]}},
                                                      {{v[0], v[2]}, {v[1], v[2]}},
                                                      {{corner, v[0]}, {v[0], v[1]}},
                                                      {{v[0], corner}, {v[1], v[0]}}};
  const MeshDump before(mesh);
  for (const auto& merges : refused) {
    EXPECT_THROW(mesh.merge_vertices(merges), InputError);
    EXPECT_TRUE(MeshDump(mesh) == before);
  }
  mesh.merge_vertices(std::array{VertexMerge{v[0], corner}, VertexMerge{v[0], v[1]}});
  EXPECT_EQ(mesh.vertices(CellHandle(0))[0], v[0]);
  mesh.delete_vertex(v[2]);
  EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
}

TEST(Delete, RefusesWhatIsNotLive) {
  HexMesh mesh = make_grid({2, 1, 1});
  const VertexHandle lone = mesh.add_vertex(Eigen::Vector3d::Zero());
  mesh.delete_vertex(lone);
  mesh.delete_cell(CellHandle(0));
  const MeshDump before(mesh);
  for (VertexHandle v : {lone, VertexHandle(), VertexHandle(mesh.vertex_slots())}) {
    EXPECT_THROW(mesh.delete_vertex(v), InputError);
  }
  for (CellHandle c : {CellHandle(0), CellHandle(), CellHandle(2)}) {
    EXPECT_THROW(mesh.delete_cell(c), InputError);
  }
  EXPECT_TRUE(MeshDump(mesh) == before);
}

TEST(Transaction, ForbidsCompactionCopiesAndAssignments) {
  HexMesh mesh = make_grid({1, 1, 1}), other = make_grid({2, 1, 1});
  const MeshDump before(mesh), other_before(other);
  {
    Transaction t(mesh);
    EXPECT_THROW(mesh.collect_garbage(), InputError);
    EXPECT_THROW(HexMesh copy(mesh), InputError);
    EXPECT_THROW(mesh = other, InputError);
    EXPECT_THROW(mesh = std::move(other), InputError);
    EXPECT_THROW(other = mesh, InputError);
    EXPECT_THROW(other = std::move(mesh), InputError);
    EXPECT_TRUE(MeshDump(mesh) == before);
    EXPECT_TRUE(MeshDump(other) == other_before);
    mesh.add_vertex(Eigen::Vector3d::Zero());
  }
  EXPECT_TRUE(MeshDump(mesh) == before);
  mesh = other;
  EXPECT_TRUE(MeshDump(mesh) == other_before);
}

TEST(Transaction, EndsOnlyAfterThoseInsideIt) {
  HexMesh mesh = make_grid({1, 1, 1});
  Transaction outer(mesh);
  mesh.add_vertex(Eigen::Vector3d::Zero());
  {
    Transaction inner(mesh);
    mesh.add_vertex(Eigen::Vector3d::Zero());
    EXPECT_THROW(outer.commit(), InputError);
    EXPECT_THROW(outer.rollback(), InputError);
    EXPECT_EQ(mesh.n_vertices(), 10);
  }
  EXPECT_EQ(mesh.n_vertices(), 9) << "what was refused has closed nothing";
  outer.commit();
  outer.commit();
  EXPECT_EQ(mesh.n_vertices(), 9);
}

TEST(Transaction, ThatIsDestroyedUndoesThoseInsideIt) {
  HexMesh mesh = make_grid({1, 1, 1});
  const MeshDump before(mesh);
  {
    auto outer = std::make_unique<Transaction>(mesh);
    mesh.add_vertex(Eigen::Vector3d::Zero());
    Transaction inner(mesh);
    mesh.delete_cell(CellHandle(0));
    outer.reset();
    EXPECT_TRUE(MeshDump(mesh) == before);
    EXPECT_THROW(inner.commit(), InputError);
  }
  EXPECT_TRUE(MeshDump(mesh) == before);
  EXPECT_NO_THROW(mesh.collect_garbage());
}

}  // namespace
}  // namespace hexweft
