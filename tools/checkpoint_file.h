/// \file
/// A checkpoint of hexweft-simplify as a file: a line that says what it is, how long and of which
/// checksum; a line of JSON with the input, the options and the state of the run; the mesh in
/// binary VTK. It is written beside its target, which it then replaces.
///
///     CheckpointFile file("run.checkpoint", input, options);
///     file.write(mesh, state);
///     const Checkpoint from = CheckpointFile("run.checkpoint", input, options).read();
#pragma once

#include <cstdint>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "simplify/checkpoint.h"
#include "simplify/options.h"

namespace hexweft::cli {

class CheckpointFile {
 public:
  /// \param input  of the run, as it was read
  CheckpointFile(std::filesystem::path path, const HexMesh& input, const SimplifyOptions& options);

  /// \throws FormatError if it cannot be written; an earlier one is then as it was
  void write(const HexMesh& mesh, const RunState& state) const;
  /// \throws FormatError if it cannot be read, is none or is damaged, InputError if it is of another
  /// input or of other options
  Checkpoint read() const;

 private:
  void check_origin(const nlohmann::ordered_json& header) const;

  std::filesystem::path path_;
  nlohmann::ordered_json origin_;  // what a run that goes on must have in common with it
};

}  // namespace hexweft::cli
