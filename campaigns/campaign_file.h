// A campaign file as read: every statement with its place, before sweeps are multiplied out.
#pragma once

#include "campaigns/expression.h"
#include "campaigns/histogram_file.h"
#include "campaigns/mistakes.h"
#include "campaigns/rules.h"
#include "engine/model/plan.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// One value given to one parameter.
struct Statement {
  std::string path;                           ///< with its root: "scene/psd/mu_ln", "method/lid", "replicates"
  std::optional<JsonLeaf> leaf;               ///< nothing if the value is wrong, which has been told
  std::shared_ptr<const MeasuredSizes> sizes; ///< instead of the leaf for scene/psd/file
  std::string words;                          ///< the value for listings
  Place place;
  std::size_t group = 0; ///< of CampaignFile::groups

  [[nodiscard]] bool valid() const { return leaf.has_value() || sizes != nullptr; }
};

/// Statements of which at least one must count somewhere, or they are a mistake: a value of the scene, or the whole
/// list of a swept path.
struct StatementGroup {
  std::string path;
  Place place;
};

/// Values that hold together at one point of an axis, and the axis as the list of its points.
struct Step {
  Place place;
  std::vector<Statement> statements;
};
using Axis = std::vector<Step>;

/// A value that follows from others at each point.
struct Derivation {
  std::string path;
  Expression expression;
  Place place;
  std::size_t group = 0;
};

/// What must hold at a point for a method: each path has one of its values, and the method is one of those named.
struct Condition {
  Place place;
  std::map<std::string, std::vector<JsonLeaf>> values;
  std::vector<std::string> methods; ///< labels or names; none: any method
};

/// Axes that multiply, the first varying slowest; then what is left out, added and derived.
struct SweepBlock {
  Place place;
  std::vector<Axis> axes;
  std::optional<Condition> when;
  std::vector<Condition> exclude;
  Axis include; ///< further points
  std::vector<Derivation> derived;
};

struct MethodEntry {
  Method method;
  std::string label;
  std::optional<std::size_t> from; ///< the entry whose packings it starts from, always one further up
};

struct CampaignFile {
  std::string campaign;
  std::string title;
  RunSettings run;
  ReportSettings report;
  std::optional<std::vector<Metric>> metrics; ///< none stated: those that apply to every scene
  std::vector<MethodEntry> methods;
  Repeats repeats;
  std::vector<Statement> scene;
  std::vector<SweepBlock> sweep; ///< blocks are joined; none: the scene alone
  std::vector<StatementGroup> groups;
  std::map<std::string, std::size_t> objects; ///< byte offset of "scene" and "scene/psd", where missing values belong
  std::set<std::string> doubtful;             ///< scene paths that misspelt keys probably mean
  bool whole = true; ///< false if scene, methods or sweep were not understood, so that expansion would only find echoes
};

/// What the readers of the parts of a file share.
struct Reading {
  CampaignFile& file;
  Mistakes& mistakes;
};

/// The readers of the parts; each tells its mistakes and goes on.
void read_scene(const JsonNode& node, Reading& reading);
void read_methods(const JsonNode& node, Reading& reading);
void read_metrics(const JsonNode& node, Reading& reading);
void read_sweep(const JsonNode& node, Reading& reading);

/// Reads a whole document; what it lacks takes its default.
CampaignFile read_campaign_file(const JsonDocument& document, Mistakes& mistakes);

/// One value for `path`, which must be sweepable.
Statement read_statement(const std::string& path, const JsonNode& node, const std::string& pointer, std::size_t group,
                         Reading& reading);

/// Adds a group and returns its number.
std::size_t add_group(const std::string& path, Place place, CampaignFile& file);

/// Whether the node is of the kind due ("an object", …); if not, a mistake.
bool expect_kind(const JsonNode& node, JsonNode::Kind kind, std::string_view due, const std::string& pointer,
                 Mistakes& mistakes);

/// Tells of an unknown key; returns the nearest known word, which may be empty. `listed` are the keys that could stand
/// there, `elsewhere` known paths of other places.
std::string unknown_key(const JsonMember& member, const std::string& pointer, std::span<const std::string> listed,
                        std::span<const std::string> elsewhere, Mistakes& mistakes);

} // namespace tamp
