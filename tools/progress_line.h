/// \file
/// One line on standard error that is written over, on a terminal only.
///
///     ProgressLine line;
///     line.show("half done");
///     line.clear();
#pragma once

#include <string>
#include <thread>

namespace hexweft::cli {

class ProgressLine {
 public:
  ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }
  bool on_terminal() const { return on_terminal_; }
  void show(const std::string& text);
  void clear();

 private:
  bool on_terminal_, dirty_ = false;
};

/// Shows a word and the seconds gone by for as long as it lives.
class BusyLine {
 public:
  explicit BusyLine(const std::string& word);

 private:
  std::jthread thread_;
};

}  // namespace hexweft::cli
