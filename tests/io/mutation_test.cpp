// Files with random damage are read or refused with a FormatError; nothing else happens.
#include "tests/io/mutate.h"

namespace hexweft::test {
namespace {

class DamagedFile : public testing::TestWithParam<int> {};

TEST_P(DamagedFile, IsReadOrRefused) {
  const std::vector<std::string> files = intact_files();
  const std::string& intact = files[GetParam()];
  int refused = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string damaged = mutate(intact, files, seed);
    try {
      const HexMesh mesh = read_hex_mesh_text(damaged, "damaged");
      EXPECT_GT(mesh.n_cells(), 0);
      const std::string text = write_hex_mesh_text(mesh);
      EXPECT_EQ(text, write_hex_mesh_text(read_hex_mesh_text(text, "again")));
    } catch (const FormatError& error) {
      EXPECT_THAT(error.what(), testing::MatchesRegex("damaged:( byte )?[0-9]+: .+"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 40);
}

INSTANTIATE_TEST_SUITE_P(Every, DamagedFile, testing::Range(0, int(intact_files().size())));

}  // namespace
}  // namespace hexweft::test
