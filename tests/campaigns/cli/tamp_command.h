// Runs the real `tamp` in a folder of the test and looks at what it said and left.
#pragma once

#include "engine/base/files.h"
#include "engine/base/process.h"
#include "engine/base/sha256.h"
#include "tests/engine/base/scratch_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>

namespace tamp::test {

namespace fs = std::filesystem;

struct Said {
  int code = 0; ///< exit code, or minus the signal
  std::string out;
  std::string err;
};

/// A folder in which `tamp` is run; what it prints is kept outside, so that the folder shows what the command wrote.
class Workshop {
public:
  explicit Workshop(std::string binary) : binary_(std::move(binary)) {}

  /// Starts `tamp ARGUMENTS` (shell words) in the folder; `before`: commands of the shell that becomes it.
  ChildProcess start(const std::string& arguments, const std::string& before = "") const {
    const std::string script = fmt::format("{}cd '{}' && exec '{}' {} >'{}' 2>'{}'", before, folder().string(), binary_,
                                           arguments, (said_ / "out").string(), (said_ / "err").string());
    return ChildProcess::start({.argv = {"/bin/sh", "-c", script}, .log = {}, .limits = {.wall_s = 300}});
  }
  Said end(ChildProcess& child) const {
    const ProcessResult result = child.wait();
    const bool exited = result.end == ProcessResult::End::exited;
    return {exited ? result.code : -result.code, read_file(said_ / "out"), read_file(said_ / "err")};
  }
  Said tamp(const std::string& arguments, const std::string& before = "") const {
    ChildProcess child = start(arguments, before);
    return end(child);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder() / name) << text; }
  const fs::path& folder() const { return folder_.path(); }

  /// `tamp results` of a store as key → row.
  std::map<std::string, nlohmann::json> results(const std::string& store) const {
    std::map<std::string, nlohmann::json> rows;
    for (const auto& row : nlohmann::json::parse(tamp("results --format json --store " + store).out))
      rows[row.at("key")] = row;
    return rows;
  }

private:
  std::string binary_;
  ScratchFolder folder_;
  ScratchFolder said_;
};

/// Path relative to `folder` → SHA-256 of every file below it.
inline std::map<std::string, std::string> digests(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      found[entry.path().lexically_relative(folder).string()] = sha256_hex(read_file(entry.path()));
  }
  return found;
}

/// What must not depend on how a campaign was run: key → all but the times.
inline std::map<std::string, nlohmann::json> without_times(std::map<std::string, nlohmann::json> rows) {
  for (auto& [key, row] : rows)
    row.erase("time");
  return rows;
}

/// Waits until `condition` holds; false after 60 s.
inline bool wait_until(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// A campaign of equal discs in a square of this edge (in radii): some 0.23 edge² discs a packing.
inline std::string disc_campaign(double edge, int replicates, const std::string& more = "") {
  return fmt::format(R"({{"campaign": "discs", "scene": {{"dimension": 2, "size": {}, "psd": {{"law": "monodisperse", )"
                     R"("radius": 1}}}}, "methods": ["drop-and-roll"], "replicates": {}{}}})",
                     edge, replicates, more);
}

/// A job of such a campaign that takes many seconds.
constexpr double kLongEdge = 6000;

} // namespace tamp::test
