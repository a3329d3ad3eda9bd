// Campaigns through the real command: run, run again, results, report, budgets, cores.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <set>

using namespace tamp::test;
using Catch::Contains;

TEST_CASE("a campaign runs, and running it again does nothing") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(40, 3));

  const Said plan = shop.tamp("plan discs.json");
  CHECK(plan.code == 0);
  CHECK_THAT(plan.out, Contains("0 recorded") && Contains("to run"));
  CHECK(digests(shop.folder()).size() == 1); // the campaign file alone

  const Said first = shop.tamp("run discs.json");
  CAPTURE(first.out, first.err);
  REQUIRE(first.code == 0);
  CHECK_THAT(first.err, Contains("replicate 2: ok, N = "));
  CHECK(first.err.find('\x1b') == std::string::npos); // plain lines, as this is no terminal
  const auto before = digests(shop.folder() / "tamp-store" / "packings");
  const auto results = shop.results("tamp-store");
  CHECK(before.size() == 3);
  CHECK(fs::is_empty(shop.folder() / "tamp-store" / "incoming"));

  const Said again = shop.tamp("run discs.json");
  CHECK(again.code == 0);
  CHECK_THAT(again.out, Contains("nothing to do") && Contains("jobs already recorded"));
  CHECK(digests(shop.folder() / "tamp-store" / "packings") == before);
  CHECK(shop.results("tamp-store") == results); // times included: nothing ran

  CHECK_THAT(shop.tamp("plan discs.json").out, Contains("recorded: ok") && Contains(", 0 to run"));
  CHECK_THAT(shop.tamp("status").out, Contains("discs (discs.json): 3 of 3 packings recorded: 3 ok"));
}

TEST_CASE("a method starts from the packing of another entry: after it, from its very packing, not where it has none") {
  const Workshop shop(TAMP_BINARY);
  const auto campaign = [](double size, const char* budget) {
    return fmt::format(R"({{"campaign": "chain", "scene": {{"dimension": 2, "size": {}, "psd": {{"law": "lognormal", )"
                       R"("mu_ln": 0, "sigma_ln": 0.5, "r_min": 0.3, "r_max": 4}}}}, "replicates": 2, "methods": [)"
                       R"({{"name": "drop-and-roll", "label": "bed"}}, )"
                       R"({{"name": "drop-and-roll-me", "label": "denser", "from": "bed"}}], {}"metrics": ["phi"]}})",
                       size, budget);
  };
  shop.write("chain.json", campaign(30, ""));
  const Said run = shop.tamp("run chain.json");
  CAPTURE(run.out, run.err);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.err, Contains("denser, replicate 1: ok"));
  std::size_t children = 0;
  const auto results = shop.results("tamp-store");
  for (const auto& [key, row] : results) {
    if (row.at("method") == "drop-and-roll-me") {
      CHECK(results.at(row.at("parent").get<std::string>()).at("method") == "drop-and-roll");
      ++children;
    }
  }
  CHECK(children == 2);
  CHECK_THAT(shop.tamp("run chain.json").out, Contains("nothing to do"));

  shop.write("poor.json", campaign(kLongEdge, R"("seed": 2, "budget": {"wall_s": 0.2}, )"));
  const Said poor = shop.tamp("run poor.json");
  CHECK(poor.code == 1);
  CHECK_THAT(poor.out, Contains("not possible, as their packing was not made"));

  shop.write("wrong.json", R"({"campaign": "w", "scene": {"size": 9, "psd": {"law": "monodisperse", "radius": 1}},
"methods": ["drop-and-roll", {"name": "drop-and-roll-me", "from": "drop-and-rol"}]})");
  const Said wrong = shop.tamp("run wrong.json");
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("at /methods/1/from: no entry further up has the label \"drop-and-rol\"") &&
                            Contains("nearest: drop-and-roll"));
}

TEST_CASE("a damaged packing is set aside when it is needed and made again by the next run") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 1, R"(, "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const auto before = digests(shop.folder() / "tamp-store" / "packings");
  for (const auto& entry : fs::recursive_directory_iterator(shop.folder() / "tamp-store" / "packings")) {
    if (entry.is_regular_file())
      fs::resize_file(entry.path(), 500);
  }
  shop.write("discs.json", disc_campaign(20, 1, R"(, "metrics": ["phi", "overlap"])"));
  const Said found = shop.tamp("run discs.json");
  CHECK(found.code == 1);
  CHECK_THAT(found.err, Contains("is damaged") && Contains("set aside"));
  CHECK(shop.tamp("run discs.json").code == 0);
  auto after = digests(shop.folder() / "tamp-store" / "packings");
  CHECK(after.size() == before.size() + 1); // the damaged one is kept
  for (const auto& [file, digest] : before)
    CHECK(after.at(file) == digest);
}

TEST_CASE("an added replicate runs alone") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const auto before = shop.results("tamp-store");
  shop.write("discs.json", disc_campaign(20, 3));
  const Said more = shop.tamp("run discs.json");
  CHECK(more.code == 0);
  CHECK(more.err.find("replicate 0") == std::string::npos);
  CHECK_THAT(more.err, Contains("replicate 2: ok"));
  auto after = shop.results("tamp-store");
  CHECK(after.size() == 3);
  for (const auto& [key, row] : before)
    CHECK(after.at(key) == row);
}

TEST_CASE("results have the stated form") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(30, 2, R"(, "metrics": ["phi", "overlap"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const auto rows = nlohmann::json::parse(shop.tamp("results --format json --campaign discs").out);
  REQUIRE(rows.size() == 2);
  for (const auto& row : rows) {
    CHECK(row.at("key").get<std::string>().size() == 64);
    CHECK(row.at("campaign") == "discs");
    CHECK(row.at("method") == "drop-and-roll");
    CHECK(row.at("scene").at("psd").at("law") == "monodisperse");
    CHECK(row.at("replicate").is_number_integer());
    CHECK(row.at("outcome") == "ok");
    CHECK(row.at("reason") == "");
    const auto& time = row.at("time");
    CHECK(time.at("wall_s").get<double>() > 0);
    CHECK(time.at("cpu_s").get<double>() > 0);
    CHECK(time.at("peak_rss_bytes").get<double>() > 1e6);
    CHECK(time.at("mode") == "shared");
    std::set<std::string> names;
    for (const auto& [name, measure] : row.at("measures").items()) {
      names.insert(name);
      CHECK(measure.at("value").is_number());
      CHECK(measure.at("unit").is_string());
    }
    for (const char* name : {"N", "phi", "overlap_max", "overlap_pairs"})
      CHECK(names.contains(name));
    const auto discs = row.at("measures").at("N").at("value").get<double>();
    CHECK(discs > 0.7 * 900 / M_PI); // at least a loose packing of unit discs
    CHECK(discs < 900 / M_PI);
  }
  const std::string csv = shop.tamp("results --format csv").out;
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
  CHECK(shop.tamp("results --campaign unknown").code == 2);
}

TEST_CASE("one and two cores give the same bytes") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(50, 4));
  REQUIRE(shop.tamp("run discs.json --cores 1 --store one").code == 0);
  REQUIRE(shop.tamp("run discs.json --cores 2 --store two").code == 0);
  CHECK(digests(shop.folder() / "one" / "packings") == digests(shop.folder() / "two" / "packings"));
  CHECK(without_times(shop.results("one")) == without_times(shop.results("two")));
}

TEST_CASE("exclusive timing is recorded as such") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2, R"(, "timing": "exclusive", "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  for (const auto& [key, row] : shop.results("tamp-store"))
    CHECK(row.at("time").at("mode") == "exclusive");
}

TEST_CASE("two campaigns in one store share their jobs") {
  const Workshop shop(TAMP_BINARY);
  shop.write("a.json", disc_campaign(20, 2));
  std::string other = disc_campaign(20, 3);
  other.replace(other.find("discs"), 5, "other");
  shop.write("b.json", other);
  const Said both = shop.tamp("run a.json b.json");
  CAPTURE(both.out, both.err);
  CHECK(both.code == 0);
  CHECK(digests(shop.folder() / "tamp-store" / "packings").size() == 3);
  CHECK_THAT(shop.tamp("status").out, Contains("2 of 2 packings") && Contains("3 of 3 packings"));
  CHECK(shop.tamp("run a.json a.json").code == 2); // one campaign, twice
}

TEST_CASE("a job over its budget is an outcome, and only --retry-limited tries it again") {
  const Workshop shop(TAMP_BINARY);
  const auto budget = [](const std::string& text) { return disc_campaign(kLongEdge, 1, ", \"budget\": " + text); };
  std::string outcome;
  std::string retried = "jobs run: 1";
  SECTION("time") {
    shop.write("discs.json", budget(R"({"wall_s": 0.2, "memory_mb": 2000})"));
    outcome = "time-limited";
  }
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they do not live under a limit of address space
  SECTION("memory") {
    shop.write("discs.json", budget(R"({"wall_s": 60, "memory_mb": 70})"));
    outcome = "memory-limited";
    retried = "nothing to do"; // with no more memory than before it would end alike
  }
#endif
  const Said said = shop.tamp("run discs.json");
  CAPTURE(said.out, said.err);
  CHECK(said.code == 1);
  CHECK_THAT(said.err, Contains(outcome));
  CHECK_THAT(shop.tamp("status").out, Contains(outcome));
  const auto results = shop.results("tamp-store");
  REQUIRE(results.size() == 1);
  CHECK(results.begin()->second.at("outcome") == outcome);

  const Said again = shop.tamp("run discs.json");
  CHECK(again.code == 1);
  CHECK_THAT(again.out, Contains("nothing to do"));
  CHECK_THAT(shop.tamp("run --retry-limited discs.json").out, Contains(retried));
}

TEST_CASE("a packing that was deleted is made again with the same bytes") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const fs::path packings = shop.folder() / "tamp-store" / "packings";
  const auto before = digests(packings);
  fs::remove(packings / before.begin()->first);
  CHECK(shop.tamp("run discs.json").code == 0);
  CHECK(digests(packings) == before);
}

TEST_CASE("a report is written from the store") {
  const Workshop shop(TAMP_BINARY);
  shop.write("powder.json", R"({"campaign": "powder", "scene": {"dimension": 2, "size": 60, "psd": {"law": "lognormal",
      "mu_ln": 0.3, "sigma_ln": 0.68, "r_min": 0.1, "r_max": 20}}, "methods": ["drop-and-roll"], "replicates": 2,
      "report": {"tables": ["lognormal_2d"]}})");
  REQUIRE(shop.tamp("run powder.json").code == 0);
  const Said said = shop.tamp("report powder.json --out tables");
  CAPTURE(said.err);
  CHECK(said.code == 0);
  CHECK(fs::file_size(shop.folder() / "tables" / "lognormal_2d.tex") > 0);
  CHECK_THAT(said.out, Contains("tables/report.md"));
}

TEST_CASE("the tables of the small campaign are what they were") {
  const Workshop shop(TAMP_BINARY);
  const std::string folder = std::string(TAMP_SOURCE_DIR) + "/tests/reference/";
  REQUIRE(shop.tamp("run '" + folder + "small.json'").code == 0);
  const Said same = shop.tamp("report '" + folder + "small.json' --check '" + folder + "small.csv'");
  CAPTURE(same.out, same.err);
  CHECK(same.code == 0);

  std::string text = tamp::read_file(folder + "small.csv");
  const std::string row = "\"D&R, this run\",phi_paper,0.";
  REQUIRE(text.find(row) != text.npos);
  text.insert(text.find(row) + row.size(), "1");
  shop.write("moved.csv", text);
  const Said moved = shop.tamp("report '" + folder + "small.json' --check moved.csv");
  CHECK(moved.code == 1);
  CHECK_THAT(moved.out, Contains("lognormal_2d, (a) The paper's columns: D&R, this run: phi_paper: expected 0.1"));
  CHECK(shop.tamp("report '" + folder + "small.json'").code == 2); // neither tables nor a check asked for
  CHECK(shop.tamp("report '" + folder + "small.json' --check '" + folder + "small.json'").code == 2);
}

TEST_CASE("a report of a damaged or strange store gives what it can and names the command for the rest") {
  const Workshop shop(TAMP_BINARY);
  const auto campaign = [](const char* name, double size, const char* metrics) {
    return fmt::format(R"({{"campaign": "{}", "scene": {{"dimension": 2, "size": {}, "psd": {{"law": "lognormal", )"
                       R"("mu_ln": 0.3, "sigma_ln": 0.68, "r_min": 0.1, "r_max": 15}}}}, "methods": )"
                       R"(["drop-and-roll"], "replicates": 2, {}"report": {{"tables": ["lognormal_2d"]}}}})",
                       name, size, metrics);
  };
  shop.write("known.json", campaign("known", 60, "\"metrics\": [\"phi\"], "));
  shop.write("wider.json", campaign("known", 60, ""));
  shop.write("other.json", campaign("other", 70, ""));
  REQUIRE(shop.tamp("run known.json").code == 0);
  const fs::path packings = shop.folder() / "tamp-store" / "packings";
  const auto files = digests(packings);
  REQUIRE(files.size() == 2);
  std::ofstream(packings / files.begin()->first) << "junk";
  fs::remove(packings / std::next(files.begin())->first);

  const auto page = [&](const std::string& file) {
    const Said said = shop.tamp("report " + file + " --out " + file + ".tables");
    CAPTURE(file, said.err);
    CHECK(said.code == 0);
    return tamp::read_file(shop.folder() / (file + ".tables") / "report.md");
  };
  CHECK_THAT(page("known.json"), Contains("n = 2") && !Contains("To run them"));
  CHECK_THAT(page("wider.json"), Contains("n = 2") && Contains("No record of 0 generation jobs") &&
                                     Contains("To run them: tamp run wider.json"));
  CHECK_THAT(page("other.json"), Contains("No record of 2 generation jobs") && Contains("tamp run other.json"));

  const Said none = shop.tamp("report known.json --store nowhere --out none");
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Contains("`tamp run` makes one"));
  CHECK_FALSE(fs::exists(shop.folder() / "none"));
}
