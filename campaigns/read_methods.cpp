// The methods and metrics of a campaign file: lists of names, or of objects with a name and parameters.
#include "campaigns/campaign_file.h"
#include "campaigns/nearest.h"
#include "engine/model/job.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

namespace {

using Kind = JsonNode::Kind;

template <class Root>
struct Entry {
  Root root;
  const JsonNode* label = nullptr; ///< of methods alone, as is `from`
  const JsonNode* from = nullptr;
};

/// Tells what is wrong with a key that no row of this entry's name has.
template <class Root>
void wrong_key(const JsonMember& member, const std::string& pointer, std::span<const Parameter<Root>> table,
               const Root& root, bool labelled, std::string_view name, Mistakes& mistakes) {
  std::vector<std::string> applying;
  for (const auto& row : table) {
    if (row.applies(root))
      applying.emplace_back(row.path);
  }
  if (labelled)
    applying.insert(applying.end(), {"label", "from"});
  if (const auto* row = find_row(table, member.key)) {
    mistakes.add({{pointer, member.offset},
                  fmt::format("\"{}\" does not apply to {}: it counts only when {}", member.key, name, row->when),
                  quoted_list(applying),
                  ""});
  } else {
    unknown_key(member, pointer, applying, {}, mistakes);
  }
}

/// One entry of the list: "name" or {"name": …, parameters}. Nothing if even its name is wrong.
template <class Root>
std::optional<Entry<Root>> read_entry(const JsonNode& node, const std::string& pointer,
                                      std::span<const Parameter<Root>> table, bool labelled, Mistakes& mistakes) {
  const Parameter<Root>& name_row = *find_row(table, "name");
  const JsonNode* name = &node;
  std::string name_pointer = pointer;
  if (node.kind == Kind::object) {
    name = node.find("name");
    name_pointer = json_pointer(pointer, "name");
    if (name == nullptr) {
      mistakes.add({{name_pointer, node.offset}, "\"name\" is missing", ValueRule(name_row).allowed(), ""});
      return std::nullopt;
    }
  }
  const auto leaf = read_value(*name, ValueRule(name_row), name_pointer, mistakes);
  if (!leaf)
    return std::nullopt;
  Entry<Root> entry;
  name_row.set(entry.root, *leaf);
  for (const JsonMember& member : node.members) {
    const std::string inner = json_pointer(pointer, member.key);
    const auto* row = find_row(table, member.key);
    if (row == &name_row)
      continue;
    if (labelled && member.key == "label") {
      entry.label = &member.value;
    } else if (labelled && member.key == "from") {
      entry.from = &member.value;
    } else if (row == nullptr || !row->applies(entry.root)) {
      wrong_key(member, inner, table, entry.root, labelled, std::get<std::string>(*leaf), mistakes);
    } else if (const auto value = read_value(member.value, ValueRule(*row), inner, mistakes)) {
      row->set(entry.root, *value);
    }
  }
  return entry;
}

bool is_label(std::string_view text) {
  constexpr std::size_t longest = 100;
  return !text.empty() && text.size() <= longest &&
         std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

void read_label(const JsonNode& node, const std::string& pointer, MethodEntry& method, Reading& reading) {
  if (!expect_kind(node, Kind::text, "a text", pointer, reading.mistakes))
    return;
  method.label = node.text;
  if (!is_label(method.label))
    reading.mistakes.add({{pointer, node.offset}, "the label is empty or too long", "1 to 100 bytes on one line", ""});
}

/// Sets what the entry starts from: `node` (null if there is none) is the label of an entry read before.
void read_from(const JsonNode* node, const Place& place, MethodEntry& method, Reading& reading) {
  const Start start = info(method.method.name).start;
  std::vector<std::string> labels;
  for (const MethodEntry& entry : reading.file.methods)
    labels.push_back(entry.label);
  if (node == nullptr) {
    if (start == Start::packing)
      reading.mistakes.add({place,
                            fmt::format("{} starts from the packing of another method, and \"from\" is missing",
                                        name_of(method.method.name)),
                            labels.empty() ? "the label of an entry further up" : quoted_list(labels), ""});
    return;
  }
  if (start == Start::scene) {
    reading.mistakes.add(
        {place, fmt::format("{} does not start from a packing", name_of(method.method.name)), "no \"from\"", ""});
    return;
  }
  if (!expect_kind(*node, Kind::text, "the label of an entry further up", place.pointer, reading.mistakes))
    return;
  const auto found = std::find(labels.begin(), labels.end(), node->text);
  if (found != labels.end())
    method.from = static_cast<std::size_t>(found - labels.begin());
  else if (reading.file.whole) // else it may be the label of an entry that was not understood
    reading.mistakes.add({place, fmt::format("no entry further up has the label \"{}\"", node->text),
                          labels.empty() ? "the label of an entry further up" : quoted_list(labels),
                          nearest(node->text, labels)});
}

} // namespace

void read_methods(const JsonNode& node, Reading& reading) {
  const std::string due = "a list of methods, each a name or an object";
  if (!expect_kind(node, Kind::list, due, "/methods", reading.mistakes)) {
    reading.file.whole = false;
    return;
  }
  if (node.items.empty())
    reading.mistakes.add({{"/methods", node.offset}, "the list of methods is empty", "at least one method", ""});
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string pointer = json_pointer("/methods", std::to_string(i));
    const auto entry = read_entry(node.items[i], pointer, method_parameters(), true, reading.mistakes);
    if (!entry) {
      reading.file.whole = false;
      continue;
    }
    MethodEntry method{entry->root, std::string(name_of(entry->root.name)), {}};
    if (entry->label != nullptr)
      read_label(*entry->label, json_pointer(pointer, "label"), method, reading);
    const auto same = [&](const MethodEntry& other) { return other.label == method.label; };
    if (std::any_of(reading.file.methods.begin(), reading.file.methods.end(), same))
      reading.mistakes.add({{pointer, node.items[i].offset},
                            fmt::format("two methods have the label \"{}\"", method.label),
                            "labels that tell the rows of a table apart: give this entry a \"label\" of its own",
                            ""});
    const Place place{json_pointer(pointer, "from"),
                      entry->from != nullptr ? entry->from->offset : node.items[i].offset};
    read_from(entry->from, place, method, reading);
    reading.file.methods.push_back(std::move(method));
  }
}

void read_metrics(const JsonNode& node, Reading& reading) {
  if (!expect_kind(node, Kind::list, "a list of metrics, each a name or an object", "/metrics", reading.mistakes))
    return;
  std::vector<Metric>& listed = reading.file.metrics.emplace();
  std::set<std::string> seen;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string pointer = json_pointer("/metrics", std::to_string(i));
    const auto entry = read_entry(node.items[i], pointer, metric_parameters(), false, reading.mistakes);
    if (!entry)
      continue;
    if (!seen.insert(canonical(entry->root, "")).second)
      reading.mistakes.add(
          {{pointer, node.items[i].offset},
           fmt::format("the metric {} stands twice with the same parameters", name_of(entry->root.name)),
           "each metric once",
           ""});
    listed.push_back(entry->root);
  }
}

} // namespace tamp
