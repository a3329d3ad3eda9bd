// Runs campaigns in a store in which other processes may be working on the same.
#pragma once

#include "campaigns/cli/open_store.h"
#include "engine/base/claims.h"
#include "engine/schedule/schedule.h"

#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>

namespace tamp::cli {

/// What to do about a store that another run has.
enum class InUse { complain, wait, join };

/// The right to run jobs in a store. One run has the store's lock; others may join it and work on other jobs.
class Seat {
public:
  /// Takes the store's lock, waits for it, or joins the run that has it. Throws Error naming that run; when joining
  /// also if it times jobs alone on the machine. `stop` ends the waiting; then there is no seat.
  static std::optional<Seat> take(const std::filesystem::path& store, InUse how, const std::stop_token& stop);

  /// Whether nobody else works in the store: only then may what is left in incoming/ be swept up. Stays so until
  /// open().
  [[nodiscard]] bool is_alone() const { return alone_; }
  /// Jobs timed exclusively are among those to run: others are kept out until the end. Throws Error if some are in.
  void keep_alone();
  /// Lets others join from now on.
  void open();

private:
  explicit Seat(std::filesystem::path store);
  std::filesystem::path store_;
  std::optional<FileLock> lock_;
  Claims claims_;
  bool alone_ = false;
};

/// A seat alone, without waiting. Throws Error if anybody else works in the store.
Seat hold_alone(const std::filesystem::path& store);

/// The file of the claims on the jobs of a store.
std::filesystem::path claims_file(const std::filesystem::path& store);

/// Runs what is open in `agenda`, which was made of these plans, and waits for what other runs are at, in passes:
/// `observer` hears of each as of a run. No job is tried twice here. Errors as in run_agenda.
Summary run_shared(Store& store, std::span<const Plan> plans, Agenda agenda, const Resources& resources,
                   Observer& observer, const std::stop_token& stop);

} // namespace tamp::cli
