#include "tools/progress_line.h"

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <unistd.h>

#include <fmt/format.h>

namespace hexweft::cli {

ProgressLine::ProgressLine() : on_terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const std::string& text) {
  if (!on_terminal_) return;
  std::cerr << "\r\033[K" << text << std::flush;
  dirty_ = true;
}

void ProgressLine::clear() {
  if (dirty_) std::cerr << "\r\033[K" << std::flush;
  dirty_ = false;
}

BusyLine::BusyLine(const std::string& word)
    : thread_([word](const std::stop_token& end) {
        ProgressLine line;
        if (!line.on_terminal()) return;
        const auto start = std::chrono::steady_clock::now();
        std::mutex mutex;
        std::condition_variable_any wait;
        std::unique_lock lock(mutex);
        while (!end.stop_requested()) {
          const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start;
          line.show(fmt::format("{}  {:.1f} s", word, gone.count()));
          wait.wait_for(lock, end, std::chrono::milliseconds(200), [] { return false; });
        }
      }) {}

}  // namespace hexweft::cli
