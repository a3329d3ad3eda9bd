// Writes the reference page from the parameter tables.
#include "campaigns/reference.h"

#include "campaigns/rules.h"
#include "engine/model/report_tables.h"

#include <fmt/format.h>

namespace tamp {

namespace {

template <class Root>
std::string allowed(const Parameter<Root>& row) {
  std::string out;
  switch (row.kind) {
  case ParameterKind::choice:
    for (const std::string_view name : row.choices)
      out += fmt::format("{}`{}`", out.empty() ? "" : ", ", name);
    return out;
  case ParameterKind::boolean:
    return "`true`, `false`";
  case ParameterKind::integer:
    return "whole number, " + row.range.words();
  case ParameterKind::number:
    return row.range.words() == "any number" ? "number" : "number, " + row.range.words();
  case ParameterKind::numbers:
    return "numbers, each " + row.range.words();
  }
  return out;
}

template <class Root>
std::string table(std::span<const Parameter<Root>> rows, std::string_view prefix, std::string_view only = {},
                  std::string_view without = {}) {
  std::string out = "| path | allowed | unit | default | counts when | meaning |\n|---|---|---|---|---|---|\n";
  for (const auto& row : rows) {
    if ((!only.empty() && row.path != only) || (!without.empty() && row.path == without))
      continue;
    const JsonLeaf standard = row.get(Root{});
    out += fmt::format("| `{}{}` | {} | {} | {} | {} | {} |\n", prefix, row.path, allowed(row), row.unit,
                       is_unstated(standard) ? "–" : fmt::format("`{}`", leaf_words(standard)),
                       row.when.empty() ? "always" : row.when, row.doc);
  }
  return out;
}

/// Name and summary of each row of a table of methods, metrics or report tables.
template <class Infos, class Name>
std::string list(const Infos& infos, const Name& name) {
  std::string out;
  for (const auto& entry : infos)
    out += fmt::format("- `{}`: {}\n", name(entry), entry.summary);
  return out;
}

/// The methods that can start from a packing, in words.
std::string starters() {
  std::string names;
  for (const MethodInfo& method : methods()) {
    if (method.start != Start::scene)
      names += fmt::format("{}{}{}", names.empty() ? "name = " : " or ", name_of(method.name),
                           method.start == Start::packing ? " (required)" : "");
  }
  return names.empty() ? "never yet" : names;
}

} // namespace

std::string reference_page() {
  std::string out =
      "# Reference of campaign files\n\n"
      "Written from the parameter tables by `reference_page()`; a test fails if this page is stale. How to write a "
      "campaign: [README.md](README.md).\n\n"
      "A dash as default: not stated. Lengths are in the unit that `scene/unit` names.\n\n"
      "## Keys at the top\n\n| key | required | meaning |\n|---|---|---|\n";
  for (const TopKey& key : top_keys())
    out += fmt::format("| `{}` | {} | {} |\n", key.name, key.required ? "yes" : "no", key.doc);
  out += "\n" + table(repeat_parameters(), "") + "\n";

  out += "## Scene\n\nPaths below `scene`; any of them can be swept.\n\n" + table(scene_parameters(), "scene/");
  out += fmt::format("| `scene/{}` | text | 1 | – | psd/law = histogram | {} |\n\n", kFilePath, kFileDoc);

  out += "## Methods\n\n" + list(methods(), [](const MethodInfo& entry) { return name_of(entry.name); });
  out += "\nParameters stand in the method's entry; all but the name can be swept by these paths.\n\n" +
         table(method_parameters(), "method/");
  out += fmt::format("| `label` | text | 1 | the name | always | {} |\n", kLabelDoc);
  out += fmt::format("| `from` | text | 1 | – | {} | {} |\n\n", starters(), kFromDoc);

  out += "## Metrics\n\n" + list(metrics(), [](const MetricInfo& entry) { return name_of(entry.name); });
  out += "\nParameters stand in the metric's entry.\n\n" + table(metric_parameters(), "") + "\n";

  out += "## Sweep\n\n";
  for (const auto& [key, doc] :
       {std::pair{"grid", kGridDoc}, std::pair{"zip", kZipDoc}, std::pair{"points", kPointsDoc},
        std::pair{"include", kIncludeDoc}, std::pair{"exclude", kExcludeDoc}, std::pair{"when", kWhenDoc},
        std::pair{"derived", kDerivedDoc}})
    out += fmt::format("- `{}`: {}\n", key, doc);
  out += '\n';

  out += "## Running\n\n`timing` stands at the top, the rest under `budget`.\n\n" +
         table(run_parameters(), "budget/", {}, "timing");
  const std::string timing = table(run_parameters(), "", "timing");
  out += timing.substr(timing.find("| `timing`")) + "\n";

  out += "## Report\n\n" + std::string(kTablesDoc) + " Under `report/tables`:\n\n" +
         list(kReportTables, [](const ReportTableInfo& entry) { return entry.name; }) + "\n" +
         table(report_parameters(), "report/");
  return out;
}

} // namespace tamp
