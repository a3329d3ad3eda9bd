// Builds the JSON Schema from the parameter tables.
#include "campaigns/schema.h"

#include "campaigns/rules.h"
#include "engine/model/report_tables.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace tamp {

namespace {

using Json = nlohmann::ordered_json;

/// A number without a needless ".0".
Json number(double value) {
  constexpr double largest = 0x1.0p53;
  if (std::trunc(value) == value && std::abs(value) < largest)
    return static_cast<std::int64_t>(value);
  return value;
}

Json bounded(std::string_view type, const Range& range) {
  Json out = {{"type", type}};
  if (std::isfinite(range.low))
    out[range.low_open ? "exclusiveMinimum" : "minimum"] = number(range.low);
  if (std::isfinite(range.high))
    out[range.high_open ? "exclusiveMaximum" : "maximum"] = number(range.high);
  return out;
}

Json value_of(const JsonLeaf& leaf) {
  return std::visit(
      [](const auto& value) -> Json {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>)
          return number(value);
        else
          return value;
      },
      leaf);
}

std::string description(const ValueRule& rule) {
  std::string out(rule.doc);
  if (rule.unit != "1")
    out += " Unit: " + std::string(rule.unit) + ".";
  if (!rule.when.empty())
    out += " Counts when " + std::string(rule.when) + ".";
  return out;
}

/// The schema of one parameter's value.
template <class Root>
Json parameter(const Parameter<Root>& row) {
  Json out;
  switch (row.kind) {
  case ParameterKind::boolean:
    out["type"] = "boolean";
    break;
  case ParameterKind::integer:
    out = bounded("integer", row.range);
    break;
  case ParameterKind::number:
    out = bounded("number", row.range);
    break;
  case ParameterKind::choice:
    out["enum"] = row.choices;
    break;
  case ParameterKind::numbers: {
    const Json one = bounded("number", row.range);
    out["anyOf"] = {one, {{"type", "array"}, {"items", one}, {"minItems", 1}}};
    break;
  }
  }
  out["description"] = description(ValueRule(row));
  if (const JsonLeaf leaf = row.get(Root{}); !is_unstated(leaf))
    out["default"] = value_of(leaf);
  return out;
}

Json object(std::string_view doc) {
  return {{"type", "object"}, {"description", doc}, {"properties", Json::object()}, {"additionalProperties", false}};
}

/// A name in $defs for a path; '/' would have to be escaped in references.
std::string definition(std::string path) {
  for (char& c : path)
    c = c == '/' ? '.' : c;
  return path;
}

Json reference(const std::string& path) {
  return {{"$ref", "#/$defs/" + definition(path)}};
}

template <class Root>
void define(Json& definitions, std::span<const Parameter<Root>> table, const std::string& prefix) {
  for (const auto& row : table)
    definitions[definition(prefix + std::string(row.path))] = parameter(row);
}

/// The scene, nested as its paths are.
Json scene() {
  Json out = object("What is wanted: the box and the powder.");
  std::vector<std::string> paths = paths_of(scene_parameters());
  paths.emplace_back(kFilePath);
  for (const std::string& path : paths) {
    Json* level = &out;
    std::size_t begin = 0;
    for (std::size_t slash = 0; (slash = path.find('/', begin)) != std::string::npos; begin = slash + 1) {
      Json& inner = (*level)["properties"][path.substr(begin, slash - begin)];
      if (inner.is_null())
        inner = object("Particle size distribution: the law of the radii and its parameters.");
      level = &inner;
    }
    (*level)["properties"][path.substr(begin)] = reference("scene/" + path);
  }
  return out;
}

/// Which parameters of a powder have a meaning for each law. A sweep may change the law from point to point, so this
/// holds for files without a sweep alone; and an extended file may state the rest.
Json law_conditions() {
  Json all = Json::array();
  constexpr std::string_view group = "psd/";
  for (const auto law : EnumNames<Law>::value) {
    Scene scene;
    scene.psd.law = *enum_of<Law>(law);
    Json excluded = Json::object();
    for (const auto& row : scene_parameters()) {
      if (row.path.substr(0, group.size()) == group && !row.applies(scene))
        excluded[std::string(row.path.substr(group.size()))] = false;
    }
    if (scene.psd.law != Law::histogram)
      excluded["file"] = false;
    const auto at_psd = [](Json psd) -> Json {
      return {{"scene", {{"required", {"psd"}}, {"properties", {{"psd", std::move(psd)}}}}}};
    };
    Json condition = {{"not", {{"anyOf", {{{"required", {"sweep"}}}, {{"required", {"extends"}}}}}}},
                      {"required", {"scene"}},
                      {"properties", at_psd({{"required", {"law"}}, {"properties", {{"law", {{"const", law}}}}}})}};
    all.push_back({{"if", std::move(condition)}, {"then", {{"properties", at_psd({{"properties", excluded}})}}}});
  }
  return all;
}

/// An entry of a list of methods or metrics: a bare name, or an object with the parameters of that name.
template <class Root>
Json entries(std::span<const Parameter<Root>> table, const std::string& prefix, std::string_view doc, bool labelled) {
  const Parameter<Root>& name_row = *find_row(table, "name");
  Json choices = Json::array({reference(prefix + "name")});
  for (const std::string_view name : name_row.choices) {
    Root root;
    name_row.set(root, JsonLeaf(std::string(name)));
    Json entry = object("Parameters of " + std::string(name) + ".");
    entry["required"] = {"name"};
    Json& properties = entry["properties"];
    properties["name"] = {{"const", name}};
    if (labelled)
      properties["label"] = {{"type", "string"}, {"minLength", 1}, {"maxLength", 100}, {"description", kLabelDoc}};
    if constexpr (std::is_same_v<Root, Method>) {
      const Start start = info(root.name).start;
      if (start != Start::scene)
        properties["from"] = {{"type", "string"}, {"description", kFromDoc}};
      if (start == Start::packing)
        entry["required"].push_back("from");
    }
    for (const auto& row : table) {
      if (row.path != "name" && row.applies(root))
        properties[std::string(row.path)] = reference(prefix + std::string(row.path));
    }
    choices.push_back(std::move(entry));
  }
  return {{"type", "array"}, {"description", doc}, {"items", {{"anyOf", std::move(choices)}}}};
}

/// A block, with what it refers to put into `definitions`.
Json sweep_block(Json& definitions) {
  Json lists = Json::object();
  Json values = Json::object();
  for (const std::string& path : sweep_paths()) {
    lists[path] = {{"type", "array"}, {"minItems", 1}, {"items", reference(path)}};
    values[path] = reference(path);
  }
  Json block = object("Parts of one block multiply, the first varying slowest.");
  block["minProperties"] = 1;
  const auto map_of = [](const Json& properties, std::string_view doc) {
    Json out = object(doc);
    out["properties"] = properties;
    return out;
  };
  for (const auto& [key, doc] : {std::pair{"grid", kGridDoc}, std::pair{"zip", kZipDoc}}) {
    block["properties"][key] = map_of(lists, doc);
    block["properties"][key]["minProperties"] = 1;
  }
  definitions["sweep_points"] = {
      {"type", "array"}, {"minItems", 1}, {"description", kPointsDoc}, {"items", map_of(values, "One point.")}};
  block["properties"]["points"] = {{"$ref", "#/$defs/sweep_points"}};
  block["properties"]["include"] = {{"$ref", "#/$defs/sweep_points"}, {"description", kIncludeDoc}};
  const auto one_or_more = [](const Json& value) -> Json {
    return {{"anyOf", {value, {{"type", "array"}, {"minItems", 1}, {"items", value}}}}};
  };
  Json conditions = {{"method", one_or_more({{"type", "string"}})}};
  Json numeric = Json::array();
  for (const std::string& path : sweep_paths()) {
    const auto rule = sweep_rule(path);
    if (rule)
      conditions[path] = one_or_more(reference(path));
    if (rule && is_numeric(rule->kind))
      numeric.push_back(path);
  }
  definitions["sweep_condition"] = map_of(conditions, "Holds where each path has one of its values.");
  definitions["sweep_condition"]["minProperties"] = 1;
  const Json condition = {{"$ref", "#/$defs/sweep_condition"}};
  block["properties"]["when"] = {{"$ref", "#/$defs/sweep_condition"}, {"description", kWhenDoc}};
  block["properties"]["exclude"] = {
      {"type", "array"}, {"minItems", 1}, {"description", kExcludeDoc}, {"items", condition}};
  block["properties"]["derived"] = {{"type", "object"},
                                    {"description", kDerivedDoc},
                                    {"minProperties", 1},
                                    {"propertyNames", {{"enum", numeric}}},
                                    {"additionalProperties", {{"type", "string"}}}};
  return block;
}

/// The value of one key at the top.
Json top_value(std::string_view name, std::string_view doc) {
  if (name == "scene")
    return scene();
  if (name == "methods") {
    Json list = entries(method_parameters(), "method/", doc, true);
    list["minItems"] = 1;
    return list;
  }
  if (name == "metrics")
    return entries(metric_parameters(), "metric/", doc, false);
  if (name == "sweep") {
    const Json block = {{"$ref", "#/$defs/sweep_block"}};
    return {{"description", doc}, {"anyOf", {block, {{"type", "array"}, {"minItems", 1}, {"items", block}}}}};
  }
  if (name == "timing")
    return reference("run/timing");
  if (name == "budget") {
    Json out = object(doc);
    for (const std::string& path : paths_of(run_parameters())) {
      if (path != "timing")
        out["properties"][path] = reference("run/" + path);
    }
    return out;
  }
  if (name == "report") {
    Json tables = Json::array();
    for (const ReportTableInfo& table : kReportTables)
      tables.push_back({{"const", table.name}, {"description", table.summary}});
    Json out = object(doc);
    out["properties"]["tables"] = {
        {"type", "array"}, {"description", kTablesDoc}, {"uniqueItems", true}, {"items", {{"anyOf", tables}}}};
    for (const std::string& path : paths_of(report_parameters()))
      out["properties"][path] = reference("report/" + path);
    return out;
  }
  if (find_row(repeat_parameters(), name) != nullptr)
    return reference(std::string(name));
  Json out = {{"type", "string"}, {"description", doc}};
  if (name == "campaign")
    out["pattern"] = "^[A-Za-z0-9_][A-Za-z0-9._-]{0,99}$";
  return out;
}

} // namespace

std::string schema_json() {
  Json schema = object("A campaign of tamp: which packings to make, how often, and what to measure on them.");
  Json top = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "tamp campaign"}};
  top.update(schema);
  Json required = Json::array();
  for (const TopKey& key : top_keys()) {
    top["properties"][std::string(key.name)] = top_value(key.name, key.doc);
    if (key.required)
      required.push_back(key.name);
  }
  top["required"] = {"campaign"}; // the rest may come from the extended file
  top["allOf"] = law_conditions();
  top["allOf"].push_back({{"if", {{"not", {{"required", {"extends"}}}}}}, {"then", {{"required", required}}}});
  Json& definitions = top["$defs"];
  define(definitions, scene_parameters(), "scene/");
  definitions[definition("scene/" + std::string(kFilePath))] = {{"type", "string"}, {"description", kFileDoc}};
  define(definitions, method_parameters(), "method/");
  define(definitions, metric_parameters(), "metric/");
  define(definitions, run_parameters(), "run/");
  define(definitions, report_parameters(), "report/");
  define(definitions, repeat_parameters(), "");
  Json block = sweep_block(definitions);
  definitions["sweep_block"] = std::move(block);
  return top.dump(2) + "\n";
}

} // namespace tamp
