// A campaign of 200 jobs, some of which cannot end well, while jobs and the run itself are killed and the disk fills.
#include "engine/base/random.h"
#include "store/store.h"
#include "tests/campaigns/cli/job_processes.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>
#include <sys/mount.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

constexpr int kGood = 170;
constexpr int kOfEachBad = 10;
constexpr int kKilledRuns = 20;
constexpr int kRunsAFill = 5; ///< the disk fills after every fifth of them
/// Packings after which a run is killed early, so that on a fast day the last kill still finds work.
constexpr std::ptrdiff_t kMadeByARun = kGood / (2 * kKilledRuns);
/// Space that is left on the full disk, in bytes: for a few packings, for a page of the database, for nothing.
constexpr std::array<std::uintmax_t, 3> kLeft = {300'000, 20'000, 0};

std::string renamed(std::string campaign, const std::string& name) {
  return campaign.replace(campaign.find("discs"), 5, name);
}

/// The program that stands for LAMMPS in these jobs ends the job that started it by a real signal.
constexpr const char* kCrasher = "#!/bin/sh\nkill -SEGV $PPID\nsleep 5\n";

std::string crashing_campaign(int replicates) {
  return fmt::format(
      R"({{"campaign": "crashing", "scene": {{"size": 8, "psd": {{"law": "monodisperse", "radius": 1}}}}, )"
      R"("methods": ["lammps-gravity"], "replicates": {}, "metrics": ["phi"]}})",
      replicates);
}

/// A disk of its own that can be filled up and freed again: a tmpfs, or where mounting is not allowed the limit of the
/// size of files (the calls then fail at other places, but fail).
class SmallDisk {
public:
  explicit SmallDisk(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    mounted_ = ::mount("tamp-chaos", folder_.c_str(), "tmpfs", 0, "size=96m") == 0;
    if (!mounted_)
      WARN("no tmpfs can be mounted: the full disk is one that takes no file above 64 KiB");
  }
  ~SmallDisk() {
    if (mounted_)
      ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  /// Runs while no more than `left` bytes are free.
  template <class Run>
  Said while_full(std::uintmax_t left, const Run& run) const {
    if (!mounted_)
      return run("trap '' XFSZ; ulimit -f 64; ");
    const fs::path ballast = folder_ / "ballast";
    struct statvfs facts {};
    ::statvfs(folder_.c_str(), &facts);
    const std::uintmax_t space = facts.f_bavail * facts.f_frsize;
    std::ofstream(ballast) << std::string(space > left ? space - left : 0, 'x');
    const Said said = run("");
    fs::remove(ballast);
    return said;
  }

private:
  fs::path folder_;
  bool mounted_ = false;
};

std::ptrdiff_t packings_in(const fs::path& store) {
  std::error_code none;
  const fs::recursive_directory_iterator entries(store / "packings", none);
  return std::count_if(begin(entries), end(entries),
                       [](const fs::directory_entry& entry) { return entry.path().extension() == ".h5"; });
}

/// Kills children of the run at random moments, and at last the run itself: after a time, or some packings.
Said run_and_kill(const Workshop& shop, const std::string& arguments, double length_s, RandomStream& random) {
  const fs::path store = shop.folder() / "disk" / "cut";
  const std::ptrdiff_t enough = packings_in(store) + kMadeByARun;
  ChildProcess run = shop.start(arguments);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(length_s);
  while (std::chrono::steady_clock::now() < end && packings_in(store) < enough) {
    std::this_thread::sleep_for(std::chrono::duration<double>(length_s / 4 * random.uniform()));
    const std::vector<pid_t> jobs = children_of(run.pid());
    if (!jobs.empty())
      ::kill(jobs[static_cast<std::size_t>(random.uniform() * static_cast<double>(jobs.size()))], SIGKILL);
  }
  ::kill(run.pid(), SIGKILL);
  return shop.end(run);
}

void chaos(int round) {
  const Workshop shop(TAMP_BINARY);
  const SmallDisk disk(shop.folder() / "disk");
  shop.write("crasher", kCrasher);
  fs::permissions(shop.folder() / "crasher", fs::perms::all);
  ::setenv("TAMP_LAMMPS", (shop.folder() / "crasher").c_str(), 1);
  shop.write("good.json", disc_campaign(60, kGood, R"(, "metrics": ["phi"])"));
  shop.write("hungry.json",
             renamed(disc_campaign(kLongEdge, kOfEachBad, R"(, "budget": {"memory_mb": 70})"), "hungry"));
  shop.write("endless.json",
             renamed(disc_campaign(kLongEdge + 1, kOfEachBad, R"(, "budget": {"wall_s": 0.3})"), "endless"));
  shop.write("crashing.json", crashing_campaign(kOfEachBad));
  const std::string all = "run crashing.json hungry.json endless.json good.json --store disk/cut";

  const auto start = std::chrono::steady_clock::now();
  REQUIRE(shop.tamp("run good.json --store whole").code == 0);
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  RandomStream random("moments of chaos", static_cast<std::uint64_t>(round));
  int struck = 0;
  for (int kill = 0; kill < kKilledRuns; ++kill) {
    struck += run_and_kill(shop, all, whole_s / 5 * random.uniform(), random).code == -SIGKILL ? 1 : 0;
    if (kill % kRunsAFill == 0) {
      const std::uintmax_t left = kLeft[static_cast<std::size_t>(kill / kRunsAFill) % kLeft.size()];
      const Said full = disk.while_full(left, [&](const std::string& before) { return shop.tamp(all, before); });
      CAPTURE(left, full.out, full.err);
      CHECK(full.code == 1);
      CHECK_THAT(full.err, Contains("No space left") || Contains("be full") || Contains("File too large"));
    }
  }
  CHECK(struck >= kKilledRuns / 2);

  const Said last = shop.tamp(all);
  CAPTURE(last.out, last.err);
  CHECK(last.code == 1);
  CHECK_THAT(shop.tamp("run good.json --store disk/cut").out, Contains("nothing to do"));

  // One outcome for each job, and for each bad one its own.
  std::map<std::string, int> outcomes;
  std::map<std::string, nlohmann::json> good;
  for (const auto& [key, row] : shop.results("disk/cut")) {
    const std::string campaign = row.at("campaign");
    ++outcomes[campaign + " " + row.at("outcome").get<std::string>()];
    if (campaign == "discs")
      good[key] = row;
  }
  CHECK(outcomes == std::map<std::string, int>{{"discs ok", kGood},
                                               {"hungry memory-limited", kOfEachBad},
                                               {"endless time-limited", kOfEachBad},
                                               {"crashing crashed", kOfEachBad}});
  // The good ones are those of the undisturbed run, to the byte.
  CHECK(without_times(good) == without_times(shop.results("whole")));
  const fs::path cut = shop.folder() / "disk" / "cut";
  CHECK(digests(cut / "packings") == digests(shop.folder() / "whole" / "packings"));
  const Store store = Store::open(cut, Store::Mode::read);
  for (const auto& [key, row] : good) {
    int ok = 0;
    for (const Record& attempt : store.attempts(key))
      ok += attempt.outcome == Outcome::ok ? 1 : 0;
    CHECK(ok == 1);
  }
  for (const auto& entry : fs::directory_iterator(cut / "incoming"))
    CHECK_THAT(entry.path().filename().string(), Catch::EndsWith(".files") || Catch::EndsWith(".checkpoint"));
  ::unsetenv("TAMP_LAMMPS");
}

} // namespace

TEST_CASE("whatever is killed and however full the disk, each job has one outcome and the good ones their bytes",
          "[slow]") {
  const char* rounds = std::getenv("TAMP_CHAOS_ROUNDS"); // of some 20 s each
  for (int round = 0; round < (rounds == nullptr ? 1 : std::atoi(rounds)); ++round)
    chaos(round);
}
