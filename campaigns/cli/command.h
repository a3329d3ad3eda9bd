// What a command is, the table of all commands, and the one place where errors become messages and exit codes.
#pragma once

#include <CLI/App.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace tamp::cli {

enum ExitCode { kOk = 0, kNotAllOk = 1, kInputError = 2, kCancelled = 130 };

/// Does what the user asked for; returns the exit code.
using Action = std::function<int()>;

/// `tamp` with its commands. Remembers what to do for the one that was given.
class CommandLine {
public:
  explicit CommandLine(const std::string& description);

  /// Adds a command; the caller adds its options. `examples` stands below its options in --help. An empty group hides
  /// it from the list.
  CLI::App& add(const std::string& name, const std::string& summary, const std::string& examples, Action action);

  /// What to do: the action of the command given, or to print the help asked for. Throws InputError for anything else.
  Action parse(int argc, char** argv);

private:
  CLI::App app_;
  Action chosen_;
};

/// A row of the table: declares one command.
struct Command {
  void (*declare)(CommandLine& line);
};
std::span<const Command> commands();

void declare_run(CommandLine& line);
void declare_plan(CommandLine& line);
void declare_explain(CommandLine& line);
void declare_reproduce(CommandLine& line);
void declare_status(CommandLine& line);
void declare_results(CommandLine& line);
void declare_report(CommandLine& line);
void declare_compare(CommandLine& line);
void declare_audit(CommandLine& line);
void declare_export(CommandLine& line);
void declare_schema(CommandLine& line);
void declare_reference(CommandLine& line);
void declare_job(CommandLine& line);
void declare_submit(CommandLine& line);
void declare_collect(CommandLine& line);
void declare_element(CommandLine& line);
void declare_fsck(CommandLine& line);
void declare_timeline(CommandLine& line);
void declare_logs(CommandLine& line);
void declare_completion(CommandLine& line);

/// The option --store that all commands share.
void add_store_option(CLI::App& app, std::string& folder);

/// Runs `action`; an InputError becomes exit code 2, any other exception 1, with "tamp: error: …" on stderr.
int guarded(const Action& action);

} // namespace tamp::cli
