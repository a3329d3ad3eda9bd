// Seats by two locks: the store's lock has one owner; presence in the file of claims tells who else is there.
#include "campaigns/cli/shared_run.h"

#include "campaigns/cli/local_run.h"
#include "campaigns/cli/names.h"
#include "engine/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <set>
#include <thread>
#include <utility>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kStep = 50ms;        ///< between two looks at a lock
constexpr auto kPatience = 2s;      ///< for a run that is just sweeping up
constexpr auto kFirstPause = 100ms; ///< between two passes that had nothing to do, doubling
constexpr auto kLastPause = 2000ms;

/// Sleeps, but not beyond a stop request.
void pause(Clock::duration length, const std::stop_token& stop) {
  for (const auto end = Clock::now() + length; !stop.stop_requested() && Clock::now() < end;)
    std::this_thread::sleep_for(std::min<Clock::duration>(kStep, length));
}

/// Passes on what it hears and remembers which jobs have ended here.
class Remembering final : public Observer {
public:
  Remembering(Observer& next, std::set<std::string>& ended) : next_(next), ended_(ended) {}
  void opened(const Agenda& agenda) override { next_.opened(agenda); }
  void started(const Item& item) override { next_.started(item); }
  void finished(const Item& item, const Record& record) override {
    ended_.insert(item.key);
    next_.finished(item, record);
  }
  void barred(const Item& item) override { next_.barred(item); }

private:
  Observer& next_;
  std::set<std::string>& ended_;
};

} // namespace

fs::path claims_file(const fs::path& store) {
  return store / "claims";
}

Seat::Seat(fs::path store) : store_(std::move(store)), claims_(claims_file(store_)) {}

std::optional<Seat> Seat::take(const fs::path& store, InUse how, const std::stop_token& stop) {
  Seat seat(store);
  const fs::path file = store / "jobs.lock";
  if (how == InUse::complain) {
    seat.lock_ = hold(store);
  } else if (seat.lock_ = FileLock::try_lock(file); !seat.lock_ && how == InUse::wait) {
    fmt::print(stderr, "waiting for {}\n", FileLock::holder(file));
    for (; !seat.lock_; seat.lock_ = FileLock::try_lock(file)) {
      if (stop.stop_requested())
        return std::nullopt;
      pause(kStep, stop);
    }
  }
  if (seat.lock_) {
    seat.alone_ = seat.claims_.be_alone();
    return seat;
  }
  const auto give_up = Clock::now() + kPatience;
  while (!seat.claims_.be_here()) {
    if (stop.stop_requested())
      return std::nullopt;
    if (Clock::now() > give_up)
      throw Error(fmt::format("{} times jobs alone on its machine, so none can join it; --wait waits for its end",
                              FileLock::holder(file)));
    pause(kStep, stop);
  }
  return seat;
}

void Seat::keep_alone() {
  if (!alone_)
    throw Error(
        fmt::format("some jobs are to be timed alone, but other runs work in the store {}: start again when they "
                    "have ended (--wait and --join cannot help)",
                    store_.string()));
}

void Seat::open() {
  if (std::exchange(alone_, false))
    claims_.go();
}

Seat hold_alone(const fs::path& store) {
  std::optional<Seat> seat = Seat::take(store, InUse::complain, {});
  if (!seat->is_alone())
    throw Error(
        fmt::format("runs that have joined another still work in the store {}: wait for their end", store.string()));
  return std::move(*seat);
}

Summary run_shared(Store& store, std::span<const Plan> plans, Agenda agenda, const Resources& resources,
                   Observer& observer, const std::stop_token& stop) {
  Summary all;
  std::set<std::string> ended; // here: an outcome that is not final would look open again
  std::list<Agenda> agendas;   // the observer may look back at them
  agendas.push_back(std::move(agenda));
  Remembering remembering(observer, ended);
  for (auto length = kFirstPause;;) {
    const Summary pass = run_here(store, agendas.back(), resources, remembering, stop);
    all.barred = pass.barred;
    all.cancelled = pass.cancelled;
    for (std::size_t o = 0; o < all.ran.size(); ++o) {
      all.recorded[o] = pass.recorded[o] - std::min(pass.recorded[o], all.ran[o]);
      all.ran[o] += pass.ran[o];
    }
    if (pass.cancelled == 0 || stop.stop_requested())
      return all;
    // What is left, other runs are at.
    length = total(pass.ran) > 0 ? kFirstPause : std::min(2 * length, kLastPause);
    pause(length, stop);
    agendas.push_back(make_agenda(plans, [&, known = known_to(store)](const std::string& key) {
      return ended.contains(key) ? store.outcome(key) : known(key);
    }));
  }
}

} // namespace tamp::cli
