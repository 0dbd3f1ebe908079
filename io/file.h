/// \file
/// Whole files in and out of memory.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hexweft {

/// \param path  "-" is standard input
/// \throws FormatError "path: cannot be read: reason"
std::string read_file(const std::filesystem::path& path);

/// Writes a file beside the target, then lets it take the target's place; the target is never half
/// written. An existing file's permissions and a symbolic link stay; what is no plain file (a pipe,
/// a device) is written directly. \param path  "-" is standard output \throws FormatError "path:
/// cannot be written: reason"; an existing file is then as it was
void write_file(const std::filesystem::path& path, std::string_view content);

/// Whether write_file can be expected to succeed, so that a long computation is not lost at its
/// end. \throws FormatError as write_file if the folder is not there or must not be written to
void check_writable(const std::filesystem::path& path);

/// The name of a file for messages.
std::string display_name(const std::filesystem::path& path, bool reading);

}  // namespace hexweft
