// The scene of a campaign file: nested objects whose paths are the rows of the scene's table.
#include "campaigns/campaign_file.h"
#include "campaigns/nearest.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace tamp {

namespace {

bool is_scene_file(std::string_view path) {
  return path == "scene/" + std::string(kFilePath);
}

/// The keys that stand at one level: "size" and "psd" at "", "law" and "file" at "psd/".
std::vector<std::string> keys_at(const std::string& level) {
  std::vector<std::string> paths = paths_of(scene_parameters());
  paths.emplace_back(kFilePath);
  std::vector<std::string> keys;
  for (const std::string& path : paths) {
    if (path.compare(0, level.size(), level) != 0)
      continue;
    std::string key = path.substr(level.size(), path.find('/', level.size()) - level.size());
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(std::move(key));
  }
  return keys;
}

void read_level(const JsonNode& node, const std::string& level, const std::string& pointer, Reading& reading) {
  const std::vector<std::string> keys = keys_at(level);
  std::vector<std::string> elsewhere;
  for (const std::string& path : paths_of(scene_parameters()))
    elsewhere.push_back("scene/" + path);
  for (const JsonMember& member : node.members) {
    const std::string path = level + member.key;
    const std::string inner = json_pointer(pointer, member.key);
    if (find_row(scene_parameters(), path) != nullptr || path == kFilePath) {
      const std::size_t group = add_group("scene/" + path, {inner, member.offset}, reading.file);
      reading.file.scene.push_back(read_statement("scene/" + path, member.value, inner, group, reading));
    } else if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) {
      reading.file.objects["scene/" + path] = member.value.offset;
      if (expect_kind(member.value, JsonNode::Kind::object, "an object", inner, reading.mistakes))
        read_level(member.value, path + "/", inner, reading);
      else
        reading.file.whole = false;
    } else {
      const std::string meant = unknown_key(member, inner, keys, elsewhere, reading.mistakes);
      reading.file.doubtful.insert(meant.rfind("scene/", 0) == 0 ? meant : "scene/" + level + meant);
    }
  }
}

} // namespace

void read_scene(const JsonNode& node, Reading& reading) {
  reading.file.objects["scene"] = node.offset;
  if (!expect_kind(node, JsonNode::Kind::object, "an object", "/scene", reading.mistakes)) {
    reading.file.whole = false;
    return;
  }
  read_level(node, "", "/scene", reading);
  if (const JsonNode* psd = node.find("psd")) {
    for (const char* twin : {"edges", "weights"}) {
      if (const JsonNode* value = psd->find(twin); value != nullptr && psd->find("file") != nullptr)
        reading.mistakes.add({{fmt::format("/scene/psd/{}", twin), value->offset},
                              fmt::format("\"{}\" and \"file\" both state the size classes", twin),
                              "one of the two",
                              ""});
    }
  }
}

Statement read_statement(const std::string& path, const JsonNode& node, const std::string& pointer, std::size_t group,
                         Reading& reading) {
  Statement statement{path, std::nullopt, nullptr, "", {pointer, node.offset}, group};
  if (!is_scene_file(path)) {
    statement.leaf = read_value(node, *sweep_rule(path), pointer, reading.mistakes);
    if (statement.leaf)
      statement.words = leaf_words(*statement.leaf);
  } else if (expect_kind(node, JsonNode::Kind::text, "the name of a CSV file", pointer, reading.mistakes)) {
    statement.words = node.text;
    try {
      const std::filesystem::path folder = std::filesystem::path(reading.mistakes.file_at(node.offset)).parent_path();
      statement.sizes = std::make_shared<MeasuredSizes>(read_measured_sizes(folder / node.text));
    } catch (const InputError& error) {
      reading.mistakes.add({statement.place, error.what(), "", ""});
    }
  }
  return statement;
}

std::size_t add_group(const std::string& path, Place place, CampaignFile& file) {
  file.groups.push_back({path, std::move(place)});
  return file.groups.size() - 1;
}

bool expect_kind(const JsonNode& node, JsonNode::Kind kind, std::string_view due, const std::string& pointer,
                 Mistakes& mistakes) {
  if (node.kind == kind)
    return true;
  mistakes.add({{pointer, node.offset},
                fmt::format("{} is not {}", mistakes.written(node.offset, node.end), due),
                std::string(due),
                ""});
  return false;
}

std::string unknown_key(const JsonMember& member, const std::string& pointer, std::span<const std::string> listed,
                        std::span<const std::string> elsewhere, Mistakes& mistakes) {
  std::string meant = nearest(member.key, listed);
  if (meant.empty())
    meant = nearest(member.key, elsewhere);
  mistakes.add({{pointer, member.offset}, fmt::format("unknown key \"{}\"", member.key), quoted_list(listed), meant});
  return meant;
}

} // namespace tamp
