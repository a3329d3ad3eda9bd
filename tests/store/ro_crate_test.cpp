// RO-Crates against what RO-Crate 1.1 and Process Run Crate 0.5 require, and against the files they speak of.
#include "engine/base/files.h"
#include "store/ro_crate.h"
#include "store/ro_crate_entities.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <regex>
#include <set>

using namespace tamp;
namespace fs = std::filesystem;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

/// What a property of an entity has as its @id, one or several.
std::vector<std::string> ids_at(const Json& entity, const std::string& property) {
  std::vector<std::string> ids;
  if (!entity.contains(property))
    return ids;
  const Json& value = entity.at(property);
  for (const Json& one : value.is_array() ? value : Json::array({value})) {
    if (one.is_object())
      ids.push_back(one.at("@id"));
  }
  return ids;
}

bool has_text(const Json& entity, const std::string& property) {
  return entity.contains(property) && entity.at(property).is_string() &&
         !entity.at(property).get<std::string>().empty();
}

/// Each requirement of the two specifications that the crate does not meet, as a sentence. Here and not in the program,
/// so that what is written is judged by what was read in the specifications.
class Requirements {
public:
  explicit Requirements(const Json& document) {
    for (const Json& entity : document.at("@graph")) {
      need(has_text(entity, "@id") && has_text(entity, "@type"), "an entity without @id or @type");
      need(entities_.emplace(entity.at("@id"), entity).second, "two entities " + entity.at("@id").dump());
    }
    need(document.at("@context") ==
             Json::array({"https://w3id.org/ro/crate/1.1/context", "https://w3id.org/ro/terms/workflow-run/context"}),
         "the contexts of both specifications");
    descriptor();
    root();
    for (const auto& [id, entity] : entities_) {
      const std::string type = entity.at("@type");
      if (type == "CreateAction")
        action(id, entity);
      if (type == "SoftwareApplication")
        need(has_text(entity, "name") && has_text(entity, "softwareVersion"), id + ": name, version");
      if (type == "File")
        file(id, entity);
      for (const auto& [property, value] : entity.items())
        for (const std::string& other : ids_at(entity, property))
          need(entities_.contains(other) || other == "https://w3id.org/ro/crate/1.1",
               id + " names the absent " + other);
    }
  }

  std::vector<std::string> broken;

private:
  void need(bool met, const std::string& what) {
    if (!met)
      broken.push_back(what);
  }
  void descriptor() {
    const Json& entity = entities_["ro-crate-metadata.json"];
    need(entity.value("@type", "") == "CreativeWork", "descriptor: @type");
    need(ids_at(entity, "about") == std::vector<std::string>{"./"}, "descriptor: about");
    need(ids_at(entity, "conformsTo") == std::vector<std::string>{"https://w3id.org/ro/crate/1.1"},
         "descriptor: conformsTo");
  }
  void root() {
    root_ = entities_["./"];
    need(root_.value("@type", "") == "Dataset", "root: @type");
    need(has_text(root_, "name") && has_text(root_, "description"), "root: name, description");
    need(is_time(root_.value("datePublished", "")), "root: datePublished");
    need(root_.contains("license"), "root: license");
    for (const std::string& license : ids_at(root_, "license"))
      need(has_text(entities_[license], "name") && has_text(entities_[license], "description"), "licence: name");
    need(ids_at(root_, "conformsTo") == std::vector<std::string>{"https://w3id.org/ro/wfrun/process/0.5"},
         "root: conformsTo");
    need(entities_["https://w3id.org/ro/wfrun/process/0.5"].value("@type", "") == "CreativeWork", "profile: @type");
    for (const std::string& id : ids_at(root_, "hasPart"))
      parts_.insert(id);
    for (const std::string& id : ids_at(root_, "mentions"))
      mentions_.insert(id);
  }
  void action(const std::string& id, const Json& entity) {
    const std::vector<std::string> tools = ids_at(entity, "instrument");
    need(tools.size() == 1 && entities_[tools[0]].value("@type", "") == "SoftwareApplication", id + ": instrument");
    need(mentions_.contains(id), id + ": mentioned by the root");
    need(has_text(entity, "name") && has_text(entity, "description"), id + ": name, description");
    need(is_time(entity.value("endTime", "")) && is_time(entity.value("startTime", "")), id + ": times");
    need(!ids_at(entity, "result").empty(), id + ": result");
    for (const char* property : {"object", "result"})
      for (const std::string& file : ids_at(entity, property))
        need(entities_[file].value("@type", "") == "File", id + ": " + property + " is a file");
    const std::string status = entity.value("actionStatus", "");
    const bool failed = status == "http://schema.org/FailedActionStatus";
    need(failed || status == "http://schema.org/CompletedActionStatus", id + ": actionStatus");
    need(failed == has_text(entity, "error"), id + ": error with a failed status, and only with it");
    for (const std::string& agent : ids_at(entity, "agent"))
      need(entities_[agent].value("@type", "") == "Person", id + ": agent");
  }
  void file(const std::string& id, const Json& entity) {
    need(parts_.contains(id), id + ": part of the root");
    need(has_text(entity, "name") && has_text(entity, "encodingFormat") && has_text(entity, "contentSize") &&
             has_text(entity, "sha256"),
         id + ": name, format, size, checksum");
  }
  static bool is_time(const std::string& text) {
    static const std::regex form(R"(\d{4}-\d{2}-\d{2}T\d{2}:\d{2}:\d{2}\.\d{3}\+00:00)");
    return std::regex_match(text, form);
  }

  std::map<std::string, Json> entities_;
  Json root_;
  std::set<std::string> parts_;
  std::set<std::string> mentions_;
};

/// A store with two jobs: one that crashed before it went well, with a metric and files of another program; one that
/// ran out of time. A third one has not run.
class Example {
public:
  Example() : store_(Store::open(folder_ / "store", Store::Mode::create)) {
    plan_ = example_plan("discs", 3);
    plan_.metrics[0] = {.name = MetricName::phi};
    plan_.file = folder_ / "my discs.json";
    std::ofstream(plan_.file) << "{}";

    Record crashed = example_record(0);
    crashed.outcome = Outcome::crashed;
    crashed.reason = "signal 11; last words: \xff\"";
    crashed.measures.clear();
    crashed.provenance.start_utc = "2024-05-17T07:00:00Z"; // else it would count as the run that follows
    store_.put(crashed);
    leave_result(store_.incoming(), example_record(0), example_packing(2, 30));
    const std::string key = crashed.key;
    store_.import_result(store_.incoming() / (key + ".json"), store_.incoming() / (key + ".h5"));
    const fs::path beside = store_.packing_path(key).replace_extension(".files");
    fs::create_directory(beside);
    std::ofstream(beside / "in.lmp") << "run 1\n";
    store_.put(example_metric_record(plan_.metrics[0], key, {{"phi", 0.8, "1"}}));
    Record late = example_record(1);
    late.outcome = Outcome::time_limited;
    late.reason = "not done after 1 s";
    late.provenance.commit = "fedcba9876543210";
    late.provenance.end_utc = "2024-05-18T00:00:00Z";
    store_.put(late);
  }
  CrateContents write(const std::string& name, const CrateStatements& statements = {}) const {
    return write_ro_crate(store_, plan_, statements, folder_ / name);
  }
  Json graph(const std::string& name) const {
    return Json::parse(read_file(folder_ / name / "ro-crate-metadata.json"));
  }

  ScratchFolder folder_;
  Store store_;
  Plan plan_;
};

std::map<std::string, Json> by_id(const Json& document) {
  std::map<std::string, Json> found;
  for (const Json& entity : document.at("@graph"))
    found[entity.at("@id")] = entity;
  return found;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      found[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
  }
  return found;
}

} // namespace

TEST_CASE("a crate has every property that its specifications ask for") {
  const Example example;
  const auto statements =
      GENERATE(CrateStatements{}, CrateStatements{"CC-BY-4.0", "Somebody", ""},
               CrateStatements{"https://example.org/licence", "Somebody", "https://orcid.org/0000-0000-0000-0000"});
  const CrateContents contents = example.write("crate", statements);
  CHECK(contents.packings == 1);
  CHECK(contents.attempts == 4);
  CHECK(contents.failed == 2);
  CHECK(Requirements(example.graph("crate")).broken == std::vector<std::string>{});
}

TEST_CASE("the requirements are noticed when they are not met") {
  const Example example;
  example.write("crate", {"CC-BY-4.0", "", ""});
  const Json good = example.graph("crate");
  // Each property that a MUST or SHOULD asks for, taken from each entity that has it.
  for (std::size_t i = 0; i < good.at("@graph").size(); ++i) {
    for (const char* property :
         {"conformsTo", "about", "name", "description", "datePublished", "license", "instrument", "endTime", "result",
          "mentions", "hasPart", "actionStatus", "softwareVersion", "sha256"}) {
      Json spoilt = good;
      // The profile's own name is not required.
      if (spoilt["@graph"][i].at("@id") == "https://w3id.org/ro/wfrun/process/0.5" ||
          spoilt["@graph"][i].erase(property) == 0 ||
          (property == std::string("description") && good["@graph"][i]["@type"] == "SoftwareApplication"))
        continue;
      CAPTURE(property, good["@graph"][i]["@id"]);
      CHECK_FALSE(Requirements(spoilt).broken.empty());
    }
  }
}

TEST_CASE("every file of a crate is told with its size and checksum, and none else") {
  const Example example;
  example.write("crate");
  std::map<std::string, std::string> files = files_in(example.folder_ / "crate");
  CHECK(files.erase("ro-crate-metadata.json") == 1);
  for (const auto& [id, entity] : by_id(example.graph("crate"))) {
    if (entity.at("@type") != "File")
      continue;
    const std::string path = std::regex_replace(id, std::regex("%20"), " ");
    CAPTURE(path);
    REQUIRE(files.contains(path));
    CHECK(entity.at("contentSize") == std::to_string(files.at(path).size()));
    CHECK(entity.at("sha256") == sha256_hex(files.at(path)));
    files.erase(path);
  }
  CHECK(files.empty());
}

TEST_CASE("each attempt is an action with its program, its inputs and what came of it") {
  const Example example;
  example.write("crate");
  const auto entities = by_id(example.graph("crate"));
  const std::string key = example.plan_.jobs[0].key;
  const std::string metric = metric_key(example.plan_.metrics[0], key);
  const std::string packing = fmt::format("packings/{}/{}.h5", key.substr(0, 2), key);

  const Json& crashed = entities.at(fmt::format("#{}-1", key));
  CHECK_THAT(crashed.at("error").get<std::string>(), Contains("crashed: signal 11"));
  CHECK(ids_at(crashed, "object") == std::vector<std::string>{"campaigns/my%20discs.json"});
  CHECK(ids_at(crashed, "result") ==
        std::vector<std::string>{fmt::format("records/{}/{}-1.json", key.substr(0, 2), key)});

  const Json& made = entities.at(fmt::format("#{}-2", key));
  CHECK(ids_at(made, "result").front() == packing);
  CHECK(ids_at(made, "result").size() == 3);
  CHECK(made.at("startTime") == "2024-05-17T08:09:10.123+00:00");
  CHECK(entities.at(ids_at(made, "instrument").front()).at("softwareVersion") == "0123456789abcdef+changed");
  CHECK(ids_at(entities.at(fmt::format("#{}-1", metric)), "object").back() == packing);

  const Json& late = entities.at(fmt::format("#{}-1", example.plan_.jobs[1].key));
  CHECK(ids_at(late, "instrument") != ids_at(made, "instrument"));
  CHECK(entities.at("./").at("datePublished") == "2024-05-18T00:00:00.000+00:00");
  CHECK_FALSE(entities.contains(fmt::format("#{}-1", example.plan_.jobs[2].key)));

  // The record in the crate is the record of the store.
  const Record stored = example.store_.attempts(key).at(1);
  CHECK(read_file(example.folder_ / fmt::format("crate/records/{}/{}-2.json", key.substr(0, 2), key)) ==
        text_of(stored));
}

TEST_CASE("the same store gives the same crate, byte for byte") {
  const Example example;
  example.write("one", {"CC0-1.0", "A", ""});
  example.write("two", {"CC0-1.0", "A", ""});
  CHECK(files_in(example.folder_ / "one") == files_in(example.folder_ / "two"));
}

TEST_CASE("a crate is refused where it cannot be made, and leaves nothing behind") {
  Example example;
  const auto refused = [&](const CrateStatements& statements, const std::string& message) {
    CHECK_THROWS_WITH(example.write("crate", statements), Contains(message));
    CHECK_FALSE(fs::exists(example.folder_ / "crate"));
  };
  refused({"my licence", "", ""}, "neither an SPDX identifier");
  refused({"", "A", "not an address"}, "no address of an author");
  {
    const fs::path packing = example.store_.packing_path(example.plan_.jobs[0].key);
    std::ofstream(packing, std::ios::app) << "x";
    refused({}, "is damaged");
  }
  example.plan_.jobs.erase(example.plan_.jobs.begin(), example.plan_.jobs.begin() + 2);
  refused({}, "nothing of the campaign discs is recorded");
  const Example full;
  full.write("crate");
  CHECK_THROWS_WITH(full.write("crate"), Contains("exists already"));
}

TEST_CASE("times come in one form, and paths as addresses may be written") {
  CHECK(crate::crate_time("2024-05-17T08:09:10.123456Z") == "2024-05-17T08:09:10.123+00:00");
  CHECK(crate::crate_time("2024-05-17T08:09:10.5Z") == "2024-05-17T08:09:10.500+00:00");
  CHECK(crate::crate_time("2024-05-17T08:09:10Z") == "2024-05-17T08:09:10.000+00:00");
  CHECK(crate::path_id("a b/ü%.h5") == "a%20b/%C3%BC%25.h5");
}
