// The store of a folder of results: records with their provenance in SQLite, packings as files named by their keys.
#pragma once

#include "engine/base/error.h"
#include "engine/model/packing.h"
#include "engine/model/plan.h"
#include "engine/model/record.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// The database of a store is damaged (a bad page, or no database at all).
struct DamagedStore : Error {
  using Error::Error;
};

/// Whether a job that ended so need not run again. A limit or a method that does not converge would end the same way
/// again; what failed, crashed, was cancelled or lost may not. (Limits are not part of a key; whoever raises them
/// decides by the outcome, see outcomes().)
bool is_final(Outcome outcome);

/// A campaign as the store remembers it.
struct StoredCampaign {
  std::string name;
  std::string title;
  std::string file;
  std::string settings; ///< JSON: {"metrics":[…],"report":{…},"run":{…}}, the parameters as in a campaign file
};

/// One generation job of a stored campaign, whether it has run or not.
struct StoredJob {
  std::string campaign;
  std::string key;
  std::string label;
  std::int64_t replicate = 0;
  std::map<std::string, std::string> point;
};

/// How much of a campaign is recorded, in packings.
struct CampaignExtent {
  std::size_t planned = 0;
  std::size_t recorded = 0;
};

/// A job of a campaign whose current record is not ok; `packing`: the generation job, or the one a metric measured.
struct Unsuccessful {
  StoredJob packing;
  JobKind kind = JobKind::generation;
  std::string key;
  std::string name; ///< of the method or metric
  Outcome outcome = Outcome::failed;
};

/// A job that has a record, by what decides its result.
struct RecordedJob {
  std::string key;
  std::string canonical;
};

/// The points inside an import at which a fault may strike; tests stop the process there.
enum class ImportStep { verified, packing_moved, row_written, committed, done };

/// What sweep_incoming() found.
struct Sweep {
  std::vector<Record> imported;
  std::vector<std::string> rejected; ///< messages: results that were damaged; their files have been removed
  std::size_t removed = 0;           ///< temporaries and packings without a record
};

/// A folder: `tamp.sqlite`, `packings/<first 2 digits of the key>/<key>.h5`, `incoming/` for the results of child
/// processes, `jobs.lock`. Any thread may call any function; one process at a time should write (it holds jobs.lock),
/// any number may read meanwhile. All functions throw Error, naming the file, when the disk or the database fails.
class Store {
public:
  enum class Mode { create, read };

  /// create: makes what is missing, brings an older schema up to date, may write. read: the store must exist.
  static Store open(const std::filesystem::path& folder, Mode mode);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  [[nodiscard]] const std::filesystem::path& folder() const;
  /// Where child processes leave <key>.h5 and then <key>.json.
  [[nodiscard]] std::filesystem::path incoming() const;
  /// The name of the network file system on which the folder lies; empty if it is on a local disk.
  [[nodiscard]] std::string_view network() const;
  /// The file of the lock (engine/base/file_lock.h) that a process holds while it runs jobs.
  [[nodiscard]] std::filesystem::path jobs_lock() const;
  /// Where the packing of a key belongs, whether it is there or not.
  [[nodiscard]] std::filesystem::path packing_path(std::string_view key) const;

  /// Where the output of the latest run of a job is kept, if it said anything.
  [[nodiscard]] std::filesystem::path log_path(std::string_view key) const;
  /// Takes a file for the output of the latest run of a job. An empty one, or none, takes away that of the run before.
  void keep_log(std::string_view key, const std::filesystem::path& file);

  /// Remembers a run, in one transaction that is on the disk when this returns. Ignored (false) if the key has an ok
  /// record already, as the same key means the same result; otherwise a further attempt. Throws Error for a measure
  /// that is not finite, for two measures of one name, or if the record names a packing that is not in the store.
  bool put(const Record& record);

  /// Takes in the result of a child process: checks the packing against the SHA-256 of its record, moves it to
  /// packings/, writes the row, removes the JSON file. Killed at any point, the same call (or sweep_incoming) ends the
  /// work. `amend` may add what only the parent process knows. `packing` is looked at only if the record has one.
  /// Throws Error for a damaged result, which is left where it is, and if the key has another packing already.
  Record import_result(const std::filesystem::path& json, const std::filesystem::path& packing,
                       const std::function<void(Record&)>& amend = {});

  /// At the start of a run, by the holder of jobs.lock: imports what an earlier process left complete in incoming/,
  /// removes what it left half-made.
  Sweep sweep_incoming();

  /// Whether there is a record of any outcome.
  [[nodiscard]] bool has(std::string_view key) const;
  /// The outcome of the current record.
  [[nodiscard]] std::optional<Outcome> outcome(std::string_view key) const;
  /// The outcomes of the current records, by key; of one kind, or of both.
  [[nodiscard]] std::map<std::string, Outcome> outcomes(std::optional<JobKind> kind = {}) const;
  /// The keys, ascending, of the records whose outcome is_final; of one kind, or of both.
  [[nodiscard]] std::vector<std::string> finished(std::optional<JobKind> kind = {}) const;

  /// The current record: the latest attempt (an ok attempt is always the latest).
  [[nodiscard]] std::optional<Record> find(std::string_view key) const;
  /// The current records of the keys that have one, in the order of the keys.
  [[nodiscard]] std::vector<Record> records(std::span<const std::string> keys) const;
  /// Every attempt at a key, oldest first.
  [[nodiscard]] std::vector<Record> attempts(std::string_view key) const;
  /// The current metric records of the packing of a generation job, by metric and key.
  [[nodiscard]] std::vector<Record> metric_records(std::string_view packing_key) const;
  /// The recorded jobs of a method or metric, in the order of their first attempts.
  [[nodiscard]] std::vector<RecordedJob> recorded_jobs(JobKind kind, std::string_view name) const;
  /// The keys of the generation jobs that no campaign names, in the order of their first attempts.
  [[nodiscard]] std::vector<std::string> keys_without_campaign() const;

  /// The packing of a job, checked against the SHA-256 of its record. Throws Error also if there is none.
  [[nodiscard]] Packing read_packing(std::string_view key) const;

  /// Remembers which jobs a campaign names, in place of what an earlier campaign of that name said. Records stay.
  void put_campaign(const Plan& plan);
  [[nodiscard]] std::vector<StoredCampaign> campaigns() const;
  /// The jobs of a campaign, in the order of its file; empty if the store does not know it.
  [[nodiscard]] std::vector<StoredJob> campaign_jobs(std::string_view campaign) const;
  /// Planned and recorded packings, without reading each job: hundred thousand take some hundredths of a second.
  [[nodiscard]] CampaignExtent campaign_extent(std::string_view campaign) const;
  /// Generation jobs and the metrics on their packings that did not end ok, in the order of the campaign's file.
  [[nodiscard]] std::vector<Unsuccessful> unsuccessful(std::string_view campaign) const;

  /// What SQLite finds wrong with its file, line by line; empty if it is sound. Reads all of it.
  [[nodiscard]] std::vector<std::string> integrity() const;

  /// Called at each step of an import, by the thread that imports. For tests.
  void on_import_step(std::function<void(ImportStep)> hook);

private:
  struct Parts;
  explicit Store(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

} // namespace tamp
