/// \file
/// Other programs, run and waited for.
#pragma once

#include <string>
#include <vector>

namespace hexweft::cli {

/// How a program ended and what it took.
struct ProcessResult {
  int exit_code = 0;        ///< -1 if a signal ended it or it could not be started
  std::string problem;      ///< why it has no exit code; else the last line of its standard error
  std::string output;       ///< all of its standard output
  double seconds = 0;       ///< processor time, of all its threads
  double wall_seconds = 0;  ///< time gone by
  double peak_mib = 0;      ///< the most memory it had at one time
};

/// Runs a program with nothing on its standard input, in a process group of its own, so that a
/// Ctrl-C at the terminal does not reach it. Safe to call on several threads.
/// \param arguments  the program's path first
/// \throws std::runtime_error if no pipe can be made
ProcessResult run_process(const std::vector<std::string>& arguments);

/// Ends the programs that run at the moment, and makes later calls of run_process() fail at once.
void kill_processes();

/// The path of a program that lies beside the running one. \throws std::runtime_error
std::string sibling_program(const std::string& name);

}  // namespace hexweft::cli
