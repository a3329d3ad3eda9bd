// The progress line and the plain lines.
#include "campaigns/cli/progress.h"

#include "campaigns/cli/names.h"
#include "engine/base/host.h"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>

namespace tamp::cli {

namespace {

constexpr const char* kEraseLine = "\r\x1b[K";
constexpr int kFallbackColumns = 80;

std::size_t columns_of(std::FILE* terminal) {
  winsize size{};
  const bool known = ::ioctl(::fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return static_cast<std::size_t>(known ? size.ws_col : kFallbackColumns) - 1; // a full line would wrap
}

/// The number of spheres, if the record has one.
std::string count_of(const Record& record) {
  for (const Measure& measure : record.measures) {
    if (measure.name == "N")
      return fmt::format(", N = {:.0f}", measure.value);
  }
  return "";
}

} // namespace

Progress::Progress(std::FILE* out, bool terminal, int cores) : out_(out), terminal_(terminal), cores_(cores) {}

void Progress::close() {
  if (!ticker_.joinable())
    return;
  ticker_.request_stop();
  ticker_.join();
  fmt::print(out_, "{}", kEraseLine);
  std::fflush(out_);
}

void Progress::opened(const Agenda& agenda) {
  ticker_ = {}; // of the pass before this one; not under the lock, for which it may be waiting
  const std::scoped_lock lock(mutex_);
  agenda_ = &agenda;
  ended_ = 0;
  total_ = agenda.count(Standing::open);
  estimate_.emplace(agenda, cores_);
  start_ = steady_seconds();
  if (!terminal_)
    return;
  ticker_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex own;
    std::condition_variable_any wake;
    std::unique_lock waiting(own);
    while (!stop.stop_requested()) {
      {
        const std::scoped_lock drawing(mutex_);
        redraw();
      }
      wake.wait_for(waiting, stop, std::chrono::milliseconds(500), [] { return false; });
    }
  });
}

void Progress::started(const Item& /*item*/) {
  const std::scoped_lock lock(mutex_);
  ++running_;
}

void Progress::finished(const Item& item, const Record& record) {
  const std::scoped_lock lock(mutex_);
  --running_;
  ++ended_;
  const bool ok = record.outcome == Outcome::ok;
  not_ok_ += ok ? 0U : 1U;
  const bool generation = record.kind == JobKind::generation;
  // Of a child, the start and end of the process count too.
  const double wall_s = generation ? record.timing.process_wall_s : record.timing.wall_s;
  estimate_->finished(item, wall_s);
  if (!ok)
    write_line(fmt::format("{}: {}: {}", name(item), name_of(record.outcome), record.reason));
  else if (generation && !terminal_)
    write_line(fmt::format("{}: ok{}, {:.2f} s", name(item), count_of(record), record.timing.wall_s));
}

void Progress::barred(const Item& item) {
  const std::scoped_lock lock(mutex_);
  ++ended_;
  estimate_->barred(item);
  if (item.kind == JobKind::generation && item.after)
    write_line(fmt::format("{}: skipped, as the packing it starts from was not made ({})", name(item),
                           name(agenda_->items[*item.after])));
}

void Progress::say(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  write_line(line);
}

std::string Progress::name(const Item& item) const {
  const PlannedJob& planned = agenda_->task(item).planned;
  std::string text = job_name(planned.label, planned.point, planned.job.replicate);
  if (item.kind == JobKind::metric)
    text = fmt::format("{} of {}", name_of(agenda_->metric(item).name), text);
  return text;
}

std::string Progress::status() const {
  std::string text = fmt::format("{} of {} jobs done, {} running", ended_, total_, running_);
  if (not_ok_ > 0)
    text += fmt::format(", {} not ok", not_ok_);
  text += fmt::format(", {} so far", in_words(steady_seconds() - start_));
  if (const std::optional<double> remaining = estimate_->remaining_s())
    text += fmt::format(", about {} left", in_words(*remaining));
  return text;
}

void Progress::write_line(const std::string& line) {
  if (terminal_)
    fmt::print(out_, "{}{}\n", kEraseLine, line);
  else if (agenda_ != nullptr)
    fmt::print(out_, "[{}/{}] {}\n", ended_, total_, line);
  else
    fmt::print(out_, "{}\n", line);
  std::fflush(out_);
}

void Progress::redraw() {
  fmt::print(out_, "{}{}", kEraseLine, status().substr(0, columns_of(out_)));
  std::fflush(out_);
}

} // namespace tamp::cli
