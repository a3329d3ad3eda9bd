// Lanes by the colouring of intervals, an axis without pauses, and bars as rectangles.
#include "report/figures/timeline.h"

#include "engine/base/error.h"
#include "report/figures/style.h"
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace tamp {

namespace {

constexpr std::string_view kMetricColour = "#777777";
// All in pixels.
constexpr double kWidth = 900; // of the axis
constexpr double kLeft = 20;
constexpr double kRight = 60;
constexpr double kLane = 16;
constexpr double kBar = 13;
constexpr double kLine = 20;    // of text
constexpr double kCut = 18;     // what a pause is cut to
constexpr double kThinnest = 1; // thinner bars are drawn together
constexpr double kSeamed = 4;   // wider bars have a seam between them
constexpr double kTick = 80;    // at least, from one number to the next
/// A pause is cut that is longer than this share of the time in which something ran.
constexpr double kLongPause = 0.05;

/// The bars' indices by start, host after host.
std::vector<std::size_t> by_start(std::span<const TimelineBar> bars) {
  std::vector<std::size_t> order(bars.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(bars[a].host, bars[a].start_s, bars[a].end_s) <
           std::tie(bars[b].host, bars[b].start_s, bars[b].end_s);
  });
  return order;
}

/// A time in which something ran, and where it begins on the axis.
struct Stretch {
  double start_s;
  double end_s;
  double x = 0;
};

/// From time to place, with long pauses cut short.
class TimeAxis {
public:
  explicit TimeAxis(std::span<const TimelineBar> bars) {
    std::vector<std::pair<double, double>> times;
    for (const TimelineBar& bar : bars)
      times.emplace_back(bar.start_s, bar.end_s);
    std::sort(times.begin(), times.end());
    std::vector<Stretch> busy;
    double ran_s = 0;
    for (const auto& [start, end] : times) {
      if (busy.empty() || start > busy.back().end_s)
        busy.push_back({start, end});
      else
        busy.back().end_s = std::max(busy.back().end_s, end);
    }
    for (const Stretch& one : busy)
      ran_s += one.end_s - one.start_s;
    for (const Stretch& one : busy) {
      if (stretches_.empty() || one.start_s - stretches_.back().end_s > kLongPause * ran_s)
        stretches_.push_back(one);
      else
        stretches_.back().end_s = one.end_s;
    }
    double shown_s = 0;
    for (const Stretch& one : stretches_)
      shown_s += one.end_s - one.start_s;
    const double cuts = kCut * static_cast<double>(stretches_.size() - 1);
    scale_ = shown_s > 0 ? std::max(kWidth - cuts, kWidth / 2) / shown_s : 1;
    double x = kLeft;
    for (Stretch& one : stretches_) {
      one.x = x;
      x += scale_ * (one.end_s - one.start_s) + kCut;
    }
    end_ = x - kCut;
  }

  [[nodiscard]] double x(double time) const {
    const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), time,
                                        [](double t, const Stretch& one) { return t < one.start_s; });
    const Stretch& in = after == stretches_.begin() ? *after : *std::prev(after);
    return in.x + scale_ * (time - in.start_s);
  }
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }

private:
  std::vector<Stretch> stretches_;
  double scale_ = 1; ///< pixels per second
  double end_ = 0;
};

/// The unit in which numbers on the axis are read, by the step between them.
struct TimeUnit {
  std::string_view name;
  double seconds;
};
constexpr std::array kUnits = {TimeUnit{"d", 86400}, TimeUnit{"h", 3600}, TimeUnit{"min", 60}, TimeUnit{"s", 1}};

TimeUnit unit_of(double step) {
  return *std::find_if(kUnits.begin(), kUnits.end() - 1, [&](const TimeUnit& unit) { return step >= unit.seconds; });
}

/// The smallest round step of at least this many seconds.
double round_step(double least) {
  for (const double step : {60.0, 120.0, 300.0, 600.0, 1200.0, 1800.0, 3600.0, 7200.0, 14400.0, 21600.0, 43200.0})
    if (least <= step && least > 30)
      return step;
  const double unit = least > 30 ? kUnits.front().seconds : 1;
  const double decade = std::pow(10, std::floor(std::log10(least / unit)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (least <= digit * decade * unit)
      return digit * decade * unit;
  return 10 * decade * unit;
}

std::string clock_text(double seconds) {
  using namespace std::chrono;
  const auto whole = floor<std::chrono::seconds>(sys_time<duration<double>>(duration<double>(seconds)));
  const auto day = floor<days>(whole);
  const year_month_day date(day);
  const hh_mm_ss time(whole - day);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02} UTC", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), time.hours().count(),
                     time.minutes().count(), time.seconds().count());
}

std::string text_at(double x, double y, std::string_view text, std::string_view more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more, html_text(text));
}

std::string_view colour_of(const std::optional<MethodName>& method) {
  return method ? method_hex(*method) : kMetricColour;
}

std::string rectangle(double x, double y, double width, std::string_view colour, bool ok, std::string_view tip) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\" stroke=\"{}\" "
                     "stroke-width=\"{}\"><title>{}</title></rect>\n",
                     x, y, width, kBar, ok ? colour : "#ffffff", ok ? "#ffffff" : colour,
                     ok ? (width > kSeamed ? 0.3 : 0.0) : 1.2, html_text(tip));
}

/// Bars of one lane that are drawn as one, in the look of the longest.
struct Piece {
  double left;
  double right;
  double longest;
  std::optional<MethodName> method;
  bool ok;
  std::size_t jobs;
  std::size_t failed;
  std::string what;

  void join(const Piece& next) {
    right = next.right;
    jobs += next.jobs;
    failed += next.failed;
    if (next.longest > longest) {
      longest = next.longest;
      method = next.method;
      ok = next.ok;
    }
  }
  [[nodiscard]] std::string draw(double y) const {
    return rectangle(left, y, std::max(right - left, kThinnest / 2), colour_of(method), ok,
                     jobs == 1 ? what : fmt::format("{} jobs, {} of them not ok", jobs, failed));
  }
};

/// The lanes of one host; `bars` of it alone, by start.
class HostLanes {
public:
  HostLanes(std::span<const TimelineBar> bars, std::span<const std::size_t> order, std::span<const std::size_t> lanes,
            const TimeAxis& axis)
      : bars_(bars), order_(order), lanes_(lanes), axis_(axis) {
    for (const std::size_t i : order)
      count_ = std::max(count_, lanes[i] + 1);
  }
  [[nodiscard]] std::size_t count() const { return count_; }

  [[nodiscard]] std::string draw(double top) const {
    std::string out;
    std::vector<std::optional<Piece>> open(count_);
    const auto y_of = [&](std::size_t lane) { return top + kLane * static_cast<double>(lane); };
    for (const std::size_t i : order_) {
      const TimelineBar& bar = bars_[i];
      std::optional<Piece>& last = open[lanes_[i]];
      const double left = axis_.x(bar.start_s);
      const double right = axis_.x(bar.end_s);
      const Piece next{left, right, bar.end_s - bar.start_s, bar.method, bar.ok, 1, bar.ok ? 0U : 1U, bar.what};
      if (last && next.right - last->left < kThinnest) {
        last->join(next);
        continue;
      }
      if (last)
        out += last->draw(y_of(lanes_[i]));
      last = next;
    }
    for (std::size_t lane = 0; lane < count_; ++lane)
      out += open[lane] ? open[lane]->draw(y_of(lane)) : "";
    return out;
  }

  /// "HOST: 12 jobs, 2 at once at most, lanes busy 93 % of the time"
  [[nodiscard]] std::string words() const {
    double ran = 0;
    for (const std::size_t i : order_)
      ran += bars_[i].end_s - bars_[i].start_s;
    double shown = 0;
    for (const Stretch& one : axis_.stretches())
      shown += one.end_s - one.start_s;
    const std::string busy = shown > 0 ? fmt::format(", lanes busy {:.0f} % of the time shown",
                                                     100 * ran / shown / static_cast<double>(count_))
                                       : "";
    return fmt::format("{}: {} jobs, at most {} at once{}", bars_[order_.front()].host, order_.size(), count_, busy);
  }

private:
  std::span<const TimelineBar> bars_;
  std::span<const std::size_t> order_;
  std::span<const std::size_t> lanes_;
  const TimeAxis& axis_;
  std::size_t count_ = 0;
};

/// Lines and numbers of the axis from `top` to `bottom`; each stretch counts from its own beginning.
std::string draw_axis(const TimeAxis& axis, double top, double bottom) {
  std::string out;
  const double step = round_step(kTick / axis.scale());
  const TimeUnit unit = unit_of(step);
  double free_from = 0; // where the next clock time fits
  for (const Stretch& one : axis.stretches()) {
    const double length = one.end_s - one.start_s;
    for (int k = 0; k == 0 || k * step < length; ++k) {
      const double x = one.x + axis.scale() * k * step;
      out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\"/>\n", x, top,
                         bottom, k == 0 ? "#444444" : "#dddddd");
      if (k > 0 || axis.stretches().size() == 1)
        out += text_at(x, bottom + 16, fmt::format("{:g} {}", k * step / unit.seconds, unit.name),
                       " text-anchor=\"middle\" class=\"small\"");
    }
    if (one.x >= free_from) {
      constexpr double kClock = 150; // width of a date and time
      out += text_at(one.x, bottom + 32, clock_text(one.start_s), " class=\"small\"");
      free_from = one.x + kClock;
    }
  }
  return out;
}

std::string draw_legend(std::span<const TimelineBar> bars, double top) {
  std::string out;
  double x = kLeft;
  const auto entry = [&](std::string_view colour, bool ok, std::string_view words) {
    constexpr double kLetter = 6.5;
    out += rectangle(x, top, 20, colour, ok, words) + text_at(x + 26, top + 11, words);
    x += 46 + kLetter * static_cast<double>(words.size());
  };
  std::set<MethodName> methods;
  bool metrics = false;
  bool failures = false;
  for (const TimelineBar& bar : bars) {
    metrics = metrics || !bar.method;
    failures = failures || !bar.ok;
    if (bar.method)
      methods.insert(*bar.method);
  }
  for (const MethodName method : methods)
    entry(method_hex(method), true, name_of(method));
  if (metrics)
    entry(kMetricColour, true, "metrics");
  if (failures)
    entry("#222222", false, "did not end ok");
  return out;
}

} // namespace

std::optional<double> seconds_of_utc(std::string_view utc) {
  int year = 0;
  unsigned month = 0;
  unsigned day = 0;
  int hour = 0;
  int minute = 0;
  double second = 0;
  const std::string text(utc);
  if (std::sscanf(text.c_str(), "%d-%u-%uT%d:%d:%lfZ", &year, &month, &day, &hour, &minute, &second) != 6)
    return std::nullopt;
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
  if (!date.ok())
    return std::nullopt;
  const auto days = sys_days(date).time_since_epoch();
  return static_cast<double>(duration_cast<seconds>(days).count()) + 3600.0 * hour + 60.0 * minute + second;
}

std::optional<TimelineBar> timeline_bar(const Record& record, std::string what) {
  const std::optional<double> start = seconds_of_utc(record.provenance.start_utc);
  const std::optional<double> end = seconds_of_utc(record.provenance.end_utc);
  if (!start || !end || record.outcome == Outcome::lost || record.outcome == Outcome::cancelled)
    return std::nullopt;
  TimelineBar bar{record.provenance.host, *start, std::max(*start, *end), {}, record.outcome == Outcome::ok, {}};
  if (record.kind == JobKind::generation)
    bar.method = enum_of<MethodName>(record.name);
  bar.what = fmt::format("{}: {}, {:.3g} s", what, name_of(record.outcome), bar.end_s - bar.start_s);
  return bar;
}

std::vector<std::size_t> timeline_lanes(std::span<const TimelineBar> bars) {
  std::vector<std::size_t> lanes(bars.size());
  std::map<std::string_view, std::vector<double>> ends_of; // host → when each of its lanes is free again
  for (const std::size_t i : by_start(bars)) {
    std::vector<double>& ends = ends_of[bars[i].host];
    const auto free = std::find_if(ends.begin(), ends.end(), [&](double end) { return end <= bars[i].start_s; });
    lanes[i] = static_cast<std::size_t>(free - ends.begin());
    if (free == ends.end())
      ends.push_back(bars[i].end_s);
    else
      *free = bars[i].end_s;
  }
  return lanes;
}

std::string timeline_svg(std::span<const TimelineBar> bars, std::string_view title) {
  if (bars.empty())
    throw InputError("no run has a start and an end, so there is no timeline to draw");
  const std::vector<std::size_t> order = by_start(bars);
  const std::vector<std::size_t> lanes = timeline_lanes(bars);
  const TimeAxis axis(bars);

  double y = kLine + 8;
  std::string body = text_at(kLeft, kLine, title, " class=\"title\"");
  body += draw_legend(bars, y);
  y += kLine + 6;
  const double top = y;
  std::string rows;
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from;
    while (to < order.size() && bars[order[to]].host == bars[order[from]].host)
      ++to;
    const HostLanes host(bars, std::span(order).subspan(from, to - from), lanes, axis);
    rows += text_at(kLeft + 4, y + 14, host.words(), " class=\"small\"");
    rows += host.draw(y + kLine);
    y += kLine + kLane * static_cast<double>(host.count()) + 4;
    from = to;
  }
  body += draw_axis(axis, top, y) + rows;
  const double height = y + 62;
  body += text_at(kLeft, height - 8,
                  "A lane is a place among the jobs at once, not a core: records do not keep on which core a job ran.",
                  " class=\"small\"");
  const double width = axis.end() + kRight;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Arial,sans-serif\" font-size=\"13\" fill=\"#222222\">\n"
      "<style>.small {{ font-size: 11px }} .title {{ font-size: 14px; font-weight: bold }}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width, height, body);
}

} // namespace tamp
