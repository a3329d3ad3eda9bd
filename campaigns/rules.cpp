// The table of the file's own keys, and the rules behind sweep paths.
#include "campaigns/rules.h"

#include <array>

namespace tamp {

namespace {

constexpr std::array kTopKeys = {
    TopKey{"$schema", false, "Where an editor finds the schema of this file; tamp itself does not read it."},
    TopKey{"campaign", true, "Name of the campaign in the store: letters, digits, '-', '_' and '.'."},
    TopKey{"title", false, "One line for people; default: the name."},
    TopKey{"extends", false,
           "Campaign file, relative to this one, whose keys hold where this one states none of its own; null takes one "
           "away."},
    TopKey{"scene", true, "What is wanted: the box and the powder."},
    TopKey{"methods", true,
           "The generators to compare: names, or objects with \"name\", \"label\", \"from\" and parameters."},
    TopKey{"sweep", false,
           "What varies: a block of \"grid\", \"zip\", \"points\" and what goes with them, or a list of blocks."},
    TopKey{"replicates", false, "Packings of each point, all different."},
    TopKey{"seed", false, "Chooses the family of random streams."},
    TopKey{"metrics", false,
           "What is measured: names, or objects with \"name\" and parameters; default: every metric that applies to "
           "every scene."},
    TopKey{"budget", false, kBudgetDoc},
    TopKey{"timing", false, "How jobs share the machine."},
    TopKey{"report", false, "What the report of this campaign contains."},
};

Parameter<Repeats> whole_number(std::string_view path, Range range, std::string_view doc,
                                std::int64_t Repeats::*field) {
  return {path,
          "1",
          range,
          doc,
          {},
          [](const Repeats&) { return true; },
          ParameterKind::integer,
          {},
          [field](const Repeats& root) { return JsonLeaf(root.*field); },
          [field](Repeats& root, const JsonLeaf& leaf) { root.*field = std::get<std::int64_t>(leaf); }};
}

} // namespace

std::span<const Parameter<Repeats>> repeat_parameters() {
  constexpr double largest = 0x1.0p53 - 1; // whole numbers that every JSON reader holds exactly (RFC 8259)
  static const std::vector<Parameter<Repeats>> table = {
      whole_number("replicates", {1, 1e5}, "Packings of each point, all different.", &Repeats::replicates),
      whole_number("seed", {0, largest}, "Chooses the family of random streams; another seed, other packings.",
                   &Repeats::seed),
  };
  return table;
}

std::span<const TopKey> top_keys() {
  return kTopKeys;
}

std::optional<ValueRule> sweep_rule(std::string_view path) {
  constexpr std::string_view scene = "scene/";
  constexpr std::string_view method = "method/";
  if (path.substr(0, scene.size()) == scene) {
    if (const auto* row = find_row(scene_parameters(), path.substr(scene.size())))
      return ValueRule(*row);
  } else if (path.substr(0, method.size()) == method) {
    if (const auto* row = find_row(method_parameters(), path.substr(method.size())); row && row->path != "name")
      return ValueRule(*row);
  } else if (const auto* row = find_row(repeat_parameters(), path)) {
    return ValueRule(*row);
  }
  return std::nullopt;
}

const std::vector<std::string>& sweep_paths() {
  static const std::vector<std::string> paths = [] {
    std::vector<std::string> out;
    for (const std::string& path : paths_of(scene_parameters()))
      out.push_back("scene/" + path);
    out.push_back("scene/" + std::string(kFilePath));
    for (const std::string& path : paths_of(method_parameters())) {
      if (path != "name")
        out.push_back("method/" + path);
    }
    for (const std::string& path : paths_of(repeat_parameters()))
      out.push_back(path);
    return out;
  }();
  return paths;
}

} // namespace tamp
