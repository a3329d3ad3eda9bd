// The LAMMPS program of this machine: which one, what it can do, and running it as a child.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tamp {

/// Environment variable with the command that starts LAMMPS, words apart by blanks: "/opt/lmp" or "mpirun -n 4 lmp".
/// With several processes sums are rounded differently, so a bed is then the same one only for the same number of them.
inline constexpr const char* kLammpsVariable = "TAMP_LAMMPS";

/// A program as it describes itself by `-h`.
struct LammpsProgram {
  std::vector<std::string> command;
  std::string version;          ///< "29 Sep 2021 - Update 2"
  std::set<std::string> styles; ///< "pair granular", "fix wall/gran", "compute contact/atom", …

  /// Throws NotApplicable with what to install if one of the styles is missing.
  void require(const std::vector<std::string>& needed) const;
};

/// The version and styles in what `lmp -h` prints; an empty version if that is no such text.
LammpsProgram parse_lammps_help(const std::string& text);

/// Asks $TAMP_LAMMPS, or `lmp` in PATH. Throws NotApplicable with the install command if there is none. `folder` takes
/// a passing file.
LammpsProgram find_lammps(const std::filesystem::path& folder);

/// Runs input script `script` (a name inside `folder`) there, with one thread a process; LAMMPS's log becomes
/// `script`.log. The child dies with this process and inherits its limits of memory and time. Throws std::bad_alloc if
/// LAMMPS ran out of memory, Error with its own message otherwise. Returns its CPU time in seconds.
double run_lammps(const LammpsProgram& program, const std::filesystem::path& folder, const std::string& script);

} // namespace tamp
