// Shows how a run goes: one line updated in place on a terminal, plain lines otherwise.
#pragma once

#include "campaigns/cli/estimate.h"
#include "engine/schedule/observer.h"

#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tamp::cli {

/// Writes to `out`. Plain lines: one for each generation and for each metric that did not end ok.
class Progress final : public Observer {
public:
  Progress(std::FILE* out, bool terminal, int cores);
  ~Progress() override { close(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void opened(const Agenda& agenda) override;
  void started(const Item& item) override;
  void finished(const Item& item, const Record& record) override;
  void barred(const Item& item) override;

  /// Ends the showing and leaves the terminal on an empty line.
  void close();

  /// A line of its own, above the progress line if there is one. Any thread may call.
  void say(const std::string& line);

private:
  [[nodiscard]] std::string status() const; ///< under mutex_, as the next two
  void write_line(const std::string& line);
  void redraw();
  [[nodiscard]] std::string name(const Item& item) const;

  std::FILE* out_;
  bool terminal_;
  int cores_;
  std::mutex mutex_;
  const Agenda* agenda_ = nullptr;
  std::optional<Estimate> estimate_;
  std::size_t total_ = 0;
  std::size_t ended_ = 0;
  std::size_t not_ok_ = 0;
  std::size_t running_ = 0;
  double start_ = 0;
  std::jthread ticker_; ///< redraws now and then, as a long job would leave the clock standing
};

} // namespace tamp::cli
