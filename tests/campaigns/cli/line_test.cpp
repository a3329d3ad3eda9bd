// The command line itself: help, mistakes on it, texts written from tables, the job command.
#include "engine/schedule/process_executor.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

TEST_CASE("help teaches") {
  const Workshop shop(TAMP_BINARY);
  const Said said = shop.tamp("--help");
  CHECK(said.code == 0);
  for (const char* word : {"run", "plan", "status", "results", "report", "schema", "Exit codes", "First steps"})
    CHECK_THAT(said.out, Contains(word));
  for (const char* command : {"run", "plan", "status", "results", "report"}) {
    const Said help = shop.tamp(std::string(command) + " --help");
    CHECK(help.code == 0);
    CHECK_THAT(help.out, Contains("--store") && Contains("Example"));
  }
  CHECK_THAT(shop.tamp("--version").out, Contains("tamp "));
}

TEST_CASE("mistakes on the command line are input errors and write nothing") {
  const Workshop shop(TAMP_BINARY);
  for (const char* arguments : {"", "frobnicate", "run", "run --cores 0 x.json", "results --format xml", "results",
                                "status", "report x.json", "run absent.json", "job absent.job --out ."}) {
    const Said said = shop.tamp(arguments);
    CAPTURE(arguments, said.err);
    CHECK(said.code == (std::string(arguments).starts_with("job") ? 1 : 2));
    CHECK(said.err.starts_with("tamp: error: "));
    CHECK(fs::is_empty(shop.folder()));
  }
}

TEST_CASE("schema and reference are those of the tables") {
  const Workshop shop(TAMP_BINARY);
  CHECK(shop.tamp("schema").out == read_file(fs::path(TAMP_SOURCE_DIR) / "campaigns/schema.json"));
  CHECK(shop.tamp("reference").out == read_file(fs::path(TAMP_SOURCE_DIR) / "campaigns/reference.md"));
}

TEST_CASE("a job run by hand leaves its packing and its record, the same with any number of threads") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(40, 1, R"(, "metrics": [])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const auto rows = shop.results("tamp-store");
  const std::string key = rows.begin()->first;
  Job job;
  job.scene.dimension = 2;
  job.scene.size = {40};
  job.scene.psd.law = Law::monodisperse;
  job.scene.psd.radius = 1;
  job.scene = completed(job.scene);
  REQUIRE(job_key(job) == key);
  shop.write("it.job", canonical(job));
  for (const char* threads : {"1", "2"}) {
    const fs::path out = shop.folder() / threads;
    fs::create_directory(out);
    const Said said = shop.tamp(fmt::format("job it.job --out {0} --threads {0}", threads));
    CHECK(said.code == 0);
    CHECK((said.out + said.err).empty());
    CHECK(read_file(out / (key + ".h5")) ==
          read_file(shop.folder() / "tamp-store" / "packings" / key.substr(0, 2) / (key + ".h5")));
    const auto record = nlohmann::json::parse(read_file(out / (key + ".json")));
    CHECK(record.at("outcome") == "ok");
    CHECK(record.at("key") == key);
  }
}
