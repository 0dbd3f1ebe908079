#include "io/hex_mesh_io.h"

#include "io/file.h"
#include "io/formats.h"

namespace hexweft {
namespace {

std::string all_extensions() {
  std::string result;
  for (const Format& format : formats()) {
    result += (result.empty() ? "" : ", ") + std::string(format.extension);
  }
  return result;
}

const Format& format_to_read(std::string_view text, const std::filesystem::path& name,
                             const ReadOptions& options) {
  if (!options.format.empty()) return format_named(options.format);
  if (const Format* format = format_of_extension(name)) return *format;
  for (const Format& format : formats()) {
    if (format.starts_like(text)) return format;
  }
  throw FormatError(name.string() + ":1: expected the start of a mesh file (" + all_extensions() +
                    "), found something else");
}

const Format& format_to_write(const std::filesystem::path& path, const WriteOptions& options) {
  if (!options.format.empty()) return format_named(options.format);
  if (path == "-") return format_named("vtk");
  if (const Format* format = format_of_extension(path)) return *format;
  throw InputError(path.string() + ": expected a file name that ends in one of " +
                   all_extensions() + ", or the name of a format");
}

void check(const WriteOptions& options, const Format& format) {
  if (options.precision && (*options.precision < 1 || *options.precision > 17)) {
    throw InputError("precision = " + std::to_string(*options.precision) + ", expected [1, 17]");
  }
  if (options.binary && !format.has_binary) {
    throw InputError("format \"" + std::string(format.name) + "\" has no binary form");
  }
}

std::string text_of(const HexMesh& mesh, const Format& format, const WriteOptions& options,
                    WriteReport& report) {
  check(options, format);
  std::string text;
  report.format = format.name;
  format.write(mesh, options, text, report.notes);
  return text;
}

}  // namespace

HexMesh read_hex_mesh_text(std::string_view text, const std::string& name,
                           const ReadOptions& options, ReadReport* report) {
  const Format& format = format_to_read(text, name, options);
  ReadReport ignored;
  ReadReport& result = report ? *report : ignored;
  result = {std::string(format.name), {}};
  return build_hex_mesh(format.read(text, name), options.keep_isolated_vertices, result.notes);
}

HexMesh read_hex_mesh(const std::filesystem::path& path, const ReadOptions& options,
                      ReadReport* report) {
  return read_hex_mesh_text(read_file(path), display_name(path, true), options, report);
}

WriteReport write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh,
                           const WriteOptions& options) {
  WriteReport report;
  write_file(path, text_of(mesh, format_to_write(path, options), options, report));
  return report;
}

void check_hex_mesh_output(const std::filesystem::path& path, const WriteOptions& options) {
  check(options, format_to_write(path, options));
  check_writable(path);
}

std::string write_hex_mesh_text(const HexMesh& mesh, const WriteOptions& options,
                                WriteReport* report) {
  WriteReport ignored;
  WriteReport& result = report ? *report : ignored;
  return text_of(mesh, format_to_write("-", options), options, result);
}

}  // namespace hexweft
