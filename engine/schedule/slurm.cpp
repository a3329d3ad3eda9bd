// Runs sbatch, squeue, sacct and scontrol as child processes and reads what they print.
#include "engine/schedule/slurm.h"

#include "engine/base/files.h"
#include "engine/base/process.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <thread>

namespace tamp {

namespace {

namespace fs = std::filesystem;

constexpr double kCallLimit_s = 120; ///< of one command; Slurm's own give up earlier
constexpr double kRoomPerJob_s = 10; ///< to start a job and, at its limit, to end it
constexpr double kRoomPerElement_s = 60;
constexpr std::chrono::duration<double> kFirstPause(1);

/// How Slurm's commands say that the controller is not there.
constexpr std::array<std::string_view, 6> kUnreachable = {
    "Unable to contact slurm controller", "Socket timed out",     "Connection refused",
    "Zero Bytes were transmitted",        "Connection timed out", "backup controller"};

struct Answer {
  bool good = false;
  std::string out;
  std::string err;
};

/// A file that goes with the object.
class TemporaryFile {
public:
  explicit TemporaryFile(const char* name) : path_(temporary_name(fs::temp_directory_path() / name)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

Answer call(const std::vector<std::string>& command) {
  const TemporaryFile out("slurm-out");
  const TemporaryFile err("slurm-err");
  // The log of a child takes both streams; warnings must not mix with what is read.
  std::vector<std::string> argv = {"/bin/sh", "-c", R"(exec "$@" 2>"$0")", err.path().string()};
  argv.insert(argv.end(), command.begin(), command.end());
  const ProcessResult result =
      run_process({.argv = std::move(argv), .log = out.path(), .limits = {.wall_s = kCallLimit_s}});
  Answer answer{result.succeeded(), read_file(out.path()), fs::exists(err.path()) ? read_file(err.path()) : ""};
  if (result.end == ProcessResult::End::wall_limit)
    throw SlurmUnreachable(fmt::format("{} did not answer within {:g} s", command.front(), kCallLimit_s));
  return answer;
}

std::string ask(const std::vector<std::string>& command) {
  Answer answer = call(command);
  if (answer.good)
    return std::move(answer.out);
  const std::string message = fmt::format("{} failed: {}", command.front(), answer.err);
  if (std::any_of(kUnreachable.begin(), kUnreachable.end(),
                  [&](std::string_view words) { return answer.err.find(words) != std::string::npos; }))
    throw SlurmUnreachable(message);
  throw SlurmRefused(message);
}

/// "123;cluster\n" → "123".
std::string job_number(const std::string& answer) {
  std::string number = answer.substr(0, answer.find_first_of(";\n "));
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
    throw Error("sbatch gave no number of a job but: " + answer);
  return number;
}

/// The number of the array of this name, if the controller has one.
std::optional<std::string> find_array(const std::string& name) {
  const std::string found = ask({"squeue", "--noheader", "--all", "--states=all", "--name=" + name, "--format=%F"});
  return found.empty() ? std::nullopt : std::optional(job_number(found));
}

} // namespace

std::vector<std::string> sbatch_arguments(const ArrayRequest& request, const ClusterProfile& profile) {
  const auto jobs = static_cast<double>(request.array.longest());
  const double wall_s = jobs * (request.array.run.wall_s + kRoomPerJob_s) + kRoomPerElement_s;
  constexpr double kBytesPerMib = 1024. * 1024.;
  const double bytes = 1e6 * static_cast<double>(request.array.run.memory_mb + profile.memory_overhead_mb);
  std::string elements = fmt::format("--array=0-{}", request.array.elements.size() - 1);
  if (profile.max_running > 0)
    elements += fmt::format("%{}", profile.max_running);
  std::vector<std::string> arguments = {
      "--parsable",
      "--job-name=" + request.name,
      std::move(elements),
      fmt::format("--time={}", static_cast<std::int64_t>(std::ceil(wall_s / 60))),
      fmt::format("--mem={}M", static_cast<std::int64_t>(std::ceil(bytes / kBytesPerMib))),
      "--ntasks=1",
      "--cpus-per-task=1",
      "--requeue",
      "--open-mode=append",
      "--output=" + (request.logs / "%x_%a.log").string()};
  if (request.array.run.timing == TimingMode::exclusive)
    arguments.emplace_back("--exclusive");
  for (const auto& [option, value] : {std::pair{"partition", &profile.partition},
                                      {"account", &profile.account},
                                      {"qos", &profile.qos},
                                      {"constraint", &profile.constraint}}) {
    if (!value->empty())
      arguments.push_back(fmt::format("--{}={}", option, *value));
  }
  // However they end: an element looks for itself whether its parents left packings.
  if (!request.after.empty())
    arguments.push_back(fmt::format("--dependency=afterany:{}", fmt::join(request.after, ":")));
  arguments.push_back(request.script.string());
  return arguments;
}

std::string submit(const ArrayRequest& request, const ClusterProfile& profile) {
  std::vector<std::string> command = sbatch_arguments(request, profile);
  command.insert(command.begin(), "sbatch");
  using Clock = std::chrono::steady_clock;
  const auto give_up = Clock::now() + std::chrono::duration<double>(profile.patience_s);
  for (auto pause = kFirstPause;; pause *= 2) {
    const bool first = pause == kFirstPause;
    try {
      const auto taken = first ? std::nullopt : find_array(request.name); // though the answer got lost
      return taken ? *taken : job_number(ask(command));
    } catch (const SlurmUnreachable&) {
      if (Clock::now() + pause > give_up)
        throw;
    }
    std::this_thread::sleep_for(pause);
  }
}

ElementStates queue_states() {
  return parse_queue(ask({"squeue", "--noheader", "--all", "--array", "--states=all",
                          fmt::format("--user={}", ::getuid()), std::string("--format=") + kQueueFormat}));
}

ElementStates accounted_states(const std::vector<std::string>& jobs) {
  try {
    const Answer answer = call({"sacct", "--noheader", "--parsable2", "--allocations",
                                "--format=JobName%100,JobID,State", fmt::format("--jobs={}", fmt::join(jobs, ","))});
    return answer.good ? parse_accounting(answer.out) : ElementStates{};
  } catch (const Error&) { // no such command, or one that hangs: there is no accounting
    return {};
  }
}

std::size_t largest_array() {
  const std::string config = ask({"scontrol", "show", "config"});
  constexpr std::string_view kName = "MaxArraySize";
  const std::size_t at = config.find(kName);
  const std::size_t digits = at == std::string::npos ? at : config.find_first_of("0123456789", at);
  if (digits == std::string::npos)
    throw Error("`scontrol show config` does not tell MaxArraySize");
  // It is the first number that an element may not have.
  return static_cast<std::size_t>(std::max(1L, std::strtol(config.c_str() + digits, nullptr, 10)));
}

} // namespace tamp
