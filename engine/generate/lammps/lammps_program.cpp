// Reads `lmp -h` and runs scripts by env -C, which changes the folder without a shell.
#include "engine/generate/lammps/lammps_program.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/process.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdlib>
#include <new>
#include <sstream>

namespace tamp {

namespace {

constexpr std::string_view kTitle = "Massively Parallel Simulator - ";
constexpr const char* kInstall = "apt-get install lammps (or state the command in TAMP_LAMMPS)";

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> out;
  for (std::string word; in >> word;)
    out.push_back(word);
  return out;
}

/// What LAMMPS said last: the line that starts with ERROR, and the command it stumbled over.
std::string complaint(const std::string& log) {
  const std::size_t at = log.rfind("ERROR");
  if (at == std::string::npos)
    return log;
  return log.substr(at, log.find_last_not_of(" \n") + 1 - at);
}

} // namespace

void LammpsProgram::require(const std::vector<std::string>& needed) const {
  for (const std::string& style : needed) {
    if (styles.count(style) == 0)
      throw NotApplicable(fmt::format("LAMMPS {} ({}) has no {} (its package GRANULAR has the granular ones): {}",
                                      version, fmt::join(command, " "), style, kInstall));
  }
}

LammpsProgram parse_lammps_help(const std::string& text) {
  LammpsProgram program;
  std::string kind;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::size_t at = line.find(kTitle); at != std::string::npos) {
      program.version = line.substr(at + kTitle.size());
    } else if (line.starts_with("* ") && line.find(" styles") != std::string::npos) {
      kind = line.substr(2, line.find(" styles") - 2); // "* Pair styles:"
      for (char& c : kind)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!kind.empty()) {
      for (const std::string& word : words(line))
        program.styles.insert(kind + " " + word);
    }
  }
  return program;
}

LammpsProgram find_lammps(const std::filesystem::path& folder) {
  const char* stated = std::getenv(kLammpsVariable);
  std::vector<std::string> command = words(stated == nullptr ? "" : stated);
  if (command.empty())
    command = {"lmp"};
  std::vector<std::string> argv = command;
  argv.emplace_back("-h");
  const std::filesystem::path answer = folder / "help.txt";
  std::string text;
  try {
    const ProcessResult ended = run_process({.argv = argv, .log = answer});
    if (ended.succeeded())
      text = read_file(answer);
  } catch (const Error&) {
    text.clear(); // no such program
  }
  std::filesystem::remove(answer);
  LammpsProgram program = parse_lammps_help(text);
  program.command = std::move(command);
  if (program.version.empty())
    throw NotApplicable(fmt::format("LAMMPS cannot be started by `{}`: {}", fmt::join(program.command, " "), kInstall));
  return program;
}

double run_lammps(const LammpsProgram& program, const std::filesystem::path& folder, const std::string& script) {
  std::vector<std::string> argv = {"env", "-C", folder.string()};
  argv.insert(argv.end(), program.command.begin(), program.command.end());
  argv.insert(argv.end(), {"-in", script, "-log", script + ".log", "-screen", "none", "-nocite"});
  const std::filesystem::path said = folder / (script + ".out");
  const ProcessResult ended = run_process({.argv = argv, .log = said, .environment = {{"OMP_NUM_THREADS", "1"}}});
  std::filesystem::remove(said);
  if (ended.succeeded())
    return ended.cpu_s;
  std::error_code none;
  const std::filesystem::path log = folder / (script + ".log");
  const std::string why = std::filesystem::exists(log, none) ? complaint(read_file(log)) : ended.log_tail;
  if (why.find("Failed to allocate") != std::string::npos || why.find("Failed to reallocate") != std::string::npos ||
      ended.log_tail.find("bad_alloc") != std::string::npos)
    throw std::bad_alloc();
  throw Error(fmt::format("LAMMPS ended with {} {}: {}", ended.end == ProcessResult::End::signalled ? "signal" : "code",
                          ended.code, why));
}

} // namespace tamp
