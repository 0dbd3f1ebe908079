#include "tools/signal_watch.h"

#include <atomic>
#include <chrono>
#include <csignal>

namespace hexweft::cli {
namespace {

std::atomic<int> signal_received = 0;
static_assert(std::atomic<int>::is_always_lock_free);

// All that a handler may do is to note the signal down.
extern "C" void remember_signal(int signal) {
  signal_received = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

SignalWatch::SignalWatch(std::stop_source source)
    : thread_([source = std::move(source)](const std::stop_token& end) mutable {
        while (!end.stop_requested()) {
          if (signal_received != 0) source.request_stop();
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
      }) {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  // nohup has it ignored, and means it.
  if (std::signal(SIGHUP, remember_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

}  // namespace hexweft::cli
