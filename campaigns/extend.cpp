// Merge patches of campaign files.
#include "campaigns/extend.h"

#include "engine/base/error.h"
#include "engine/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace tamp {

namespace {

namespace fs = std::filesystem;
using Kind = JsonNode::Kind;

/// What belongs to one file alone.
constexpr std::array<std::string_view, 4> kOwn = {"$schema", "campaign", "title", "extends"};

/// Moves the places of a tree behind those of other files.
void shift(JsonNode& node, std::size_t by) {
  node.offset += by;
  node.end += by;
  for (JsonNode& item : node.items)
    shift(item, by);
  for (JsonMember& member : node.members) {
    member.offset += by;
    shift(member.value, by);
  }
}

/// `base` with the patch laid over it (RFC 7396, section 2); its depth is that of parsed text, which is bounded.
void lay_over(JsonNode& base, const JsonNode& patch) {
  if (patch.kind != Kind::object) {
    base = patch;
    return;
  }
  if (base.kind != Kind::object) {
    base = JsonNode{};
    base.kind = Kind::object;
  }
  base.offset = patch.offset;
  base.end = patch.end;
  for (const JsonMember& member : patch.members) {
    const auto found = std::find_if(base.members.begin(), base.members.end(),
                                    [&](const JsonMember& other) { return other.key == member.key; });
    if (member.value.kind == Kind::null) {
      if (found != base.members.end())
        base.members.erase(found);
    } else if (found != base.members.end()) {
      found->offset = member.offset;
      lay_over(found->value, member.value);
    } else {
      base.members.push_back({member.key, member.offset, {}});
      lay_over(base.members.back().value, member.value);
    }
  }
}

class Chain {
public:
  Chain(std::deque<std::string>& texts, Mistakes& mistakes) : texts_(texts), mistakes_(mistakes) {}

  JsonDocument read(std::string_view text, const fs::path& file, std::size_t begin) {
    visited_.insert(fs::weakly_canonical(file));
    JsonDocument document = parsed(text, begin);
    const JsonNode* named = document.root.find("extends");
    if (named == nullptr)
      return document;
    const Place place{"/extends", named->offset};
    if (named->kind != Kind::text)
      refuse(place, mistakes_.written(named->offset, named->end) + " is not the name of a file");
    const fs::path next = file.parent_path() / named->text;
    std::error_code ignored;
    if (!fs::is_regular_file(next, ignored))
      refuse(place, fmt::format("there is no file {}", next.string()));
    if (visited_.contains(fs::weakly_canonical(next)))
      refuse(place, fmt::format("{} extends itself, through others or not", next.string()));
    texts_.push_back(contents(next, place));
    const std::size_t behind = mistakes_.add_source(next.string(), texts_.back());
    JsonDocument base = read(texts_.back(), next, behind);
    std::erase_if(base.root.members, [](const JsonMember& member) {
      return std::find(kOwn.begin(), kOwn.end(), member.key) != kOwn.end();
    });
    lay_over(base.root, document.root);
    base.duplicates.insert(base.duplicates.end(), document.duplicates.begin(), document.duplicates.end());
    return base;
  }

private:
  [[noreturn]] void refuse(Place place, std::string what) {
    mistakes_.add({std::move(place), std::move(what), "a campaign file, relative to this one", ""});
    mistakes_.throw_if_any();
    throw Error("a mistake was not told"); // not reached
  }

  JsonDocument parsed(std::string_view text, std::size_t begin) {
    JsonDocument document;
    try {
      document = parse_json(text);
    } catch (const JsonSyntaxError& error) {
      mistakes_.add({{error.pointer, begin + error.offset}, error.what(), "", ""});
    }
    mistakes_.throw_if_any();
    shift(document.root, begin);
    for (DuplicateKey& key : document.duplicates) {
      key.offset += begin;
      key.first_offset += begin;
    }
    return document;
  }

  std::string contents(const fs::path& file, const Place& place) {
    try {
      return read_file(file);
    } catch (const Error& error) {
      refuse(place, error.what());
    }
  }

  std::deque<std::string>& texts_;
  Mistakes& mistakes_;
  std::set<fs::path> visited_;
};

} // namespace

JsonDocument read_extended(std::string_view text, const fs::path& file, std::deque<std::string>& texts,
                           Mistakes& mistakes) {
  return Chain(texts, mistakes).read(text, file, 0);
}

} // namespace tamp
