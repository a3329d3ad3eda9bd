// Compares jobs leaf by leaf.
#include "campaigns/cli/explain.h"

#include "engine/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace tamp::cli {

namespace {

void collect_leaves(const nlohmann::json& node, const std::string& path, Leaves& leaves) {
  if (!node.is_object()) {
    leaves.emplace(path, node.dump());
    return;
  }
  for (const auto& [key, child] : node.items())
    collect_leaves(child, path.empty() ? key : path + '/' + key, leaves);
}

/// How knowingly a user changes this leaf.
std::size_t deliberateness(std::string_view path) {
  if (path.ends_with("/revision"))
    return 0;
  if (path == "parent")
    return 2;
  return path == "seed" || path == "replicate" ? 3 : 1;
}

/// A value as it is told; lists of hundreds of class edges would bury the rest.
std::string told(const std::string& value) {
  constexpr std::size_t kLongest = 40;
  if (value.empty())
    return "not stated";
  return value.size() <= kLongest ? value : value.substr(0, kLongest - 3) + "...";
}

} // namespace

Leaves leaves_of(std::string_view canonical) {
  const nlohmann::json document = nlohmann::json::parse(canonical, nullptr, false);
  if (!document.is_object())
    throw Error(fmt::format("the canonical text of a job is damaged: {}", told(std::string(canonical))));
  Leaves leaves;
  collect_leaves(document, "", leaves);
  return leaves;
}

std::vector<Difference> differences(const Leaves& recorded, const Leaves& wanted) {
  std::vector<Difference> found;
  for (const auto& [path, value] : recorded) {
    const auto other = wanted.find(path);
    if (other == wanted.end())
      found.push_back({path, value, ""});
    else if (other->second != value)
      found.push_back({path, value, other->second});
  }
  for (const auto& [path, value] : wanted) {
    if (!recorded.contains(path))
      found.push_back({path, "", value});
  }
  std::sort(found.begin(), found.end(), [](const Difference& a, const Difference& b) { return a.path < b.path; });
  return found;
}

std::optional<std::size_t> nearest_job(std::span<const Leaves> candidates, const Leaves& wanted) {
  std::optional<std::size_t> nearest;
  std::pair<std::size_t, std::size_t> least;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    std::pair<std::size_t, std::size_t> distance;
    for (const Difference& difference : differences(candidates[c], wanted)) {
      ++distance.first;
      distance.second += deliberateness(difference.path);
    }
    if (!nearest || distance < least) {
      nearest = c;
      least = distance;
    }
  }
  return nearest;
}

std::string in_words(std::span<const Difference> differences) {
  std::string text;
  for (const Difference& d : differences)
    text +=
        fmt::format("{}{}: {} recorded, {} wanted", text.empty() ? "" : "; ", d.path, told(d.recorded), told(d.wanted));
  return text;
}

} // namespace tamp::cli
