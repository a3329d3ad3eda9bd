// The checked-in schema and reference page, and the campaigns beside them. With TAMP_REGENERATE set, the test
// "[generated]" writes schema.json and reference.md anew instead of comparing them.
#include "campaigns/json_document.h"
#include "campaigns/reference.h"
#include "campaigns/schema.h"
#include "engine/base/files.h"
#include "tests/campaigns/campaign_text.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace tamp::test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kFolder = fs::path(TAMP_SOURCE_DIR) / "campaigns";

/// The campaigns beside the schema, sorted.
std::vector<fs::path> campaigns() {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".json" && entry.path().filename() != "schema.json")
      out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

void compare(const std::string& name, const std::string& text) {
  if (std::getenv("TAMP_REGENERATE") != nullptr)
    write_atomically(kFolder / name, text);
  INFO("campaigns/" << name << " is stale; write it anew: TAMP_REGENERATE=1 test_campaigns '[generated]'");
  CHECK((read_file(kFolder / name) == text));
}

/// Judges documents with Python's jsonschema, an implementation of its own.
class Validator {
public:
  Validator() {
    std::ofstream(folder_ / "schema.json") << schema_json();
    std::ofstream(folder_ / "check.py") << "import json, sys, jsonschema\n"
                                           "schema = json.load(open(sys.argv[1]))\n"
                                           "jsonschema.Draft202012Validator.check_schema(schema)\n"
                                           "judge = jsonschema.Draft202012Validator(schema)\n"
                                           "for line in open(sys.argv[2]):\n"
                                           "    print(int(judge.is_valid(json.loads(line))))\n";
  }

  static bool available() { return std::system("python3 -c 'import jsonschema' > /dev/null 2>&1") == 0; }

  /// Whether the schema holds for each document.
  std::vector<bool> valid(const std::vector<std::string>& texts) const {
    std::ofstream documents(folder_ / "documents");
    for (const std::string& text : texts)
      documents << Json::parse(text, nullptr, true, true).dump() << '\n';
    documents.close();
    const std::string command =
        fmt::format("cd '{}' && python3 check.py schema.json documents > verdicts", folder_.path().string());
    REQUIRE(std::system(command.c_str()) == 0);
    std::vector<bool> out;
    for (const char c : read_file(folder_ / "verdicts")) {
      if (c != '\n')
        out.push_back(c == '1');
    }
    REQUIRE(out.size() == texts.size());
    return out;
  }

private:
  ScratchFolder folder_;
};

} // namespace

TEST_CASE("the checked-in schema and reference page are what the tables say", "[generated]") {
  compare("schema.json", schema_json());
  compare("reference.md", reference_page());
}

TEST_CASE("every reference of the schema has its definition") {
  const Json schema = Json::parse(schema_json());
  const Json flat = schema.flatten();
  std::size_t count = 0;
  for (const auto& [path, value] : flat.items()) {
    if (path.size() > 5 && path.substr(path.size() - 5) == "/$ref") {
      INFO(value);
      CHECK(schema.contains(Json::json_pointer(value.get<std::string>().substr(1))));
      ++count;
    }
  }
  CHECK(count > 50);
}

TEST_CASE("the schema accepts every checked-in campaign and refuses mistakes that it can see") {
  if (!Validator::available()) {
    WARN("python3-jsonschema is missing: the campaigns are NOT checked against the schema");
    return;
  }
  std::vector<std::string> good = {kValid};
  for (const fs::path& file : campaigns())
    good.push_back(read_file(file));
  good.push_back(
      valid_with("{\"grid\": {\"scene/psd/sigma_ln\": [0.6, 0.68]}}",
                 R"([{"points": [{"scene/size": [133, 133, 150], "method/lid": false}]}, {"zip": {"seed": [1]}}])"));
  const std::string unswept = with(kValid, "  \"sweep\": {\"grid\": {\"scene/psd/sigma_ln\": [0.6, 0.68]}},\n", "");
  good.push_back(unswept);
  const std::vector<std::string> bad = {
      "[]",
      "{}",
      valid_with("\"replicates\"", "\"replicate\""),
      valid_with("133", "\"133 um\""),
      valid_with("133", "-133"),
      valid_with("133", "[133, 0]"),
      valid_with("[0.6, 0.68]", "[]"),
      valid_with("[0.6, 0.68]", "[0.6, -0.68]"),
      valid_with("scene/psd/sigma_ln", "scene/psd/sigma"),
      valid_with("\"drop-and-roll\"", "\"drop-and-rol\""),
      valid_with("\"drop-and-roll\"", R"({"name": "lattice", "max_failures": 3})"),
      valid_with("\"lognormal\"", "\"lognormale\""),
      valid_with("\"replicates\": 2", "\"replicates\": 0"),
      valid_with("\"replicates\": 2", "\"report\": {\"tables\": [\"lognormal\"]}"),
      valid_with("\"replicates\": 2", "\"metrics\": [{\"name\": \"phi\", \"bins\": 3}]"),
      valid_with("\"replicates\": 2", "\"budget\": {\"wall_s\": 0}"),
      with(unswept, "\"r_min\"", "\"shape\": 2, \"r_min\""), // no parameter of the lognormal law
  };
  const Validator validator;
  const auto accepted = validator.valid(good);
  for (std::size_t i = 0; i < good.size(); ++i) {
    INFO(good[i]);
    CHECK(accepted[i]);
    CHECK(error_of(good[i]).empty());
  }
  const auto refused = validator.valid(bad);
  for (std::size_t i = 0; i < bad.size(); ++i) {
    INFO(bad[i]);
    CHECK_FALSE(refused[i]);
    CHECK_FALSE(error_of(bad[i]).empty());
  }
}

TEST_CASE("the reference page has a row for every parameter") {
  const std::string page = reference_page();
  for (const char* path : {"`scene/psd/large_volume_fraction`", "`scene/psd/file`", "`method/max_failures`", "`bins`",
                           "`budget/wall_s`", "`timing`", "`replicates`", "`lognormal_2d`"}) {
    INFO(path);
    CHECK(page.find(path) != std::string::npos);
  }
}

} // namespace tamp::test
