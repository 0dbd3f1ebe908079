#include "tools/checkpoint_file.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "io/file.h"
#include "io/hex_mesh_io.h"
#include "ovm/detail/fnv.h"
#include "ovm/errors.h"

namespace hexweft::cli {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::string_view kMagic = "hexweft-checkpoint 1 ";

std::string first_line(std::string_view content) {
  detail::Fnv hash;
  hash.take_bytes(content);
  return fmt::format("{}{} {:016x}\n", kMagic, content.size(), hash.value());
}

// Takes the text up to the next line feed, and that, off the front.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

// The name of the first option of a checkpoint that is another now, with both values.
std::string difference(const Json& then, const Json& now, const std::string& prefix = "") {
  for (const auto& [key, value] : now.items()) {
    const Json old = then.is_object() ? then.value(key, Json()) : Json();
    if (old == value) continue;
    if (value.is_object()) return difference(old, value, prefix + key + ".");
    return fmt::format("{}{} = {}, not {}", prefix, key, old.dump(), value.dump());
  }
  return {};
}

}  // namespace

CheckpointFile::CheckpointFile(std::filesystem::path path, const HexMesh& input,
                               const SimplifyOptions& options)
    : path_(std::move(path)),
      origin_({{"input",
                {{"vertices", input.n_vertices()},
                 {"hexahedra", input.n_cells()},
                 {"checksum", fmt::format("{:016x}", fingerprint(input))}}},
               {"options", lasting_options(options)}}) {}

void CheckpointFile::write(const HexMesh& mesh, const RunState& state) const {
  Json header = origin_;
  header["state"] = to_json(state);
  const std::string content =
      header.dump() + '\n' + write_hex_mesh_text(mesh, {.format = "vtk", .binary = true});
  write_file(path_, first_line(content) + content);
}

void CheckpointFile::check_origin(const Json& header) const {
  const std::string file = display_name(path_, true);
  if (const Json& input = header.at("input"); input != origin_.at("input")) {
    throw InputError(fmt::format("{}: is of another input, of {} vertices and {} hexahedra", file,
                                 input.at("vertices").dump(), input.at("hexahedra").dump()));
  }
  const std::string other = difference(header.at("options"), origin_.at("options"));
  if (!other.empty()) throw InputError(file + ": is of a run with " + other);
}

Checkpoint CheckpointFile::read() const {
  const std::string file = display_name(path_, true), text = read_file(path_);
  std::string_view content = text;
  const std::string_view line = take_line(content);
  if (!line.starts_with(kMagic)) throw FormatError(file + ": is no checkpoint of hexweft-simplify");
  if (first_line(content) != std::string(line) + '\n') {
    throw FormatError(file + ": is cut short or damaged");
  }
  const Json header = Json::parse(take_line(content), nullptr, false);
  try {
    check_origin(header);
    return {read_hex_mesh_text(content, file, {.format = "vtk"}), run_state(header.at("state"))};
  } catch (const nlohmann::json::exception&) {
    throw FormatError(file + ": does not say what it is a checkpoint of");
  }
}

}  // namespace hexweft::cli
