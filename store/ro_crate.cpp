// Copies the files of a crate and writes its graph, entity by entity as they come.
#include "store/ro_crate.h"

#include "engine/base/file_writer.h"
#include "engine/base/files.h"
#include "store/file_digest.h"
#include "store/record_json.h"
#include "store/ro_crate_entities.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <vector>

namespace tamp {

namespace fs = std::filesystem;
using crate::Json;

namespace {

constexpr const char* kJson = "application/json";
constexpr const char* kHdf5 = "application/x-hdf5";

/// The folder `out` and the file of its metadata on the way.
class Crate {
public:
  Crate(const Store& store, const Plan& plan, const CrateStatements& statements, fs::path out)
      : store_(store), plan_(plan), statements_(statements), out_(std::move(out)), graph_(out_ / crate::kMetadataFile) {
  }

  CrateContents write() {
    graph_.write("{\"@context\": [\"https://w3id.org/ro/crate/1.1/context\", "
                 "\"https://w3id.org/ro/terms/workflow-run/context\"],\n\"@graph\": [\n");
    graph_.write(crate::descriptor().dump());
    add(crate::profile());
    add_author();
    add_campaign_file();
    for (const PlannedJob& job : plan_.jobs)
      add_job(job);
    add_root();
    graph_.write("\n]}\n");
    graph_.finish();
    return contents_;
  }

private:
  void add(const Json& entity) {
    // A reason may quote the log of a child process, which may hold any bytes.
    graph_.write(",\n" + entity.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

  /// An entity that many others name, written once.
  void add_once(const Json& entity) {
    if (written_.insert(entity.at("@id")).second)
      add(entity);
  }

  /// A file that now lies in the crate; returns its @id.
  std::string add_file(const Json& entity) {
    add(entity);
    parts_.push_back(entity.at("@id"));
    return parts_.back();
  }

  void copy(const fs::path& from, const fs::path& path) const {
    fs::create_directories((out_ / path).parent_path());
    fs::copy_file(from, out_ / path);
  }

  void add_author() {
    if (statements_.author.empty())
      return;
    author_ = statements_.author_id.empty() ? "#author" : statements_.author_id;
    add({{"@id", author_}, {"@type", "Person"}, {"name", statements_.author}});
  }

  void add_campaign_file() {
    const fs::path name = fs::path(plan_.file).filename();
    const fs::path path = fs::path("campaigns") / name;
    copy(plan_.file, path);
    campaign_id_ = add_file(crate::file_entity(out_, path, fmt::format("campaign {}", plan_.campaign), kJson));
  }

  void add_job(const PlannedJob& job) {
    const std::string name = job_name(job.label, job.point, job.job.replicate);
    std::vector<std::string> inputs{campaign_id_};
    if (packings_.contains(job.job.parent))
      inputs.push_back(packing_id(job.job.parent));
    const std::vector<Record> attempts = store_.attempts(job.key);
    for (std::size_t n = 0; n < attempts.size(); ++n) {
      std::vector<std::string> results;
      // Only the latest attempt's packing is kept.
      if (n + 1 == attempts.size())
        results = add_packing(attempts[n], name);
      add_attempt(attempts[n], n + 1, name, inputs, std::move(results));
    }
    for (const Metric& metric : plan_.metrics)
      add_metric(metric, job.key, name);
  }

  void add_metric(const Metric& metric, const std::string& packing, const std::string& of) {
    std::vector<std::string> inputs{campaign_id_};
    if (packings_.contains(packing))
      inputs.push_back(packing_id(packing));
    const std::vector<Record> attempts = store_.attempts(metric_key(metric, packing));
    for (std::size_t n = 0; n < attempts.size(); ++n)
      add_attempt(attempts[n], n + 1, fmt::format("{} of {}", attempts[n].name, of), inputs, {});
  }

  static fs::path packing_path(const std::string& key) {
    return fs::path("packings") / key.substr(0, 2) / (key + ".h5");
  }
  static std::string packing_id(const std::string& key) { return crate::path_id(packing_path(key)); }

  /// The packing of a record, if it has one, and beside it what another program left; their @id.
  std::vector<std::string> add_packing(const Record& record, const std::string& name) {
    if (record.packing_file.empty() || !fs::exists(store_.packing_path(record.key)))
      return {};
    const fs::path path = packing_path(record.key);
    copy(store_.packing_path(record.key), path);
    if (file_sha256(out_ / path) != record.packing_sha256)
      throw Error(fmt::format("{} is damaged: its SHA-256 is not the one of its record (`tamp fsck` moves it aside)",
                              store_.packing_path(record.key).string()));
    packings_.insert(record.key);
    ++contents_.packings;
    std::vector<std::string> ids{
        add_file(crate::file_entity(out_, path, "packing of " + name, kHdf5, record.packing_sha256))};
    for (const fs::path& file : files_beside(record.key)) {
      const fs::path target = path.parent_path() / (record.key + ".files") / file.filename();
      copy(file, target);
      ids.push_back(add_file(crate::file_entity(out_, target, file.filename().string() + " of " + name, "text/plain")));
    }
    return ids;
  }

  /// Scripts and logs of a program that made a packing, by name.
  [[nodiscard]] std::vector<fs::path> files_beside(const std::string& key) const {
    std::vector<fs::path> files;
    const fs::path folder = store_.packing_path(key).replace_extension(".files");
    if (fs::is_directory(folder)) {
      for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.is_regular_file())
          files.push_back(entry.path());
      }
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  void add_attempt(const Record& record, std::size_t number, const std::string& what, std::vector<std::string> inputs,
                   std::vector<std::string> results) {
    const fs::path path = fs::path("records") / record.key.substr(0, 2) / fmt::format("{}-{}.json", record.key, number);
    fs::create_directories((out_ / path).parent_path());
    std::ofstream file(out_ / path, std::ios::binary);
    file << record_to_json(record);
    file.close();
    if (!file)
      throw Error(fmt::format("cannot write {}", (out_ / path).string()));
    results.push_back(add_file(crate::file_entity(out_, path, fmt::format("record of {}", what), kJson)));

    const crate::Software software = crate::software_of(record.provenance);
    for (const Json& requirement : software.requirements)
      add_once(requirement);
    add_once(software.program);
    add(crate::action({record, number, what, std::move(inputs), std::move(results), author_}));
    actions_.push_back(crate::action_id(record, number));
    ++contents_.attempts;
    contents_.failed += record.outcome == Outcome::ok ? 0U : 1U;
    latest_ = std::max(latest_, record.provenance.end_utc);
  }

  void add_root() {
    for (const Json& entity : license_.entities)
      add(entity);
    Json root{{"@id", "./"},
              {"@type", "Dataset"},
              {"conformsTo", crate::reference(std::string(crate::kProfile))},
              {"name", plan_.title.empty() ? plan_.campaign : plan_.title},
              {"description",
               fmt::format("Powder packings of the campaign {}, what was measured on them, and every run of tamp that "
                           "made them: {} packings, {} runs, of which {} did not end ok",
                           plan_.campaign, contents_.packings, contents_.attempts, contents_.failed)},
              {"datePublished", crate::crate_time(latest_)},
              {"license", license_.value}};
    if (!author_.empty())
      root["author"] = crate::reference(author_);
    root["hasPart"] = crate::references(parts_);
    root["mentions"] = crate::references(actions_);
    add(root);
  }

  const Store& store_;
  const Plan& plan_;
  const CrateStatements& statements_;
  fs::path out_;
  crate::License license_;
  FileWriter graph_;
  std::string author_;
  std::string campaign_id_;
  std::set<std::string> written_;
  std::set<std::string> packings_; ///< keys of those in the crate
  std::vector<std::string> parts_;
  std::vector<std::string> actions_;
  std::string latest_;
  CrateContents contents_;
};

} // namespace

CrateContents write_ro_crate(const Store& store, const Plan& plan, const CrateStatements& statements,
                             const fs::path& out) {
  if (std::none_of(plan.jobs.begin(), plan.jobs.end(), [&](const PlannedJob& job) { return store.has(job.key); }))
    throw InputError(fmt::format("nothing of the campaign {} is recorded in {}: `tamp run {}` runs it", plan.campaign,
                                 store.folder().string(), plan.file));
  crate::license_of(statements.license); // or throws, before anything is written
  if (!statements.author_id.empty() && !crate::is_address(statements.author_id))
    throw InputError(fmt::format("\"{}\" is no address of an author, as https://orcid.org/… is", statements.author_id));
  if (fs::exists(out) && !(fs::is_directory(out) && fs::is_empty(out)))
    throw InputError(fmt::format("{} exists already; a crate is written into a new folder", out.string()));
  try {
    fs::create_directories(out);
    return Crate(store, plan, statements, out).write();
  } catch (const std::exception& e) {
    std::error_code ignored;
    fs::remove_all(out, ignored); // half a crate would be in the way of the next try
    throw Error(e.what());
  }
}

} // namespace tamp
