// The top level of a campaign file.
#include "campaigns/campaign_file.h"
#include "campaigns/nearest.h"
#include "engine/model/report_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

namespace {

using Kind = JsonNode::Kind;

bool is_name(std::string_view text) {
  constexpr std::size_t longest = 100;
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !text.empty() && text.size() <= longest && text.front() != '.' && text.front() != '-' &&
         std::all_of(text.begin(), text.end(), plain);
}

class TopReader {
public:
  TopReader(const JsonNode& root, Reading& reading) : root_(root), reading_(reading) {}

  void read() {
    if (!expect_kind(root_, Kind::object, "an object", "", mistakes())) {
      reading_.file.whole = false;
      return;
    }
    keys();
    names();
    settings();
    with("scene", [&](const JsonNode& node) { read_scene(node, reading_); });
    with("methods", [&](const JsonNode& node) { read_methods(node, reading_); });
    with("sweep", [&](const JsonNode& node) { read_sweep(node, reading_); });
    with("metrics", [&](const JsonNode& node) { read_metrics(node, reading_); });
  }

private:
  Mistakes& mistakes() { return reading_.mistakes; }

  template <class Use>
  void with(std::string_view key, const Use& use) {
    if (const JsonNode* node = root_.find(key))
      use(*node);
  }

  void keys() {
    std::vector<std::string> known;
    for (const TopKey& key : top_keys()) {
      known.emplace_back(key.name);
      if (key.required && root_.find(key.name) == nullptr) {
        mistakes().add({{json_pointer("", key.name), root_.offset},
                        fmt::format("\"{}\" is missing", key.name),
                        std::string(key.doc),
                        ""});
        reading_.file.whole = reading_.file.whole && key.name == "campaign";
      }
    }
    std::vector<std::string> elsewhere;
    for (const std::string& path : sweep_paths())
      elsewhere.push_back(path);
    for (const auto& row : run_parameters())
      elsewhere.push_back("budget/" + std::string(row.path));
    for (const JsonMember& member : root_.members) {
      if (std::find(known.begin(), known.end(), member.key) != known.end())
        continue;
      unknown_key(member, json_pointer("", member.key), known, elsewhere, mistakes());
      reading_.file.whole = false; // it may mean the scene or the sweep
    }
  }

  void names() {
    CampaignFile& file = reading_.file;
    with("campaign", [&](const JsonNode& node) {
      if (!expect_kind(node, Kind::text, "a text", "/campaign", mistakes()))
        return;
      file.campaign = node.text;
      if (!is_name(node.text))
        mistakes().add({{"/campaign", node.offset},
                        mistakes().written(node.offset, node.end) + " is no name",
                        "1 to 100 letters, digits, '-', '_' and '.', beginning with a letter, digit or '_'",
                        ""});
    });
    file.title = file.campaign;
    with("title", [&](const JsonNode& node) {
      if (expect_kind(node, Kind::text, "a text", "/title", mistakes()))
        file.title = node.text;
    });
    with("$schema", [&](const JsonNode& node) { expect_kind(node, Kind::text, "a text", "/$schema", mistakes()); });
  }

  template <class Root>
  void set(const Parameter<Root>& row, Root& root, const JsonNode& node, const std::string& pointer) {
    if (const auto leaf = read_value(node, ValueRule(row), pointer, mistakes()))
      row.set(root, *leaf);
  }

  void settings() {
    for (const auto& row : repeat_parameters())
      with(row.path, [&](const JsonNode& node) { set(row, reading_.file.repeats, node, json_pointer("", row.path)); });
    with("timing",
         [&](const JsonNode& node) { set(*find_row(run_parameters(), "timing"), reading_.file.run, node, "/timing"); });
    with("budget", [&](const JsonNode& node) { budget(node); });
    with("report", [&](const JsonNode& node) { report(node); });
  }

  void budget(const JsonNode& node) {
    if (!expect_kind(node, Kind::object, "an object", "/budget", mistakes()))
      return;
    std::vector<std::string> known = paths_of(run_parameters());
    std::erase(known, "timing");
    for (const JsonMember& member : node.members) {
      const std::string pointer = json_pointer("/budget", member.key);
      if (std::find(known.begin(), known.end(), member.key) != known.end())
        set(*find_row(run_parameters(), member.key), reading_.file.run, member.value, pointer);
      else
        unknown_key(member, pointer, known, {}, mistakes());
    }
  }

  void report(const JsonNode& node) {
    std::vector<std::string> known = paths_of(report_parameters());
    known.emplace_back("tables");
    if (!expect_kind(node, Kind::object, "an object", "/report", mistakes()))
      return;
    for (const JsonMember& member : node.members) {
      if (const auto* row = find_row(report_parameters(), member.key))
        set(*row, reading_.file.report, member.value, json_pointer("/report", member.key));
      else if (member.key != "tables")
        unknown_key(member, json_pointer("/report", member.key), known, {}, mistakes());
      else if (expect_kind(member.value, Kind::list, "a list of table names", "/report/tables", mistakes()))
        tables(member.value);
    }
  }

  void tables(const JsonNode& node) {
    std::vector<std::string> known;
    for (const ReportTableInfo& table : kReportTables)
      known.emplace_back(table.name);
    std::vector<std::string>& tables = reading_.file.report.tables;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const JsonNode& item = node.items[i];
      const Place place{json_pointer("/report/tables", std::to_string(i)), item.offset};
      if (!expect_kind(item, Kind::text, "the name of a table", place.pointer, mistakes()))
        continue;
      if (std::find(known.begin(), known.end(), item.text) == known.end())
        mistakes().add({place, mistakes().written(item.offset, item.end) + " is no table", quoted_list(known),
                        nearest(item.text, known)});
      else if (std::find(tables.begin(), tables.end(), item.text) != tables.end())
        mistakes().add({place, "the table stands twice", "each table once", ""});
      else
        tables.push_back(item.text);
    }
  }

  const JsonNode& root_;
  Reading& reading_;
};

} // namespace

CampaignFile read_campaign_file(const JsonDocument& document, Mistakes& mistakes) {
  CampaignFile file;
  for (const DuplicateKey& key : document.duplicates)
    mistakes.add({{key.pointer, key.offset}, "the key stands twice in its object", "each key once", ""});
  Reading reading{file, mistakes};
  TopReader(document.root, reading).read();
  return file;
}

} // namespace tamp
