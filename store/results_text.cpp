// Rows of results as JSON and as CSV.
#include "store/results_export.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace tamp {
namespace {

using Json = nlohmann::ordered_json;

/// A part of the canonical job; empty for a record made by hand without one.
Json part_of(const ResultRow& row, const char* part) {
  const Json document = Json::parse(row.generation.canonical, nullptr, false);
  return document.is_object() ? document.value(part, Json::object()) : Json::object();
}

/// The method's parameters, without its name, which stands by itself.
Json parameters_of(const ResultRow& row) {
  Json method = part_of(row, "method");
  method.erase("name");
  return method;
}

Json json_of(const ResultRow& row) {
  const Record& record = row.generation;
  Json measures = Json::object();
  for (const Measure& m : row.measures)
    measures[m.name] = {{"value", m.value}, {"unit", m.unit}};
  return {{"key", record.key},
          {"campaign", row.campaign},
          {"method", record.name},
          {"label", row.label},
          {"parent", record.parent},
          {"scene", part_of(row, "scene")},
          {"parameters", parameters_of(row)},
          {"replicate", row.replicate},
          {"outcome", name_of(record.outcome)},
          {"reason", record.reason},
          {"time",
           {{"wall_s", record.timing.wall_s},
            {"cpu_s", record.timing.cpu_s},
            {"peak_rss_bytes", record.timing.peak_rss_bytes},
            {"mode", name_of(record.timing.mode)}}},
          {"measures", measures}};
}

/// Adds the leaves below a node as path → text; a list is one leaf.
void collect_leaves(const Json& node, const std::string& path, std::map<std::string, std::string>& leaves) {
  if (node.is_object()) {
    for (const auto& [name, child] : node.items())
      collect_leaves(child, path + "/" + name, leaves);
  } else {
    leaves[path] = node.is_string() ? node.get<std::string>() : node.dump();
  }
}

std::string number(double value) {
  return Json(value).dump();
}

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

void add_line(const std::vector<std::string>& fields, std::string& out) {
  for (std::size_t i = 0; i < fields.size(); ++i)
    out += (i > 0 ? "," : "") + field(fields[i]);
  out += "\r\n";
}

constexpr std::array fixed_columns{"key",     "campaign", "method", "label", "parent",         "replicate",
                                   "outcome", "reason",   "wall_s", "cpu_s", "peak_rss_bytes", "mode"};

std::vector<std::string> fixed_fields(const ResultRow& row) {
  const Record& r = row.generation;
  return {r.key,
          row.campaign,
          r.name,
          row.label,
          r.parent,
          std::to_string(row.replicate),
          std::string(name_of(r.outcome)),
          r.reason,
          number(r.timing.wall_s),
          number(r.timing.cpu_s),
          std::to_string(r.timing.peak_rss_bytes),
          std::string(name_of(r.timing.mode))};
}

} // namespace

std::string results_json(std::span<const ResultRow> rows) {
  Json list = Json::array();
  for (const ResultRow& row : rows)
    list.push_back(json_of(row));
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string results_csv(std::span<const ResultRow> rows) {
  // Columns of scenes and methods by name; those of measures in the order in which they first appear.
  std::vector<std::map<std::string, std::string>> cells(rows.size());
  std::set<std::string> job_columns;
  std::vector<std::string> measure_columns;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    collect_leaves(part_of(rows[i], "scene"), "scene", cells[i]);
    collect_leaves(parameters_of(rows[i]), "method", cells[i]);
    for (const auto& [name, text] : cells[i])
      job_columns.insert(name);
    for (const Measure& m : rows[i].measures) {
      const std::string column = m.unit == "1" ? m.name : m.name + " [" + m.unit + "]";
      cells[i][column] = number(m.value);
      if (std::find(measure_columns.begin(), measure_columns.end(), column) == measure_columns.end())
        measure_columns.push_back(column);
    }
  }
  std::vector<std::string> header(fixed_columns.begin(), fixed_columns.end());
  for (const std::string& name : job_columns)
    header.push_back(name);
  header.insert(header.end(), measure_columns.begin(), measure_columns.end());

  std::string out;
  add_line(header, out);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> line = fixed_fields(rows[i]);
    for (std::size_t c = fixed_columns.size(); c < header.size(); ++c)
      line.push_back(cells[i][header[c]]);
    add_line(line, out);
  }
  return out;
}

} // namespace tamp
