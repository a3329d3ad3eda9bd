// Makes and writes reports.
#include "report/report.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/model/report_tables.h"
#include "report/accuracy_table.h"
#include "report/bimodal_tables.h"
#include "report/csv.h"
#include "report/decision_table.h"
#include "report/domain_size_table.h"
#include "report/effects_table.h"
#include "report/latex.h"
#include "report/lognormal_table.h"
#include "report/manifest.h"
#include "report/markdown.h"
#include "report/notes.h"
#include "report/page.h"
#include "report/powders_table.h"
#include "store/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace tamp {

namespace {

/// A table and the records behind it.
struct MadeTable {
  Table table;
  std::string records;
};

MadeTable make_lognormal(const ReportInput& input, std::string_view name) {
  const PaperTable& paper = paper_table(name);
  const std::vector<RunGroup> groups = lognormal_groups(input.runs, paper);
  Table table = lognormal_table(groups, paper);
  table.notes = all_notes(
      {input.plan, groups, input.command, table.name, fmt::format("lognormal powder in {}D", paper.dimension), &paper});
  return {std::move(table), records_csv(groups)};
}

/// Notes of every table that is made from groups.
MadeTable finish(const ReportInput& input, Table table, std::span<const RunGroup> groups, const char* content) {
  table.notes = all_notes({input.plan, groups, input.command, table.name, content}, std::move(table.notes));
  return {std::move(table), records_csv(groups)};
}

MadeTable make_bimodal(const ReportInput& input, std::string_view) {
  const std::vector<RunGroup> groups = bimodal_groups(input.runs);
  return finish(input, bimodal_table(groups), groups, "bimodal powder in 3D");
}

MadeTable make_furnas(const ReportInput& input, std::string_view) {
  const std::vector<RunGroup> groups = bimodal_groups(input.runs);
  return finish(input, furnas_table(groups), groups, "bimodal powder in 3D");
}

MadeTable make_domain_size(const ReportInput& input, std::string_view) {
  const std::vector<SizeFamily> families = size_families(input.runs);
  std::vector<RunGroup> groups;
  for (const SizeFamily& family : families)
    groups.insert(groups.end(), family.groups.begin(), family.groups.end());
  return finish(input, domain_size_table(families), groups, "powder");
}

MadeTable make_powders(const ReportInput& input, std::string_view) {
  return {powders_table(input.runs), records_csv({})};
}

MadeTable make_accuracy(const ReportInput& input, std::string_view) {
  const std::vector<KnobFamily> families = knob_families(input.runs);
  return finish(input, accuracy_table(families), group_runs(input.runs), "powder");
}

MadeTable make_effects(const ReportInput& input, std::string_view) {
  return finish(input, effects_table(input.runs), group_runs(input.runs), "powder");
}

struct Maker {
  std::string_view name;
  MadeTable (*make)(const ReportInput& input, std::string_view name);
};

constexpr std::array kMakers = {
    Maker{"powders", make_powders},    Maker{"lognormal_2d", make_lognormal}, Maker{"lognormal_3d", make_lognormal},
    Maker{"bimodal_3d", make_bimodal}, Maker{"furnas", make_furnas},          Maker{"domain_size", make_domain_size},
    Maker{"accuracy", make_accuracy},  Maker{"effects", make_effects},
};

constexpr bool every_table_has_a_maker() {
  return std::all_of(kReportTables.begin(), kReportTables.end(), [](const ReportTableInfo& table) {
    return std::any_of(kMakers.begin(), kMakers.end(), [&](const Maker& maker) { return maker.name == table.name; });
  });
}
static_assert(every_table_has_a_maker());

std::string known_tables() {
  std::string names;
  for (const ReportTableInfo& table : kReportTables)
    names += (names.empty() ? "" : ", ") + std::string(table.name);
  return names;
}

MadeTable make_table(const ReportInput& input, const std::string& name) {
  for (const Maker& maker : kMakers) {
    if (maker.name == name)
      return maker.make(input, name);
  }
  throw InputError(fmt::format("no report table is called \"{}\"; known: {}", name, known_tables()));
}

void require_tables(const Plan& plan) {
  if (plan.report.tables.empty())
    throw InputError(fmt::format("{}: report/tables asks for no table; known: {}", plan.file, known_tables()));
}

/// That runs the jobs which are missing.
std::string run_command(const Plan& plan, const Store& store) {
  std::string command = "tamp run " + plan.file;
  if (store.folder() != "tamp-store") // the default of every command
    command += " --store " + store.folder().string();
  return command;
}

std::string opening(const Plan& plan, std::span<const Table> tables) {
  std::string text = fmt::format("Tables of the campaign {}, file {}.", plan.campaign, plan.file);
  text += " As LaTeX: tables.tex, which inputs";
  for (const Table& table : tables)
    text += fmt::format(" {}.tex", table.name);
  return text + ". As numbers with all digits: the CSV files of the same names.";
}

/// Packings that could not be read, each once, and why the first.
struct Unreadable {
  std::set<std::string> keys;
  std::string why;

  /// The same reader, whose failures are noted here.
  ReadPacking noting(ReadPacking read) {
    if (!read)
      return read;
    return [this, read = std::move(read)](const std::string& key) {
      try {
        return read(key);
      } catch (const Error& error) {
        if (keys.insert(key).second && why.empty())
          why = error.what();
        throw;
      }
    };
  }

  [[nodiscard]] std::string sentence(const std::string& command) const {
    return fmt::format("{} packing{} that the records promise could not be read ({}), so neither figures nor page show "
                       "{}. What is lost is made again by: {}; what is damaged is moved aside by tamp fsck first.",
                       keys.size(), keys.size() == 1 ? "" : "s", why, keys.size() == 1 ? "it" : "them", command);
  }
};

/// None for a campaign that asks for nothing but what knobs or effects do: many of its settings are bad ones on
/// purpose.
Table decision_of(const ReportInput& input) {
  const std::vector<std::string>& tables = input.plan.report.tables;
  const bool of_knobs = std::all_of(tables.begin(), tables.end(),
                                    [](const auto& name) { return name == "accuracy" || name == "effects"; });
  return of_knobs ? Table{} : decision_table(input.runs, input.plan.report.phi_exp);
}

} // namespace

std::vector<Table> report_tables(const ReportInput& input) {
  require_tables(input.plan);
  std::vector<Table> tables;
  if (Table decision = decision_of(input); !decision.panels.empty())
    tables.push_back(std::move(decision));
  for (const std::string& name : input.plan.report.tables)
    tables.push_back(make_table(input, name).table);
  return tables;
}

std::vector<ReportFile> make_report(const ReportInput& asked) {
  Unreadable unreadable;
  ReportInput input = asked;
  input.packing = unreadable.noting(asked.packing);
  input.figures.read_packing = unreadable.noting(asked.figures.read_packing);
  const Plan& plan = input.plan;
  const auto tell = [&](std::string_view now) {
    if (input.progress)
      input.progress(now);
  };
  tell("tables");
  require_tables(plan);
  std::vector<ReportFile> files;
  std::vector<Table> tables;
  if (Table decision = decision_of(input); !decision.panels.empty()) {
    files.push_back({"decision.tex", latex_fragment(decision)});
    files.push_back({"decision.csv", csv_table(decision)});
    tables.push_back(std::move(decision));
  }
  for (const std::string& name : plan.report.tables) {
    const auto [table, records] = make_table(input, name);
    files.push_back({name + ".tex", latex_fragment(table)});
    files.push_back({name + ".csv", csv_table(table)});
    files.push_back({name + "_records.csv", records});
    tables.push_back(table);
  }
  const std::string& title = plan.title.empty() ? plan.campaign : plan.title;
  tell("figures");
  ReportFigures figures = make_figures(input.runs, input.command, input.figures);
  std::vector<FigureMention> mentions;
  std::vector<PageFigure> on_page;
  for (const DrawnFigure& figure : figures.drawn) {
    mentions.push_back({figure.name, figure.caption});
    on_page.push_back({figure.name, figure.caption, figure.svg});
  }
  for (FigureFile& file : figures.files)
    files.push_back({std::move(file.name), std::move(file.bytes)});
  tell("page");
  files.push_back({"tables.tex", latex_document(title, tables, mentions)});
  files.push_back({"index.html", html_page(input, tables, on_page, figures.missing)});
  if (!unreadable.why.empty())
    figures.missing.push_back(figures.trouble.emplace_back(unreadable.sentence(input.command)));
  files.push_back({"report.md", markdown_page(title, opening(plan, tables), tables, mentions, figures.missing)});
  if (input.warn) {
    for (const std::string& sentence : figures.trouble)
      input.warn(sentence);
  }
  return files;
}

std::vector<Run> runs_in(const Store& store, const Plan& plan) {
  return collect_runs(plan, [&](const std::string& key) { return store.find(key); });
}

std::string make_expectation(const Plan& plan, const Store& store, std::string_view version) {
  const std::vector<Run> runs = runs_in(store, plan);
  return expectation_csv(plan.campaign, version, runs, report_tables({plan, runs, run_command(plan, store)}));
}

ExpectationCheck check_report(const Plan& plan, const Store& store, std::span<const ExpectedCell> expected) {
  const std::vector<Run> runs = runs_in(store, plan);
  return check_expectation(expected, report_tables({plan, runs, run_command(plan, store)}));
}

namespace {

/// Reads a store's packings, most of them once: figures and page show the same ones.
class PackingReader {
public:
  explicit PackingReader(const Store& store) : store_(store) {}

  Packing read(const std::string& key) {
    if (const auto known = kept_.find(key); known != kept_.end())
      return known->second;
    Packing packing = store_.read_packing(key);
    if (packing.count() <= room_) {
      room_ -= packing.count();
      kept_.emplace(key, packing);
    }
    return packing;
  }

private:
  const Store& store_;
  std::map<std::string, Packing> kept_;
  std::size_t room_ = 3'000'000; ///< spheres that may still be kept, of 32 bytes each
};

} // namespace

std::vector<std::filesystem::path> write_report(const Plan& plan, const Store& store, const std::filesystem::path& out,
                                                ReportProgress progress, ReportWarning warn) {
  if (progress)
    progress("records");
  const std::vector<Run> runs = runs_in(store, plan);
  PackingReader packings(store);
  const auto read_packing = [&](const std::string& key) { return packings.read(key); };
  const std::vector<ReportFile> files = make_report({plan,
                                                     runs,
                                                     run_command(plan, store),
                                                     store.folder().string(),
                                                     read_packing,
                                                     {true, read_packing},
                                                     std::move(progress),
                                                     std::move(warn)});

  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error)
    throw Error(fmt::format("{}: cannot make the folder: {}", out.string(), error.message()));
  std::vector<std::string> names;
  for (const ReportFile& file : files)
    names.push_back(file.name);
  const Manifest manifest(out);
  manifest.announce(names);
  std::vector<std::filesystem::path> paths;
  for (const ReportFile& file : files) {
    paths.push_back(out / file.name);
    write_atomically(paths.back(), file.bytes);
  }
  manifest.keep_only(names);
  return paths;
}

} // namespace tamp
