/// \file
/// Ctrl-C and the like as a stop request.
///
///     std::stop_source interrupt;
///     const SignalWatch watch(interrupt);
#pragma once

#include <stop_token>
#include <thread>

namespace hexweft::cli {

/// While it lives, the first SIGINT or SIGTERM becomes a stop request; a second one ends the
/// program the usual way.
class SignalWatch {
 public:
  explicit SignalWatch(std::stop_source source);

 private:
  std::jthread thread_;
};

}  // namespace hexweft::cli
