/// \file
/// A run as it happens: one JSON object a line, there to be read as soon as it is written.
///
///     StepLog log("run.log", false);
///     log.write(to_json(progress));
#pragma once

#include <filesystem>
#include <fstream>

#include <nlohmann/json_fwd.hpp>

namespace hexweft::cli {

class StepLog {
 public:
  /// \param append  go on below what is there; else the file starts anew
  /// \throws InputError for "-", FormatError if the file cannot be written
  StepLog(std::filesystem::path path, bool append);
  /// \throws FormatError if the line does not get there
  void write(const nlohmann::ordered_json& line);

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace hexweft::cli
