// Runs a program of this project the way a user does.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file.h"

namespace hexweft::test {

struct ToolRun {
  int exit_code;  ///< -1 if a signal ended it
  std::string out, err;
};

/// A test with a folder of its own to run the programs in, also where the same test runs at the same
/// time in another process.
class ToolTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("hexweft-tool-") + info->test_suite_name() + "-" + info->name() + "-" +
               std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "work");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// \param command  a shell command, where "hexweft-" starts the name of one of the programs
  ToolRun run(const std::string& command) const {
    const std::string shell = "cd '" + (folder_ / "work").string() +
                              "' && PATH='" HEXWEFT_BIN_DIR "':\"$PATH\" && { " + command +
                              " ; } >../out 2>../err </dev/null";
    const int status = std::system(shell.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_ / "out"),
            read_file(folder_ / "err")};
  }
  /// The same, where the command writes a log of steps to run.log and is sent a signal after its first
  /// one. What the log was by then is in signal.log.
  ToolRun run_and_signal(const std::string& command, const std::string& signal) const {
    return run(
        "rm -f run.log; " + command +
        " & pid=$!; for i in $(seq 6000); do "
        "[ \"$(cat run.log 2>/dev/null | wc -l)\" -ge 2 ] && break; sleep 0.01; done; kill -" +
        signal + " $pid; cp run.log signal.log; wait $pid");
  }
  std::filesystem::path file(const std::string& name) const { return folder_ / "work" / name; }
  int n_files() const {
    return static_cast<int>(
        std::distance(std::filesystem::directory_iterator(folder_ / "work"), {}));
  }

 private:
  std::filesystem::path folder_;
};

/// One line that starts with the program's name.
MATCHER_P(IsSentenceOf, program, "") {
  return arg.starts_with(std::string(program) + ": ") && arg.find('\n') == arg.size() - 1;
}

}  // namespace hexweft::test
