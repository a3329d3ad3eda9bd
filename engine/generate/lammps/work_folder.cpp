// Folders are made and removed by the standard library; mkdtemp names the passing ones.
#include "engine/generate/lammps/work_folder.h"

#include "engine/base/error.h"
#include "engine/generate/lammps/lammps_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace tamp {

namespace fs = std::filesystem;

namespace {

/// Share of a job's time for the other program, which leaves at least some seconds for all else.
constexpr double kShare = 0.9;
constexpr double kElse = 2;          // s
constexpr double kWorthStarting = 1; // s

} // namespace

Deadline::Deadline(double wall_s)
    : wall_s_(wall_s), allowed_s_(std::max(kWorthStarting, std::min(kShare * wall_s, wall_s - kElse))),
      start_(std::chrono::steady_clock::now()) {}

double Deadline::left() const {
  if (!(wall_s_ > 0))
    return 0;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  return std::max(kWorthStarting, allowed_s_ - spent.count());
}

bool Deadline::over() const {
  return wall_s_ > 0 && left() <= kWorthStarting;
}

std::string Deadline::reason() const {
  return fmt::format("not at rest after {:g} of the {:g} s of the job's budget; the state reached is kept", allowed_s_,
                     wall_s_);
}

WorkFolder::WorkFolder(const fs::path& wanted) : path_(wanted), passing_(wanted.empty()) {
  if (!passing_) {
    remove();
    std::error_code failed;
    if (!fs::create_directory(path_, failed))
      throw Error("cannot make the folder " + path_.string() + ": " + failed.message());
    path_ = fs::absolute(path_);
    return;
  }
  std::string name = (fs::temp_directory_path() / "tamp-work-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error("cannot make a folder like " + name);
  path_ = name;
}

WorkFolder::~WorkFolder() {
  if (passing_)
    remove();
}

void WorkFolder::tidy() const {
  for (const char* large : {LammpsFiles::start, LammpsFiles::state, LammpsFiles::restart})
    fs::remove(path_ / large);
}

void WorkFolder::remove() const noexcept {
  std::error_code none;
  fs::remove_all(path_, none);
}

} // namespace tamp
