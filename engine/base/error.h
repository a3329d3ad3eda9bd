// The two kinds of failure: what the user wrote (InputError) and what the machine did (Error).
#pragma once

#include <stdexcept>
#include <string>

namespace tamp {

/// A failure of the system or of a stored file: disk, process, library.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A question that has no answer for the thing it is asked of, now or later: the density of a packing without extent.
struct NotApplicable : Error {
  using Error::Error;
};

/// Something the user stated is impossible; the message says where, what, and what is allowed. Commands exit with 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace tamp
