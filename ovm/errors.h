/// \file
/// The exceptions of hexweft. A message is one sentence that names the place and what was expected.
#pragma once

#include <stdexcept>

namespace hexweft {

/// The caller broke a precondition: a wrong option, a handle of another mesh, an unusable mesh.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file could not be read or written as what it claims to be; the message starts "path:line: ".
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A numerical solver gave up where it must not.
struct SolverError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hexweft
