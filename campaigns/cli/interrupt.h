// Turns the first Ctrl-C (SIGINT) or SIGTERM into a stop request; the second ends the program at once.
#pragma once

#include "engine/base/system.h"

#include <stop_token>
#include <thread>

namespace tamp::cli {

/// While it lives. One at a time.
class Interrupt {
public:
  Interrupt();
  ~Interrupt(); ///< the signals mean again what they meant to a fresh program
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

private:
  std::stop_source source_;
  FileDescriptor event_; ///< the handler writes, the thread reads
  std::jthread thread_;
};

} // namespace tamp::cli
