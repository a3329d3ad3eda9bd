// The flow graph in DOT: read back by a small parser, and by Graphviz where there is one.
#include "campaigns/cli/flow_dot.h"
#include "tests/campaigns/cli/tamp_command.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <regex>
#include <sstream>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;
using cli::FlowDetail;

namespace {

struct Drawn {
  std::map<std::string, std::string> nodes;                         ///< id → label
  std::map<std::pair<std::string, std::string>, std::size_t> edges; ///< with their counts
  std::size_t jobs() const {
    std::size_t sum = 0;
    for (const auto& [ends, count] : edges)
      sum += count;
    return sum;
  }
};

/// Reads what flow_dot writes; any other line fails the test.
Drawn read(const std::string& dot) {
  static const std::regex node(
      R"re(  (n\d+) \[label="((?:[^"\\]|\\.)*)", style="filled,(?:solid|dashed|dotted)", fillcolor="#[0-9A-Fa-f]+"\];)re");
  static const std::regex edge(R"re(  (n\d+) -> (n\d+)(?: \[label="(\d+)"\])?;)re");
  Drawn drawn;
  std::istringstream lines(dot);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line); ++number) {
    CAPTURE(line);
    std::smatch match;
    if (std::regex_match(line, match, node))
      CHECK(drawn.nodes.emplace(match[1], match[2]).second);
    else if (std::regex_match(line, match, edge))
      drawn.edges[{match[1], match[2]}] = match[3].matched ? std::stoul(match[3]) : 1;
    else
      CHECK((number < 4 || line == "}"));
  }
  for (const auto& [ends, count] : drawn.edges) {
    CHECK(drawn.nodes.contains(ends.first));
    CHECK(drawn.nodes.contains(ends.second));
  }
  return drawn;
}

} // namespace

TEST_CASE("any agenda is drawn with each of its jobs and dependences counted once") {
  const std::string seed = "flow";
  for (std::uint64_t i = 0; i < 20; ++i) {
    RandomStream random(seed, i);
    const std::vector<Plan> plans{random_plan(random, "a"), random_plan(random, "b")};
    const Agenda agenda = make_agenda(plans, [&](const std::string& key) {
      return key.back() == '1' ? std::optional(Outcome::failed) : std::nullopt;
    });
    std::size_t waiting = 0;
    for (const Item& item : agenda.items)
      waiting += item.after ? 1U : 0U;
    const Drawn jobs = read(cli::flow_dot(agenda, FlowDetail::jobs));
    CHECK(jobs.nodes.size() == agenda.items.size());
    CHECK(jobs.edges.size() == waiting);
    const Drawn methods = read(cli::flow_dot(agenda, FlowDetail::methods));
    CHECK(methods.jobs() == waiting);
    CHECK(methods.nodes.size() <= 1 + EnumNames<MetricName>::value.size());
  }
}

TEST_CASE("a campaign of any size is drawn as its methods and metrics, with how they stand") {
  Plan plan = mock_plan("a", 1000, 2);
  for (std::size_t i = 0; i < 1000; ++i) {
    plan.jobs[i].label = i < 600 ? "say \"D\\R\"" : "relaxed";
    plan.jobs[i].job.method.name = i < 600 ? MethodName::drop_and_roll : MethodName::drop_and_roll_me;
    if (i >= 600)
      plan.jobs[i].job.parent = plan.jobs[i - 600].key;
  }
  const std::vector<Plan> plans{plan};
  const Agenda agenda = make_agenda(plans, [](const std::string& key) {
    return key == "a0" ? std::optional(Outcome::ok) : key == "a1" ? std::optional(Outcome::time_limited) : std::nullopt;
  });
  const std::string dot = cli::flow_dot(agenda, FlowDetail::methods);
  CHECK(read(dot).nodes.size() == 4);
  CHECK_THAT(dot, Contains(R"(label="say \"D\\R\"\ndrop-and-roll\n2 recorded, 598 to run")") &&
                      Contains(R"(label="relaxed\ndrop-and-roll-me\n399 to run, 1 not possible")") &&
                      Contains(R"(label="hellinger\n998 to run, 2 not possible")") &&
                      Contains(R"(n0 -> n1 [label="600"])"));
}

TEST_CASE("tamp plan writes a graph that Graphviz draws") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2, R"(, "metrics": ["phi"])"));
  for (const std::string more : {"", " --dot-jobs"}) {
    const Said said = shop.tamp("plan discs.json --dot flow.dot" + more);
    CAPTURE(said.err);
    REQUIRE(said.code == 0);
    CHECK(read(read_file(shop.folder() / "flow.dot")).nodes.size() == (more.empty() ? 2 : 4));
    if (std::system("dot -V >/dev/null 2>&1") != 0) {
      WARN("Graphviz is not installed: its own reading of the graph is skipped");
      continue;
    }
    const std::string draw = fmt::format("dot -Tsvg '{0}/flow.dot' >'{0}/flow.svg'", shop.folder().string());
    CHECK(std::system(draw.c_str()) == 0);
    CHECK_THAT(read_file(shop.folder() / "flow.svg"), Contains("phi") && Contains("</svg>"));
  }
  CHECK(shop.tamp("plan discs.json --dot-jobs").code == 2);
}
