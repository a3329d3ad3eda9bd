// One table of keys; from its rows come reading, checking and the list of what is allowed.
#include "campaigns/cluster_profile.h"

#include "campaigns/json_document.h"
#include "campaigns/mistakes.h"
#include "campaigns/nearest.h"
#include "campaigns/value.h"
#include "engine/base/error.h"
#include "engine/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace tamp {

namespace {

using Field = std::variant<std::string ClusterProfile::*, std::int64_t ClusterProfile::*, double ClusterProfile::*>;

struct Key {
  std::string_view name;
  Field field;
  double low; ///< of a number
};

constexpr double kLargest = 1e9;

const std::array kKeys = {
    Key{"partition", &ClusterProfile::partition, 0},
    Key{"account", &ClusterProfile::account, 0},
    Key{"qos", &ClusterProfile::qos, 0},
    Key{"constraint", &ClusterProfile::constraint, 0},
    Key{"max_running", &ClusterProfile::max_running, 0},
    Key{"array_size", &ClusterProfile::array_size, 1},
    Key{"bundle_jobs", &ClusterProfile::bundle_jobs, 1},
    Key{"bundle_wall_s", &ClusterProfile::bundle_wall_s, 0},
    Key{"memory_overhead_mb", &ClusterProfile::memory_overhead_mb, 0},
    Key{"settle_s", &ClusterProfile::settle_s, 0},
    Key{"patience_s", &ClusterProfile::patience_s, 0},
};

/// Sets the field of a key; nothing is returned if the value fits, else what would.
std::string set(ClusterProfile& profile, const Key& key, const JsonNode& node) {
  if (const auto* text = std::get_if<std::string ClusterProfile::*>(&key.field)) {
    if (node.kind != JsonNode::Kind::text || node.text.find_first_of("\n\r") != std::string::npos)
      return "a text of one line";
    profile.*(*text) = node.text;
    return {};
  }
  const bool whole = std::holds_alternative<std::int64_t ClusterProfile::*>(key.field);
  const bool fits = node.kind == JsonNode::Kind::number && node.number >= key.low && node.number <= kLargest &&
                    (!whole || std::floor(node.number) == node.number);
  if (!fits)
    return fmt::format("a {}number from {:g} to {:g}", whole ? "whole " : "", key.low, kLargest);
  if (whole)
    profile.*std::get<std::int64_t ClusterProfile::*>(key.field) = static_cast<std::int64_t>(node.number);
  else
    profile.*std::get<double ClusterProfile::*>(key.field) = node.number;
  return {};
}

} // namespace

ClusterProfile read_cluster_profile(std::string_view text, const std::filesystem::path& file) {
  Mistakes mistakes(file.string(), text);
  JsonDocument document;
  try {
    document = parse_json(text);
  } catch (const JsonSyntaxError& error) {
    mistakes.add({{error.pointer, error.offset}, error.what(), "", ""});
  }
  mistakes.throw_if_any();
  if (document.root.kind != JsonNode::Kind::object)
    mistakes.add({{"", document.root.offset}, "the profile is no object", "an object", ""});
  for (const DuplicateKey& key : document.duplicates)
    mistakes.add({{key.pointer, key.offset}, "the key stands twice in its object", "each key once", ""});

  std::vector<std::string> known;
  for (const Key& key : kKeys)
    known.emplace_back(key.name);
  ClusterProfile profile;
  for (const JsonMember& member : document.root.members) {
    const Place place{json_pointer("", member.key), member.value.offset};
    const auto* key = std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& k) { return k.name == member.key; });
    if (key == kKeys.end())
      mistakes.add({{place.pointer, member.offset},
                    fmt::format("unknown key \"{}\"", member.key),
                    quoted_list(known),
                    nearest(member.key, known)});
    else if (const std::string allowed = set(profile, *key, member.value); !allowed.empty())
      mistakes.add({place, mistakes.written(member.value.offset, member.value.end) + " is not allowed", allowed, ""});
  }
  mistakes.throw_if_any();
  return profile;
}

ClusterProfile load_cluster_profile(const std::filesystem::path& file) {
  std::string text;
  try {
    text = read_file(file);
  } catch (const Error& error) {
    throw InputError(error.what());
  }
  return read_cluster_profile(text, file);
}

} // namespace tamp
