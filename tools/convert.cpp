// hexweft-convert: from one mesh file format to another.
#include "tools/cli.h"

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program(
      "hexweft-convert",
      "Converts a hexahedral mesh from one file format to another. Data of vertices "
      "and cells travel along where the format has a place for them.");
  program.add_input();
  program.add_output();
  bool drop_isolated = false;
  program.app().add_flag("--drop-isolated", drop_isolated,
                         "Leave out vertices that no hexahedron uses");
  return program.run(argc, argv, [&] {
    program.write_mesh(program.read_mesh({.keep_isolated_vertices = !drop_isolated}));
    return cli::kDone;
  });
}
