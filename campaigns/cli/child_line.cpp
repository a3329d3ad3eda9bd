// The child finds the very file that this process runs, even if it has been replaced or removed since.
#include "campaigns/cli/child_line.h"

#include <fmt/format.h>

namespace tamp::cli {

namespace {

constexpr double kWarmUp_s = 0.1; ///< of jobs that are timed alone: governors follow within some 10 ms

} // namespace

std::vector<std::string> child_line(const std::filesystem::path& job, const std::filesystem::path& out,
                                    const std::filesystem::path& parent, const RunSettings& run) {
  std::vector<std::string> argv = {
      "/proc/self/exe", "job", job.string(), "--out", out.string(), "--wall", fmt::format("{}", run.wall_s)};
  if (!parent.empty())
    argv.insert(argv.end(), {"--parent", parent.string()});
  if (run.timing == TimingMode::exclusive)
    argv.insert(argv.end(), {"--warm-up", fmt::format("{}", kWarmUp_s), "--samples", fmt::format("{}", run.samples)});
  return argv;
}

} // namespace tamp::cli
