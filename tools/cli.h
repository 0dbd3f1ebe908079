/// \file
/// What the command-line tools share: options of the same name and meaning everywhere, one home for
/// exit codes and messages.
///
///     int main(int argc, char** argv) {
///       cli::Program program("hexweft-something", "Does something to a hexahedral mesh.");
///       program.add_input();
///       program.add_output();
///       return program.run(argc, argv, [&] {
///         HexMesh mesh = program.read_mesh();
///         ...
///         program.write_mesh(mesh);
///         program.say("done");
///         return cli::kDone;
///       });
///     }
///
/// Exit codes: 0 done, 1 failed, 2 wrong usage or input, 3 a file cannot be read or written. An
/// error is one sentence on standard error. A result sent to standard output ("-") has it for
/// itself.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "io/hex_mesh_io.h"
#include "optimize/reference_surface.h"

namespace hexweft::cli {

inline constexpr int kDone = 0, kFailed = 1, kWrongInput = 2, kFileProblem = 3;

/// Accepts finite numbers in [least, most] only.
CLI::Validator in_range(double least, double most);

/// Both name one regular file, or would if they were written. Never true of "-" and devices.
bool is_same_file(const std::string& a, const std::string& b);

class Program {
 public:
  Program(const std::string& name, const std::string& summary);

  CLI::App& app() { return app_; }  ///< for options of the tool's own

  // ---- Options that tools share; call before run() ----
  void add_input();          ///< INPUT, --input-format
  void add_output();         ///< -o/--output, --format, --binary, --precision; required
  void add_json();           ///< --json
  void add_threads(int& n);  ///< --threads; the value it has is the default

  /// Parses the command line, makes sure that the outputs can be written, calls `body` and returns
  /// the exit code. Every exception ends here.
  int run(int argc, char** argv, const std::function<int()>& body);

  // ---- For the body ----
  HexMesh read_mesh(const ReadOptions& options = {});  ///< the INPUT; notes go to standard error
  /// The INPUT of a program that needs a base complex. \throws InputError naming what is wrong
  HexMesh read_valid_mesh();
  /// Of a triangle file, or the boundary of a mesh (surface_input.h); notes go to standard error.
  ReferenceSurface read_surface(const std::string& path, const FeatureOptions& features = {});
  /// To the --output. \throws InputError if the --precision asked for would invert hexahedra
  void write_mesh(const HexMesh& mesh);
  bool wants_json() const { return !json_path_.empty(); }
  void write_json(const nlohmann::ordered_json& report);  ///< if --json asks for it
  /// A line for the user, on standard output, or on standard error if that carries a result.
  void say(const std::string& line);
  void say_text(const std::string& lines);  ///< the same for text that ends its own lines
  /// Says on standard error in one sentence what failed. \return `code`
  int fail(int code, const std::string& message) const;
  void note(const std::string& text) const;  ///< a remark on standard error
  /// Takes a further file for an output, or standard output; none if it is empty.
  /// \throws InputError if it is INPUT or an output already
  void take_output(const std::string& option, const std::string& path);
  /// \throws InputError if a further file that is read is one of the outputs
  void expect_not_written(const std::string& option, const std::string& path) const;
  /// \throws InputError if --json is this file; `what` names it: "the surface"
  void expect_no_json(const std::string& path, const std::string& what) const;

 private:
  void check_paths() const;
  std::string by_flag(const std::string& message) const;
  bool is_output(const std::string& path) const;
  bool writes_to_stdout() const;

  CLI::App app_;
  std::string name_;
  std::string input_path_, input_format_, output_path_, json_path_;
  std::vector<std::string> further_outputs_;
  WriteOptions write_options_;
};

}  // namespace hexweft::cli
