#include "tools/step_log.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "io/file.h"
#include "ovm/errors.h"

namespace hexweft::cli {

StepLog::StepLog(std::filesystem::path path, bool append) : path_(std::move(path)) {
  if (path_ == "-") throw InputError("--log = -, expected a file");
  check_writable(path_);
  file_.open(path_, append ? std::ios::app : std::ios::trunc);
  if (!file_) throw FormatError(display_name(path_, false) + ": cannot be written");
}

void StepLog::write(const nlohmann::ordered_json& line) {
  file_ << line.dump() << std::endl;
  if (!file_) throw FormatError(display_name(path_, false) + ": cannot be written");
}

}  // namespace hexweft::cli
