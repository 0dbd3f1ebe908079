#include "tools/cli.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fcntl.h>
#include <filesystem>
#include <glog/logging.h>
#include <iostream>
#include <new>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "io/file.h"
#include "io/formats.h"
#include "io/number_text.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "tools/surface_input.h"

namespace hexweft::cli {
namespace {

// Formats and their extensions, for --help.
std::string list_formats() {
  std::string list;
  for (const Format& format : formats()) {
    list += (list.empty() ? "" : "; ");
    list += std::string(format.name) + " (" + std::string(format.extension) + "): ";
    list += format.description;
  }
  return list;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format& format : formats()) names.emplace_back(format.name);
  return names;
}

// One line: a message of several would not be a sentence.
std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

// Else the first file that is opened takes the place of a stream that was closed, and what is said there
// gets into it.
void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDWR) < 0) return;
  }
}

// Hexahedra that are inverted only once the coordinates have so few digits.
int n_inverted_if_rounded(const HexMesh& mesh, int digits) {
  HexMesh rounded = mesh;
  for (VertexHandle v : mesh.vertices()) {
    Eigen::Vector3d p = mesh.point(v);
    for (double& x : p) {
      std::string text;
      detail::append_number(text, x, digits);
      std::from_chars(text.data(), text.data() + text.size(), x);
    }
    rounded.set_point(v, p);
  }
  int n = 0;
  for (CellHandle c : mesh.cells())
    n += scaled_jacobian(mesh, c) > 0 && !(scaled_jacobian(rounded, c) > 0);
  return n;
}

// "target_hexahedra_rel" as a flag has it: "target_hexahedra_ratio".
std::string with_ratio(std::string words) {
  if (words.ends_with("_rel")) words.replace(words.size() - 3, 3, "ratio");
  return words;
}

// Whether the words of `part` are among those of `whole`, one after the other.
bool has_words(const std::string& whole, const std::string& part) {
  return ("_" + whole + "_").find("_" + part + "_") != std::string::npos;
}

// Large arrays come and go with every pass over a mesh. To get their pages from the system each time
// takes up to an eighth of a run.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMiB = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);  // the highest there is
  mallopt(M_TRIM_THRESHOLD, 1024 * kMiB);
#endif
}

}  // namespace

bool is_same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  if (a.empty() || b.empty() || a == "-" || b == "-") return false;
  std::error_code problem;  // a path that cannot be looked at fails where it is used
  const bool exists = fs::exists(a, problem) && fs::exists(b, problem);
  if (!exists) {
    return fs::absolute(a, problem).lexically_normal() ==
           fs::absolute(b, problem).lexically_normal();
  }
  return fs::is_regular_file(a, problem) && fs::equivalent(a, b, problem);
}

CLI::Validator in_range(double least, double most) {
  const std::string range = fmt::format("[{:.10g}, {:.10g}]", least, most);
  const auto check = [=](const std::string& text) -> std::string {
    double value = std::nan("");
    const bool is_number = CLI::detail::lexical_cast(text, value);
    if (is_number && value >= least && value <= most) return {};
    return "expected a number in " + range + ", found \"" + text + "\"";
  };
  return CLI::Validator(check, "in " + range);
}

// The libraries name an option as their struct does; who typed --hausdorff is told of that, not of
// hausdorff_limit_rel.
std::string Program::by_flag(const std::string& message) const {
  const std::size_t end = message.find(" = ");
  if (end == std::string::npos || message.find(' ') != end) return message;
  const auto words = [](std::string text) {
    for (char& c : text) c = c == '-' || c == '.' ? '_' : c;
    return text;
  };
  const std::string option_words = with_ratio(words(message.substr(0, end)));
  std::string flag;
  for (const CLI::Option* option : app_.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const bool is_meant = has_words(option_words, words(name));
      if (is_meant && name.size() > flag.size()) flag = name;
    }
  }
  return flag.empty() ? message : "--" + flag + message.substr(end);
}

Program::Program(const std::string& name, const std::string& summary)
    : app_(summary, name), name_(name) {
  open_closed_streams();
  keep_freed_memory();
  FLAGS_minloglevel = google::GLOG_ERROR;  // nobody can act on the warnings of ceres
  app_.set_version_flag("--version", name + " " HEXWEFT_VERSION);
  app_.get_formatter()->column_width(34);
  app_.footer(
      "Exit codes: 0 done, 1 failed, 2 wrong usage or input, 3 file cannot be read or written.");
}

void Program::add_input() {
  app_.add_option("INPUT", input_path_,
                  "Mesh to read, - is standard input. Formats: " + list_formats())
      ->required();
  app_.add_option("--input-format", input_format_,
                  "Format of INPUT (default: by its extension, else by how it starts)")
      ->check(CLI::IsMember(format_names()));
}

void Program::add_output() {
  app_.add_option("-o,--output", output_path_, "Mesh to write, - is standard output")->required();
  app_.add_option("--format", write_options_.format,
                  "Format of the output (default: by its extension, vtk for -)")
      ->check(CLI::IsMember(format_names()));
  auto* binary = app_.add_flag("--binary", write_options_.binary,
                               "Write binary numbers where the format knows them");
  app_.add_option_function<int>(
          "--precision", [this](const int& digits) { write_options_.precision = digits; },
          "Significant digits in text (default: as few as read back exactly)")
      ->excludes(binary)
      ->check(in_range(1, 17));
}

void Program::add_json() {
  app_.add_option("--json", json_path_, "Write a report as JSON, - is standard output");
}

void Program::add_threads(int& n) {
  app_.add_option("--threads", n, "Number of threads; the result does not depend on it")
      ->check(in_range(1, 1024))
      ->capture_default_str();
}

void Program::check_paths() const {
  if (output_path_ == "-" && json_path_ == "-") {
    throw InputError("only one of --output and --json can be standard output");
  }
  expect_no_json(output_path_, "the mesh");
  expect_no_json(input_path_, "the mesh");
  if (!output_path_.empty()) check_hex_mesh_output(output_path_, write_options_);
  if (wants_json()) check_writable(json_path_);
}

bool Program::is_output(const std::string& path) const {
  return is_same_file(path, output_path_) || is_same_file(path, json_path_) ||
         std::any_of(further_outputs_.begin(), further_outputs_.end(),
                     [&](const std::string& other) { return is_same_file(path, other); });
}

bool Program::writes_to_stdout() const {
  return output_path_ == "-" || json_path_ == "-" ||
         std::find(further_outputs_.begin(), further_outputs_.end(), "-") != further_outputs_.end();
}

void Program::take_output(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  const bool is_taken =
      path == "-" ? writes_to_stdout() : is_same_file(path, input_path_) || is_output(path);
  if (is_taken)
    throw InputError(option + " = " + path + ", expected another file than INPUT and the outputs");
  further_outputs_.push_back(path);
}

void Program::expect_not_written(const std::string& option, const std::string& path) const {
  if (is_output(path))
    throw InputError(option + " = " + path + ", expected another file than the outputs");
}

void Program::expect_no_json(const std::string& path, const std::string& what) const {
  if (is_same_file(json_path_, path))
    throw InputError("--json = " + json_path_ + ", expected another file than " + what);
}

int Program::run(int argc, char** argv, const std::function<int()>& body) {
  try {
    app_.parse(argc, argv);
    check_paths();
    const int code = body();
    if (!std::cout.flush()) return fail(kFileProblem, "standard output: cannot be written");
    return code;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app_.exit(error);  // --help, --version
    return fail(kWrongInput, std::string(error.what()) + " (see " + name_ + " --help)");
  } catch (const InputError& error) {
    return fail(kWrongInput, by_flag(error.what()));
  } catch (const FormatError& error) {
    return fail(kFileProblem, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory");
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}

int Program::fail(int code, const std::string& message) const {
  std::cerr << name_ << ": " << one_line(message) << std::endl;
  return code;
}

void Program::note(const std::string& text) const {
  std::cerr << name_ << ": note: " << one_line(text) << std::endl;
}

HexMesh Program::read_mesh(const ReadOptions& options) {
  ReadOptions with_format = options;
  if (!input_format_.empty()) with_format.format = input_format_;
  ReadReport report;
  HexMesh mesh = read_hex_mesh(input_path_, with_format, &report);
  for (const std::string& text : report.notes) note(text);
  return mesh;
}

HexMesh Program::read_valid_mesh() {
  HexMesh mesh = read_mesh();
  if (mesh.n_cells() == 0) throw InputError("the mesh has no cells");
  for (const TopologyViolation& v : check_topology(mesh)) {
    if (severity(v.defect) == Severity::invalid) {
      throw InputError("the mesh is not valid: " + v.message);
    }
  }
  return mesh;
}

ReferenceSurface Program::read_surface(const std::string& path, const FeatureOptions& features) {
  expect_no_json(path, "the surface");
  std::vector<std::string> notes;
  ReferenceSurface surface = read_surface_input(path, notes, features);
  for (const std::string& text : notes) note(text);
  return surface;
}

void Program::write_mesh(const HexMesh& mesh) {
  if (const auto digits = write_options_.precision) {
    const int n = n_inverted_if_rounded(mesh, *digits);
    if (n > 0)
      throw InputError("--precision = " + std::to_string(*digits) + " inverts " +
                       std::to_string(n) + " hexahedra, expected more digits");
  }
  const WriteReport report = write_hex_mesh(output_path_, mesh, write_options_);
  for (const std::string& text : report.notes) note(text);
}

void Program::write_json(const nlohmann::ordered_json& report) {
  if (!wants_json()) return;
  using Handler = nlohmann::ordered_json::error_handler_t;  // a path need not be UTF-8
  write_file(json_path_, report.dump(2, ' ', false, Handler::replace) + "\n");
}

void Program::say(const std::string& line) { say_text(line + '\n'); }

void Program::say_text(const std::string& lines) {
  (writes_to_stdout() ? std::cerr : std::cout) << lines;
}

}  // namespace hexweft::cli
