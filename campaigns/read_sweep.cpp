// The sweep of a campaign file: blocks of grid, zip and points, as axes that multiply, and what goes with them.
#include "campaigns/campaign_file.h"
#include "campaigns/nearest.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

namespace {

using Kind = JsonNode::Kind;

class BlockReader {
public:
  BlockReader(Reading& reading, std::string pointer) : reading_(reading), pointer_(std::move(pointer)) {}

  void read(const JsonNode& node) {
    block_.place = {pointer_, node.offset};
    if (!expect_kind(node, Kind::object, "an object with \"grid\", \"zip\", \"points\", …", pointer_, mistakes())) {
      misunderstood();
      return;
    }
    if (node.members.empty())
      refuse(block_.place, "the block is empty", "\"grid\", \"zip\" or \"points\"");
    const std::vector<std::string> keys = {"grid", "zip", "points", "include", "exclude", "when", "derived"};
    for (const JsonMember& member : node.members) {
      const std::string inner = json_pointer(pointer_, member.key);
      if (member.key == "grid") {
        grid(member.value, inner);
      } else if (member.key == "zip") {
        zip(member.value, inner);
      } else if (member.key == "points") {
        points(member.value, inner);
      } else if (member.key == "include") {
        std::set<std::string> apart; // of the paths of the block
        block_.include = list_of_points(member.value, inner, apart);
      } else if (member.key == "exclude") {
        exclude(member.value, inner);
      } else if (member.key == "when") {
        block_.when = condition(member.value, inner);
      } else if (member.key == "derived") {
        derived(member.value, inner);
      } else {
        unknown_key(member, inner, keys, {}, mistakes());
        misunderstood();
      }
    }
    reading_.file.sweep.push_back(std::move(block_));
  }

private:
  Mistakes& mistakes() { return reading_.mistakes; }
  void misunderstood() { reading_.file.whole = false; }
  void refuse(const Place& place, std::string what, std::string allowed, std::string near = {}) {
    mistakes().add({place, std::move(what), std::move(allowed), std::move(near)});
    misunderstood();
  }

  /// Whether a key is a path that can be swept, and the first of its kind in this block.
  bool known_path(const JsonMember& member, const std::string& pointer, std::set<std::string>& taken) {
    const Place place{pointer, member.offset};
    const auto& paths = sweep_paths();
    if (member.key == "method/name") {
      refuse(place, "\"method/name\" cannot be swept", "list the methods to compare under \"methods\"");
      return false;
    }
    if (std::find(paths.begin(), paths.end(), member.key) == paths.end()) {
      refuse(place, fmt::format("unknown parameter path \"{}\"", member.key), quoted_list(paths),
             nearest(member.key, paths));
      return false;
    }
    if (!taken.insert(member.key).second) {
      refuse(place, fmt::format("\"{}\" is swept twice in one block", member.key),
             "each path once a block; a list of blocks joins sweeps");
      return false;
    }
    return true;
  }

  /// The lists of a grid or zip: path → values, all checked.
  std::vector<std::vector<Statement>> columns(const JsonNode& node, const std::string& pointer) {
    std::vector<std::vector<Statement>> out;
    if (!expect_kind(node, Kind::object, "an object of paths and lists of values", pointer, mistakes())) {
      misunderstood();
      return out;
    }
    if (node.members.empty())
      refuse({pointer, node.offset}, "the sweep is empty", "at least one path with a list of values");
    for (const JsonMember& member : node.members) {
      const std::string inner = json_pointer(pointer, member.key);
      if (!known_path(member, inner, taken_))
        continue;
      const JsonNode& list = member.value;
      if (!expect_kind(list, Kind::list, "a list of values", inner, mistakes())) {
        misunderstood();
        continue;
      }
      if (list.items.empty()) {
        refuse({inner, list.offset}, "[] is an empty sweep", "a list of at least one value");
        continue;
      }
      const std::size_t group = add_group(member.key, {inner, member.offset}, reading_.file);
      std::vector<Statement> column;
      for (std::size_t i = 0; i < list.items.size(); ++i)
        column.push_back(
            read_statement(member.key, list.items[i], json_pointer(inner, std::to_string(i)), group, reading_));
      out.push_back(std::move(column));
    }
    return out;
  }

  void grid(const JsonNode& node, const std::string& pointer) {
    for (auto& column : columns(node, pointer)) {
      Axis axis;
      for (Statement& statement : column)
        axis.push_back({statement.place, {statement}});
      block_.axes.push_back(std::move(axis));
    }
  }

  void zip(const JsonNode& node, const std::string& pointer) {
    const auto lists = columns(node, pointer);
    if (lists.empty())
      return;
    const std::size_t length = lists.front().size();
    std::string lengths;
    for (const auto& list : lists)
      lengths += fmt::format("{}{} has {}", lengths.empty() ? "" : ", ", list.front().path, list.size());
    if (std::any_of(lists.begin(), lists.end(), [&](const auto& list) { return list.size() != length; })) {
      refuse({pointer, node.offset}, "the lists of a zip differ in length: " + lengths, "lists of equal length");
      return;
    }
    Axis axis(length, Step{{pointer, node.offset}, {}});
    for (const auto& list : lists) {
      for (std::size_t i = 0; i < length; ++i)
        axis[i].statements.push_back(list[i]);
    }
    block_.axes.push_back(std::move(axis));
  }

  void points(const JsonNode& node, const std::string& pointer) {
    if (Axis axis = list_of_points(node, pointer, taken_); !axis.empty())
      block_.axes.push_back(std::move(axis));
  }

  /// Points written out; adds their paths to `taken`, which no point may repeat.
  Axis list_of_points(const JsonNode& node, const std::string& pointer, std::set<std::string>& taken) {
    Axis axis;
    if (!expect_kind(node, Kind::list, "a list of points, each an object of paths and values", pointer, mistakes())) {
      misunderstood();
      return axis;
    }
    if (node.items.empty())
      refuse({pointer, node.offset}, "[] is an empty sweep", "a list of at least one point");
    const std::set<std::string> before = taken;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string inner = json_pointer(pointer, std::to_string(i));
      if (!expect_kind(node.items[i], Kind::object, "an object of paths and values", inner, mistakes())) {
        misunderstood();
        continue;
      }
      Step step{{inner, node.items[i].offset}, {}};
      std::set<std::string> here = before;
      for (const JsonMember& member : node.items[i].members) {
        const std::string place = json_pointer(inner, member.key);
        if (!known_path(member, place, here))
          continue;
        const std::size_t group = add_group(member.key, {place, member.offset}, reading_.file);
        step.statements.push_back(read_statement(member.key, member.value, place, group, reading_));
      }
      taken.insert(here.begin(), here.end());
      axis.push_back(std::move(step));
    }
    return axis;
  }

  void exclude(const JsonNode& node, const std::string& pointer) {
    if (!expect_kind(node, Kind::list, "a list of conditions, each an object of paths and values", pointer,
                     mistakes())) {
      misunderstood();
      return;
    }
    for (std::size_t i = 0; i < node.items.size(); ++i)
      block_.exclude.push_back(condition(node.items[i], json_pointer(pointer, std::to_string(i))));
  }

  /// The items of a list, or a single value as the only one.
  static std::vector<std::pair<const JsonNode*, std::string>> alternatives(const JsonNode& node,
                                                                           const std::string& pointer) {
    if (node.kind != Kind::list)
      return {{&node, pointer}};
    std::vector<std::pair<const JsonNode*, std::string>> out;
    for (std::size_t i = 0; i < node.items.size(); ++i)
      out.emplace_back(&node.items[i], json_pointer(pointer, std::to_string(i)));
    return out;
  }

  Condition condition(const JsonNode& node, const std::string& pointer) {
    Condition out{{pointer, node.offset}, {}, {}};
    if (!expect_kind(node, Kind::object, "an object of paths (or \"method\") and values", pointer, mistakes())) {
      misunderstood();
      return out;
    }
    if (node.members.empty())
      refuse(out.place, "the condition is empty", "at least one path, or \"method\"");
    std::set<std::string> here;
    for (const JsonMember& member : node.members) {
      const std::string inner = json_pointer(pointer, member.key);
      const auto values = alternatives(member.value, inner);
      if (values.empty())
        refuse({inner, member.value.offset}, "[] allows nothing", "a value, or a list of at least one");
      if (member.key == "method") {
        for (const auto& [value, place] : values)
          method(*value, place, out);
      } else if (known_path(member, inner, here)) {
        const auto rule = sweep_rule(member.key);
        if (!rule) {
          refuse({inner, member.offset}, fmt::format("\"{}\" cannot stand in a condition", member.key),
                 "paths of numbers, words and true or false");
          continue;
        }
        for (const auto& [value, place] : values) {
          if (auto leaf = read_value(*value, *rule, place, mistakes()))
            out.values[member.key].push_back(std::move(*leaf));
        }
      }
    }
    return out;
  }

  void method(const JsonNode& node, const std::string& pointer, Condition& out) {
    std::vector<std::string> known;
    for (const MethodEntry& entry : reading_.file.methods) {
      for (const std::string& word : {entry.label, std::string(name_of(entry.method.name))}) {
        if (std::find(known.begin(), known.end(), word) == known.end())
          known.push_back(word);
      }
    }
    if (!expect_kind(node, Kind::text, "a label or name of a method", pointer, mistakes()))
      misunderstood();
    else if (std::find(known.begin(), known.end(), node.text) == known.end())
      refuse({pointer, node.offset}, fmt::format("\"{}\" is none of the methods", node.text), quoted_list(known),
             nearest(node.text, known));
    else
      out.methods.push_back(node.text);
  }

  void derived(const JsonNode& node, const std::string& pointer) {
    if (!expect_kind(node, Kind::object, "an object of paths and expressions", pointer, mistakes())) {
      misunderstood();
      return;
    }
    if (node.members.empty())
      refuse({pointer, node.offset}, "nothing is derived", "at least one path with an expression");
    for (const JsonMember& member : node.members) {
      const std::string inner = json_pointer(pointer, member.key);
      if (!known_path(member, inner, taken_))
        continue;
      const auto rule = sweep_rule(member.key);
      if (!rule || !is_numeric(rule->kind))
        refuse({inner, member.offset}, fmt::format("\"{}\" is no number", member.key), "paths of numbers");
      else if (!expect_kind(member.value, Kind::text, "an expression in quotes, as \"2 * scene.psd.radius\"", inner,
                            mistakes()))
        misunderstood();
      else
        derivation(member, inner);
    }
  }

  void derivation(const JsonMember& member, const std::string& pointer) {
    const JsonNode& node = member.value;
    // Without escapes a byte of the text is a byte of the file.
    const bool plain = node.end - node.offset == node.text.size() + 2;
    const auto place_of = [&](std::size_t at) { return Place{pointer, plain ? node.offset + 1 + at : node.offset}; };
    std::vector<std::string> known;
    for (const std::string& path : sweep_paths()) {
      if (const auto rule = sweep_rule(path); rule && is_numeric(rule->kind))
        known.push_back(path);
    }
    for (std::string& path : known)
      std::replace(path.begin(), path.end(), '/', '.');
    try {
      Derivation out{member.key, Expression(node.text), {pointer, node.offset}};
      for (const Expression::Name& name : out.expression.names()) {
        if (std::find(known.begin(), known.end(), name.text) == known.end())
          refuse(place_of(name.at), fmt::format("\"{}\" is no number of a campaign", name.text),
                 "paths with dots, as scene.psd.radius", nearest(name.text, known));
      }
      out.group = add_group(member.key, {pointer, member.offset}, reading_.file);
      block_.derived.push_back(std::move(out));
    } catch (const ExpressionError& error) {
      refuse(place_of(error.at), error.what(), "");
    }
  }

  Reading& reading_;
  std::string pointer_;
  SweepBlock block_;
  std::set<std::string> taken_; ///< paths swept so far in this block
};

} // namespace

void read_sweep(const JsonNode& node, Reading& reading) {
  if (node.kind != Kind::list) {
    BlockReader(reading, "/sweep").read(node);
    return;
  }
  if (node.items.empty()) {
    reading.mistakes.add(
        {{"/sweep", node.offset}, "[] is an empty sweep", "a block, or a list of at least one block", ""});
    reading.file.whole = false;
  }
  for (std::size_t i = 0; i < node.items.size(); ++i)
    BlockReader(reading, json_pointer("/sweep", std::to_string(i))).read(node.items[i]);
}

} // namespace tamp
