// The table of commands, the parsing of the line, errors as messages.
#include "campaigns/cli/command.h"

#include "engine/base/error.h"
#include "tamp_build_info.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <utility>

namespace tamp::cli {

namespace {

constexpr std::array kCommands = {
    Command{declare_run},    Command{declare_plan},     Command{declare_explain}, Command{declare_reproduce},
    Command{declare_status}, Command{declare_results},  Command{declare_report},  Command{declare_compare},
    Command{declare_audit},  Command{declare_export},   Command{declare_schema},  Command{declare_reference},
    Command{declare_job},    Command{declare_submit},   Command{declare_collect}, Command{declare_element},
    Command{declare_fsck},   Command{declare_timeline}, Command{declare_logs},    Command{declare_completion},
};

constexpr const char* kHelpFooter = R"(First steps:
  tamp plan campaigns/quickstart.json                  what would run
  tamp run campaigns/quickstart.json                   run it (again: only what is missing)
  tamp results --format csv > results.csv              the numbers
  tamp report campaigns/quickstart.json --out report   the tables

Exit codes: 0 all well; 1 some job did not end ok, or the system failed; 2 the input is at fault,
nothing was written; 130 cancelled. `tamp COMMAND --help` tells more about a command.)";

} // namespace

CommandLine::CommandLine(const std::string& description) : app_(description, "tamp") {
  app_.footer(kHelpFooter);
  app_.require_subcommand(1);
  app_.set_version_flag("--version", fmt::format("tamp {} ({}{})", build_info::version, build_info::source_commit,
                                                 build_info::source_dirty ? ", changed" : ""));
  app_.get_formatter()->column_width(32);
}

CLI::App& CommandLine::add(const std::string& name, const std::string& summary, const std::string& examples,
                           Action action) {
  CLI::App* command = app_.add_subcommand(name, summary);
  command->footer(examples);
  command->callback([this, action = std::move(action)] { chosen_ = action; });
  return *command;
}

Action CommandLine::parse(int argc, char** argv) {
  try {
    app_.parse(argc, argv);
    return chosen_;
  } catch (const CLI::Success& request) { // --help, --version
    return [this, request] { return app_.exit(request); };
  } catch (const CLI::ParseError& e) {
    throw InputError(fmt::format("{}\nSee `tamp --help`.", e.what()));
  }
}

std::span<const Command> commands() {
  return kCommands;
}

void add_store_option(CLI::App& app, std::string& folder) {
  app.add_option("--store", folder, "Folder that holds all results")->type_name("DIR")->capture_default_str();
}

int guarded(const Action& action) {
  const auto complain = [](const char* what, int code) {
    fmt::print(stderr, "tamp: error: {}\n", what);
    return code;
  };
  try {
    return action();
  } catch (const InputError& e) {
    return complain(e.what(), kInputError);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kNotAllOk);
  } catch (const std::exception& e) {
    return complain(e.what(), kNotAllOk);
  }
}

} // namespace tamp::cli
