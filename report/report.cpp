// Makes and writes reports.
#include "report/report.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/model/report_tables.h"
#include "report/bimodal_tables.h"
#include "report/csv.h"
#include "report/decision_table.h"
#include "report/domain_size_table.h"
#include "report/latex.h"
#include "report/lognormal_table.h"
#include "report/markdown.h"
#include "report/notes.h"
#include "report/page.h"
#include "store/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

struct Maker {
  std::string_view name;
  MadeTable (*make)(const ReportInput& input, std::string_view name);
};

constexpr std::array kMakers = {
    Maker{"lognormal_2d", make_lognormal}, Maker{"lognormal_3d", make_lognormal},  Maker{"bimodal_3d", make_bimodal},
    Maker{"furnas", make_furnas},          Maker{"domain_size", make_domain_size},
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

std::string opening(const Plan& plan, std::span<const Table> tables) {
  std::string text = fmt::format("Tables of the campaign {}, file {}.", plan.campaign, plan.file);
  text += " As LaTeX: tables.tex, which inputs";
  for (const Table& table : tables)
    text += fmt::format(" {}.tex", table.name);
  return text + ". As numbers with all digits: the CSV files of the same names.";
}

} // namespace

std::vector<ReportFile> make_report(const ReportInput& input) {
  const Plan& plan = input.plan;
  if (plan.report.tables.empty())
    throw InputError(fmt::format("{}: report/tables asks for no table; known: {}", plan.file, known_tables()));
  std::vector<ReportFile> files;
  std::vector<Table> tables;
  if (Table decision = decision_table(input.runs); !decision.panels.empty()) {
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
  files.push_back({"tables.tex", latex_document(title, tables)});
  files.push_back({"report.md", markdown_page(title, opening(plan, tables), tables)});
  files.push_back({"index.html", html_page(input, tables, {}, {})});
  return files;
}

std::vector<std::filesystem::path> write_report(const Plan& plan, const Store& store,
                                                const std::filesystem::path& out) {
  const std::vector<Run> runs = collect_runs(plan, [&](const std::string& key) { return store.find(key); });
  std::string command = "tamp run " + plan.file;
  if (store.folder() != "tamp-store") // the default of every command
    command += " --store " + store.folder().string();
  const std::vector<ReportFile> files = make_report({plan, runs, command, store.folder().string()});

  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error)
    throw Error(fmt::format("{}: cannot make the folder: {}", out.string(), error.message()));
  std::vector<std::filesystem::path> paths;
  for (const ReportFile& file : files) {
    paths.push_back(out / file.name);
    write_atomically(paths.back(), file.bytes);
  }
  return paths;
}

} // namespace tamp
