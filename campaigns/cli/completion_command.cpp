// tamp completion: writes scripts by which shells complete tamp's commands and options, from the commands themselves.
#include "campaigns/cli/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

/// Commands and options of a list, each with what it does.
struct Choice {
  std::string name;
  std::string description;
};

std::vector<Choice> options_of(const CLI::App& app) {
  std::vector<Choice> choices;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      choices.push_back({"--" + name, option->get_description()});
  }
  return choices;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& root) {
  return root.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string names(const std::vector<Choice>& choices) {
  std::string words;
  for (const Choice& choice : choices)
    words += (words.empty() ? "" : " ") + choice.name;
  return words;
}

std::string bash_script(const CLI::App& root) {
  std::string commands = names(options_of(root));
  std::string cases;
  for (const CLI::App* command : shown_commands(root)) {
    commands += " " + command->get_name();
    cases += fmt::format("    {}) options='{}' ;;\n", command->get_name(), names(options_of(*command)));
  }
  return fmt::format(R"sh(# Completes tamp in bash: eval "$(tamp completion bash)"
_tamp() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options='{}'
  if ((COMP_CWORD > 1)); then
    case ${{COMP_WORDS[1]}} in
{}    *) options= ;;
    esac
  fi
  if [[ $word == -* || $COMP_CWORD == 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _tamp tamp
)sh",
                     commands, cases);
}

/// A word of zsh's _describe, in single quotes: colons and quotes of its own are escaped.
std::string described(const Choice& choice) {
  std::string out = "'" + choice.name + ":";
  for (const char c : choice.description) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c == ':' ? std::string("\\:") : std::string(1, c);
  }
  return out + "'";
}

std::string described(const std::vector<Choice>& choices) {
  std::vector<std::string> words;
  for (const Choice& choice : choices)
    words.push_back(described(choice));
  return fmt::format("{}", fmt::join(words, " "));
}

std::string zsh_script(const CLI::App& root) {
  std::vector<Choice> commands;
  std::string cases;
  for (const CLI::App* command : shown_commands(root)) {
    commands.push_back({command->get_name(), command->get_description()});
    cases += fmt::format("    {}) options=({}) ;;\n", command->get_name(), described(options_of(*command)));
  }
  return fmt::format(R"sh(#compdef tamp
# Completes tamp in zsh: eval "$(tamp completion zsh)", after compinit
_tamp() {{
  local -a commands options
  commands=({})
  options=({})
  if ((CURRENT > 2)); then
    case $words[2] in
{}    *) options=() ;;
    esac
  fi
  if [[ $PREFIX == -* ]]; then
    _describe option options
  elif ((CURRENT == 2)); then
    _describe command commands
  else
    _files
  fi
}}
compdef _tamp tamp
)sh",
                     described(commands), described(options_of(root)), cases);
}

constexpr const char* kExamples = R"sh(Examples:
  eval "$(tamp completion bash)"      in ~/.bashrc
  eval "$(tamp completion zsh)"       in ~/.zshrc, after compinit)sh";

} // namespace

void declare_completion(CommandLine& line) {
  const auto shell = std::make_shared<std::string>();
  const auto root = std::make_shared<const CLI::App*>(nullptr);
  CLI::App& app =
      line.add("completion", "Write a script that completes tamp's commands and options", kExamples, [shell, root] {
        fmt::print("{}", *shell == "bash" ? bash_script(**root) : zsh_script(**root));
        return kOk;
      });
  *root = app.get_parent();
  app.add_option("shell", *shell, "The shell")->required()->check(CLI::IsMember({"bash", "zsh"}));
}

} // namespace tamp::cli
