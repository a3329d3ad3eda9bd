// LaTeX output: escapes, balance of braces, dollars and environments, columns of each row; compiled where pdflatex is.
#include "engine/base/files.h"
#include "report/latex.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

using namespace tamp;
using namespace tamp::test;

namespace {

/// What is wrong with the syntax, as far as counting can tell; empty if nothing is.
std::string fault(const std::string& source) {
  std::vector<std::string> environments;
  int braces = 0;
  bool math = false;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source[i] == '\\') {
      for (const std::string word : {"\\begin{", "\\end{"}) {
        if (source.compare(i, word.size(), word) != 0)
          continue;
        const std::size_t start = i + word.size();
        const std::string name = source.substr(start, source.find('}', start) - start);
        if (word == "\\begin{")
          environments.push_back(name);
        else if (environments.empty() || environments.back() != name)
          return "end of " + name;
        else
          environments.pop_back();
      }
      ++i; // the next character is escaped or the name of a command
      continue;
    }
    if (source[i] == '%') {
      i = source.find('\n', i);
      continue;
    }
    braces += source[i] == '{' ? 1 : source[i] == '}' ? -1 : 0;
    math ^= source[i] == '$';
    if (braces < 0)
      return "brace closed too often";
    if (source[i] == '#' || ((source[i] == '_' || source[i] == '^') && !math && braces == 0))
      return "bare special character";
  }
  if (math)
    return "odd number of dollars";
  return braces != 0 ? "braces left open" : environments.empty() ? "" : environments.back() + " left open";
}

std::size_t count_columns(const std::string& line) {
  std::size_t columns = 1;
  for (std::size_t i = 0; i < line.size(); ++i)
    columns += line[i] == '&' && (i == 0 || line[i - 1] != '\\') ? 1 : 0;
  return columns;
}

/// Number of rows whose columns do not agree with the specification of their tabular, and of rows seen.
std::pair<int, int> wrong_rows(const std::string& source) {
  std::istringstream lines(source);
  std::string line;
  std::size_t expected = 0;
  int wrong = 0;
  int seen = 0;
  while (std::getline(lines, line)) {
    const std::string begin = "\\begin{tabular}{";
    if (line.starts_with(begin))
      expected = line.find('}', begin.size()) - begin.size();
    else if (line.starts_with("\\end{tabular}"))
      expected = 0;
    else if (expected > 0 && line.ends_with("\\\\")) {
      ++seen;
      const std::string span = "\\multicolumn{" + std::to_string(expected) + "}";
      wrong += line.starts_with(span) || count_columns(line) == expected ? 0 : 1;
    }
  }
  return {wrong, seen};
}

SyntheticCampaign awkward_campaign() {
  SyntheticCampaign campaign;
  campaign.plan.title = "100 % of {braces} & #1_a^b ~ $x$ \\ <é> 中 --option";
  for (int i = 0; i < 5; ++i)
    campaign.add_ok(paper_scene(2), i, 0.82 + 0.001 * i, 0.2 + 0.01 * i);
  campaign.add_ok(paper_scene(3), 0, 0.63, 1);
  campaign.add_ok(paper_scene(3), 0, 0.63, 1, "own_method #2");
  const std::string failed = campaign.plan_job(paper_scene(2), 7);
  Record& record = campaign.add_record(failed, JobKind::generation, "drop-and-roll");
  record.outcome = Outcome::failed;
  record.reason = "exit code 1: \"bad_{thing\" at 50 % & more $";
  campaign.plan_job(paper_scene(2), 8);
  return campaign;
}

} // namespace

TEST_CASE("Every special character is escaped") {
  CHECK(latex_text("a_b & 5 % #1 {x} $y$") == "a\\_b \\& 5 \\% \\#1 \\{x\\} \\$y\\$");
  CHECK(latex_text("\\") == "\\textbackslash{}");
  CHECK(latex_text("^~<>|") == "\\textasciicircum{}\\textasciitilde{}\\textless{}\\textgreater{}\\textbar{}");
  CHECK(latex_text("--store") == "-{}-{}store");
  CHECK(latex_text("1 ± 2 µm") == "1 $\\pm$ 2 $\\mu$m");
  CHECK(latex_text("Müller") == "Müller");
  CHECK(latex_text("中\n\xff") == "? ?");
}

TEST_CASE("Fragments and documents are balanced and their rows have the columns of their tabular") {
  const auto files = awkward_campaign().report();
  for (const char* name : {"lognormal_2d.tex", "lognormal_3d.tex", "tables.tex"}) {
    CAPTURE(name, files.at(name));
    CHECK(fault(files.at(name)).empty());
  }
  const auto [wrong, seen] = wrong_rows(files.at("lognormal_2d.tex"));
  CHECK(wrong == 0);
  CHECK(seen == 1 + 1 + 3 + 1 + 1); // heading, group, three lines; heading, one line
}

TEST_CASE("The counting finds what is broken") {
  CHECK(fault("\\begin{a}{x}\\end{a}").empty());
  CHECK_FALSE(fault("\\begin{a}{x}\\end{b}").empty());
  CHECK_FALSE(fault("{x").empty());
  CHECK_FALSE(fault("$x").empty());
  CHECK_FALSE(fault("a_b").empty());
  CHECK(wrong_rows("\\begin{tabular}{lrr}\na & b & c \\\\\na & b \\\\\n").first == 1);
}

TEST_CASE("Figures appear as mean and deviation, paper and difference") {
  const std::string tex = awkward_campaign().report().at("lognormal_2d.tex");
  CHECK(tex.find("\\textbf{D\\&R} n = 5") != std::string::npos);
  CHECK(tex.find("\\num{0.8220 +- 0.0016}") != std::string::npos); // sd of 0, 1, 2, 3, 4 thousandths: 0.00158
  CHECK(tex.find("\\num{0.811}") != std::string::npos);
  CHECK(tex.find("\\num{+0.011}") != std::string::npos);
  CHECK(tex.find("\\num{20654}") != std::string::npos);
  CHECK(tex.find("\\num{7.5e-14}") != std::string::npos);
  CHECK(tex.find("\\qty{4.65}{s}") != std::string::npos);
  CHECK(tex.find("\\num{21}$\\times$") != std::string::npos); // 4.65 / 0.22
}

TEST_CASE("pdflatex accepts the document") {
  if (std::system("command -v pdflatex kpsewhich >/dev/null && kpsewhich booktabs.sty siunitx.sty >/dev/null") != 0)
    return;
  const auto folder =
      std::filesystem::temp_directory_path() / ("tamp_latex_test_" + std::to_string(static_cast<long>(getpid())));
  std::filesystem::create_directories(folder);
  for (const auto& [name, bytes] : awkward_campaign().report())
    write_atomically(folder / name, bytes);
  const std::string command =
      "cd '" + folder.string() + "' && pdflatex -halt-on-error -interaction=nonstopmode tables.tex >pdflatex.out 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  const std::string log = read_file(folder / "pdflatex.out");
  CAPTURE(log);
  CHECK(log.find("Overfull") == std::string::npos);
  std::filesystem::remove_all(folder);
}
