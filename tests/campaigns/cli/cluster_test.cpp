// Campaigns through the job arrays of a real Slurm on this machine; skipped where there is none.
#include "store/store.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <set>
#include <utility>

using namespace tamp::test;
using Catch::Contains;

namespace {

std::string shell(const std::string& script) {
  const tamp::ScratchFolder scratch;
  const auto result =
      tamp::run_process({.argv = {"/bin/bash", "-c", script}, .log = scratch / "out", .limits = {.wall_s = 200}});
  return result.succeeded() ? tamp::read_file(scratch / "out") : "failed: " + tamp::read_file(scratch / "out");
}

/// A private cluster with two processors, for as long as it lives.
class Cluster {
public:
  Cluster() {
    ::setenv("SLURM_CONF", (folder_ / "etc/slurm.conf").c_str(), 1);
    up();
  }
  ~Cluster() {
    shell(tool("slurm-down") + " -p " + folder_.string());
    ::unsetenv("SLURM_CONF");
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  void up() { REQUIRE_THAT(shell(tool("slurm-up") + " -I -c 2 -m 2000 " + folder_.string()), !Contains("failed: ")); }
  /// The controller dies without a word.
  void kill_controller() const { shell("kill -9 $(cat " + (folder_ / "run/slurmctld.pid").string() + ")"); }

private:
  static std::string tool(const std::string& name) { return std::string(TAMP_SOURCE_DIR) + "/tests/support/" + name; }
  fs::path folder_ = "/tmp/tamp-slurm-" + std::to_string(::getpid());
};

/// The cluster, unless Slurm or the means to start it are absent.
std::unique_ptr<Cluster> try_cluster() {
  const std::string have =
      shell("PATH=$PATH:/usr/sbin:/sbin; for c in munged slurmctld slurmd sbatch squeue scancel; do "
            "command -v $c >/dev/null || { echo missing; exit; }; done; echo there");
  if (have != "there\n") {
    WARN("skipped: Slurm or munge is not installed");
    return nullptr;
  }
  return std::make_unique<Cluster>();
}

constexpr const char* kProfile = R"({"bundle_wall_s": 60, "bundle_jobs": 3, "memory_overhead_mb": 50, "settle_s": 2})";

/// One element a job.
constexpr const char* kSingly = R"({"bundle_jobs": 1, "memory_overhead_mb": 50, "settle_s": 2})";

/// A program in the place of LAMMPS whose processes keep within the limit of each, but not together within the job's.
constexpr const char* kHoarder = R"(#!/bin/sh
for i in 1 2 3 4; do head -c 150000000 /dev/zero | tail | sleep 60 & done
wait
)";

/// Beds, and denser packings made of them; some 10 discs a packing.
std::string chain(int replicates, const std::string& more = "") {
  return fmt::format(R"({{"campaign": "chain", "scene": {{"dimension": 2, "size": 30, "psd": {{"law": "lognormal", )"
                     R"("mu_ln": 0, "sigma_ln": 0.5, "r_min": 0.3, "r_max": 4}}}}, "replicates": {}, "methods": [)"
                     R"({{"name": "drop-and-roll", "label": "bed"}}, {{"name": "drop-and-roll-me", "label": "denser", )"
                     R"("from": "bed"}}], "budget": {{"wall_s": 20, "memory_mb": 400}}, "metrics": ["phi"]{}}})",
                     replicates, more);
}

/// Commands of Slurm as small scripts in front of the real ones: no job is known, and sbatch does what the test says.
class FakeSlurm {
public:
  explicit FakeSlurm(const std::string& sbatch) {
    write("scontrol", "echo 'MaxArraySize = 1001'");
    write("squeue", ":");
    write("sacct", "exit 1");
    write("sbatch", sbatch);
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  ~FakeSlurm() { ::setenv("PATH", path_.c_str(), 1); }
  FakeSlurm(const FakeSlurm&) = delete;
  FakeSlurm& operator=(const FakeSlurm&) = delete;

private:
  void write(const std::string& name, const std::string& script) {
    std::ofstream(folder_ / name) << "#!/bin/bash\n" << script << "\n";
    fs::permissions(folder_ / name, fs::perms::all);
  }
  std::string path_ = std::getenv("PATH");
  tamp::ScratchFolder folder_;
};

/// For sbatch: runs the only element of an array at once.
constexpr const char* kRunIt = R"(for word; do case $word in --job-name=*) SLURM_JOB_NAME=${word#*=};; esac; done
export SLURM_JOB_NAME SLURM_ARRAY_TASK_ID=0
/bin/sh "$word" >/dev/null
)";

/// Budget of jobs that share one element.
constexpr const char* kBrief = R"(, "budget": {"wall_s": 20})";

} // namespace

TEST_CASE("an array that Slurm may have taken unanswered is looked after, one that it refused is forgotten") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2, kBrief));
  shop.write("profile.json", R"({"patience_s": 0, "settle_s": 0})");
  {
    const FakeSlurm slurm(kRunIt + std::string("echo 'Unable to contact slurm controller' >&2; exit 1"));
    const Said said = shop.tamp("submit discs.json --profile profile.json");
    CHECK(said.code == 1);
    CHECK_THAT(said.err, Contains("Unable to contact slurm controller"));
    const Said collected = shop.tamp("collect --no-metrics");
    CAPTURE(collected.out, collected.err);
    CHECK(collected.code == 0);
    CHECK_THAT(collected.out, Contains("collected: 2 (2 ok)"));
  }
  shop.write("discs.json", disc_campaign(21, 2, kBrief));
  const FakeSlurm slurm("echo 'invalid partition specified' >&2; exit 1");
  for (int time = 0; time < 2; ++time) {
    const Said said = shop.tamp("submit discs.json --profile profile.json");
    CHECK(said.code == 1);
    CHECK_THAT(said.err, Contains("invalid partition"));
    CHECK(said.out.empty()); // nothing is said to be on the cluster
    CHECK(fs::is_empty(shop.folder() / "tamp-store" / "cluster"));
  }
}

TEST_CASE("a result that cannot be taken in stays until it can be") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 3, kBrief));
  shop.write("profile.json", R"({"settle_s": 0})");
  const FakeSlurm slurm(kRunIt + std::string("echo 7"));
  REQUIRE(shop.tamp("submit discs.json --profile profile.json").code == 0);
  const fs::path store = shop.folder() / "tamp-store";
  const fs::path submission = fs::directory_iterator(store / "cluster")->path();
  std::set<fs::path> in_the_way; // files where the folders of the packings would have to be
  for (const auto& entry : fs::directory_iterator(submission / "attempts"))
    in_the_way.insert(store / "packings" / entry.path().filename().string().substr(0, 2));
  for (const fs::path& file : in_the_way)
    std::ofstream(file) << "no folder";
  for (int time = 0; time < 2; ++time) {
    const Said said = shop.tamp("collect --wait --no-metrics");
    CAPTURE(said.out, said.err);
    CHECK(said.code == 1);
    CHECK_THAT(said.out, Contains("collected: 0") && Contains("not taken in: 3"));
    CHECK_THAT(said.err, Contains("cannot be taken in and stays where it is"));
  }
  for (const fs::path& file : in_the_way)
    fs::remove(file);
  const Said said = shop.tamp("collect --no-metrics");
  CAPTURE(said.out, said.err);
  CHECK(said.code == 0);
  CHECK_THAT(said.out, Contains("collected: 3 (3 ok)"));
  CHECK(fs::is_empty(store / "cluster"));
}

TEST_CASE("a campaign through Slurm gives the records of a local run", "[slow]") {
  const auto cluster = try_cluster();
  if (!cluster)
    return;
  const Workshop shop(TAMP_BINARY);
  shop.write("profile.json", kProfile);

  SECTION("with parents, bundles and a controller that is killed and comes back") {
    shop.write("chain.json", chain(7));
    REQUIRE(shop.tamp("run chain.json --store here").code == 0);
    const Said submitted = shop.tamp("submit chain.json --executor slurm --profile profile.json --store there");
    CAPTURE(submitted.out, submitted.err);
    REQUIRE(submitted.code == 0);
    CHECK_THAT(submitted.out, Contains("14 jobs in 2 arrays") && Contains(": 3 elements"));
    CHECK_THAT(shop.tamp("submit chain.json --profile profile.json --store there").out,
               Contains("on the cluster already: 14 jobs") && Contains("nothing to submit"));
    std::this_thread::sleep_for(std::chrono::seconds(6)); // what it was told in its last seconds it may forget
    cluster->kill_controller();
    cluster->up();

    const Said collected = shop.tamp("collect --wait --store there");
    CAPTURE(collected.out, collected.err);
    CHECK(collected.code == 0);
    CHECK_THAT(collected.out, Contains("collected: 14 (14 ok)") && Contains("metrics: 14 ok"));
    CHECK(digests(shop.folder() / "here" / "packings") == digests(shop.folder() / "there" / "packings"));
    CHECK(without_times(shop.results("here")) == without_times(shop.results("there")));
    CHECK(fs::is_empty(shop.folder() / "there" / "cluster"));
    CHECK_THAT(shop.tamp("run chain.json --store there").out, Contains("nothing to do"));
    CHECK_THAT(shop.tamp("collect --store there").out, Contains("nothing is on a cluster"));
  }

  SECTION("with a job over its time, one cancelled while it waits and one cancelled while it runs") {
    shop.write("long.json", disc_campaign(kLongEdge, 1, R"(, "budget": {"wall_s": 2, "memory_mb": 1000})"));
    REQUIRE(shop.tamp("submit long.json --profile profile.json --store limited").code == 0);
    const Said limited = shop.tamp("collect --wait --store limited");
    CHECK(limited.code == 1);
    CHECK_THAT(limited.out, Contains("time-limited: not done after 2 s"));
    CHECK_THAT(shop.tamp("submit long.json --store limited").out, Contains("nothing to submit")); // it would end alike

    // Two run, the third waits: the cluster has two processors.
    shop.write("three.json", disc_campaign(kLongEdge, 3, R"(, "budget": {"wall_s": 300, "memory_mb": 600})"));
    REQUIRE(shop.tamp("submit three.json --profile profile.json --store there").code == 0);
    REQUIRE(wait_until([] { return shell("squeue -h -r -t RUNNING -o %K").size() == 4; }));
    const std::string job = shell("squeue -h -r -t PENDING -o %F | head -n 1 | tr -d '\\n'");
    shell("scancel " + job + "_2; scancel " + job + "_0; scancel " + job + "_1");
    const Said collected = shop.tamp("collect --wait --store there");
    CAPTURE(collected.out, collected.err);
    CHECK(collected.code == 1);
    CHECK_THAT(collected.out, Contains("collected: 3"));
    for (const auto& [key, row] : shop.results("there"))
      CHECK_THAT(row.at("outcome").get<std::string>(), Catch::Equals("cancelled") || Catch::Equals("lost"));

    // The same command goes on with them, and so does a local run.
    const Said again = shop.tamp("submit three.json --profile profile.json --store there");
    CHECK_THAT(again.out, Contains("submitted: 3 jobs"));
    shell("scancel --name=$(squeue -h -o %j | head -n 1)");
    CHECK(shop.tamp("collect --wait --store there").code == 1);
  }

  SECTION("with an element that is cancelled while it waits, and runs when it is submitted again") {
    shop.write("profile.json", kSingly);
    shop.write("discs.json", disc_campaign(20, 3, R"(, "budget": {"wall_s": 20, "memory_mb": 400})"));
    REQUIRE(shop.tamp("run discs.json --store here").code == 0);
    shell("scontrol update NodeName=ALL State=DRAIN Reason=test"); // nothing starts
    REQUIRE(shop.tamp("submit discs.json --profile profile.json --store there").code == 0);
    shell("scancel $(squeue -h -r -t PENDING -o %F | head -n 1)_1");
    shell("scontrol update NodeName=ALL State=RESUME");
    const Said first = shop.tamp("collect --wait --store there");
    CAPTURE(first.out, first.err);
    CHECK(first.code == 1);
    CHECK_THAT(first.out, Contains("collected: 3 (2 ok, 1 "));

    CHECK_THAT(shop.tamp("submit discs.json --profile profile.json --store there").out, Contains("submitted: 1 jobs"));
    const Said second = shop.tamp("collect --wait --store there");
    CAPTURE(second.out, second.err);
    CHECK(second.code == 0);
    CHECK(digests(shop.folder() / "here" / "packings") == digests(shop.folder() / "there" / "packings"));
    CHECK(without_times(shop.results("here")) == without_times(shop.results("there")));
  }

  SECTION("with a job that Slurm kills for its memory, which reads like kill -9") {
    shop.write("hoarder", kHoarder);
    fs::permissions(shop.folder() / "hoarder", fs::perms::all);
    shop.write("beds.json", R"({"campaign": "beds", "scene": {"size": 8, "psd": {"law": "monodisperse", "radius": 1}},
      "methods": ["lammps-gravity"], "budget": {"wall_s": 100, "memory_mb": 250}})");
    ::setenv("TAMP_LAMMPS", (shop.folder() / "hoarder").c_str(), 1);
    const Said submitted = shop.tamp("submit beds.json --profile profile.json --store there");
    ::unsetenv("TAMP_LAMMPS");
    REQUIRE(submitted.code == 0);
    const Said collected = shop.tamp("collect --wait --store there");
    CAPTURE(collected.out, collected.err);
    CHECK(collected.code == 1);
    CHECK_THAT(collected.out, Contains("memory-limited: killed by Slurm for its use of memory"));
    CHECK_THAT(shop.tamp("submit beds.json --profile profile.json --store there").out, Contains("nothing to submit"));
    CHECK_THAT(shop.tamp("submit beds.json --retry-limited --profile profile.json --store there").out,
               Contains("nothing to submit")); // with no more memory than it had
  }

  SECTION("with jobs timed alone, which have the node for themselves") {
    shop.write("profile.json", kSingly);
    shop.write("discs.json",
               disc_campaign(60, 2, R"(, "timing": "exclusive", "budget": {"memory_mb": 400, "samples": 30})"));
    REQUIRE(shop.tamp("submit discs.json --profile profile.json --store there").code == 0);
    const Said collected = shop.tamp("collect --wait --store there");
    CAPTURE(collected.out, collected.err);
    CHECK(collected.code == 0);
    const tamp::Store store = tamp::Store::open(shop.folder() / "there", tamp::Store::Mode::read);
    std::set<std::pair<std::string, std::string>> spans; // start and end, in the order of the starts
    for (const auto& [key, outcome] : store.outcomes(tamp::JobKind::generation)) {
      const tamp::Record record = store.find(key).value();
      CHECK(record.timing.mode == tamp::TimingMode::exclusive);
      CHECK(record.timing.samples.size() == 30);
      spans.emplace(record.provenance.start_utc, record.provenance.end_utc);
    }
    REQUIRE(spans.size() == 2);
    CHECK(spans.begin()->second < spans.rbegin()->first); // one after the other, though there are two processors
  }
}
