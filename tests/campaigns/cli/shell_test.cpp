// What helps people at a shell: completion in the real shells, and the logs of jobs.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

/// What a script prints in a shell.
std::string output_of(const Workshop& shop, const std::string& shell, const std::string& script) {
  shop.write("script", script);
  const std::string folder = shop.folder().string();
  REQUIRE(std::system(fmt::format("cd '{}' && {} script > said 2>&1", folder, shell).c_str()) == 0);
  return read_file(shop.folder() / "said");
}

} // namespace

TEST_CASE("bash completes commands, the options of a command, and files") {
  const Workshop shop(TAMP_BINARY);
  shop.write("completion", shop.tamp("completion bash").out);
  const auto complete = [&](const char* words, int at) {
    return output_of(shop, "bash",
                     fmt::format("set -eu\nsource ./completion\nCOMP_WORDS=({})\nCOMP_CWORD={}\n_tamp\n"
                                 "printf '%s\\n' ${{COMPREPLY[@]+\"${{COMPREPLY[@]}}\"}}",
                                 words, at));
  };
  CHECK(complete("tamp st", 1) == "status\n");
  CHECK_THAT(complete("tamp r", 1), Contains("run\n") && Contains("report\n") && Contains("results\n"));
  CHECK(complete("tamp run --retry", 2) == "--retry-limited\n");
  CHECK(complete("tamp status --retry", 2) == "\n"); // an option of another command
  CHECK(complete("tamp run compl", 2) == "completion\n");
  for (const char* command : {"run", "plan", "explain", "logs", "completion"})
    CHECK_THAT(complete("tamp ''", 1), Contains(command));
}

TEST_CASE("zsh takes the completion") {
  const Workshop shop(TAMP_BINARY);
  const std::string script = shop.tamp("completion zsh").out;
  CHECK_THAT(script, Contains("'run:Run what is missing of campaigns'") && Contains("--retry-limited:"));
  if (std::system("zsh --version > /dev/null 2>&1") != 0) {
    WARN("skipped: no program zsh");
    return;
  }
  shop.write("completion", script);
  CHECK_THAT(output_of(shop, "zsh -f",
                       "autoload -Uz compinit; compinit -u -D; source ./completion; print $_comps[tamp]\n"
                       "_describe() { print -l -- ${(P)2} }\nPREFIX=--re CURRENT=3 words=(tamp run --re); _tamp\n"),
             Contains("_tamp\n") && Contains("--retry-limited:"));
  CHECK(shop.tamp("completion fish").code == 2);
}

TEST_CASE("the log of a job tells its attempts and what it said") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(40, 1, R"(, "metrics": [])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const std::string key = shop.results("tamp-store").begin()->first;
  const Said said = shop.tamp("logs " + key.substr(0, 8));
  CHECK(said.code == 0);
  CHECK_THAT(said.out, Contains("# attempt 1: drop-and-roll, ") && Contains("said nothing"));
  fs::create_directories(shop.folder() / "tamp-store/logs" / key.substr(0, 2));
  shop.write("tamp-store/logs/" + key.substr(0, 2) + "/" + key + ".log", "a word of it");
  CHECK_THAT(shop.tamp("logs " + key).out, Contains("a word of it\n"));
  CHECK(shop.tamp("logs ffffffffffff").code == 2);
}
