// Builds the scene of one sweep point and explains its problems in the file's terms.
#include "campaigns/point.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

namespace {

const std::string kFile = "scene/" + std::string(kFilePath);

struct Held {
  const Statement* statement;
  bool swept;
};

class SceneBuilder {
public:
  SceneBuilder(const CampaignFile& file, std::vector<bool>& counted) : file_(file), counted_(counted) {}

  SceneAtPoint build(const SweepPoint& point) {
    for (const Statement& statement : file_.scene)
      hold(statement, false);
    for (const Step* step : point.steps) {
      for (const Statement& statement : step->statements) {
        if (statement.path.rfind("scene/", 0) == 0)
          hold(statement, true);
      }
    }
    Scene scene;
    for (const auto& row : scene_parameters())
      set(row, scene);
    take_file(scene);
    check(scene);
    return std::move(out_);
  }

private:
  void hold(const Statement& statement, bool swept) {
    if (statement.path == kFile) {
      drop("scene/psd/edges");
      drop("scene/psd/weights");
    } else if (statement.path == "scene/psd/edges" || statement.path == "scene/psd/weights") {
      drop(kFile);
    }
    drop(statement.path);
    held_[statement.path] = {&statement, swept};
  }

  /// Forgets a value that a later one replaces. A value of the base scene has then done its part.
  void drop(const std::string& path) {
    const auto found = held_.find(path);
    if (found == held_.end())
      return;
    if (!found->second.swept)
      counted_[found->second.statement->group] = true;
    held_.erase(found);
  }

  [[nodiscard]] const Statement* held(const std::string& path) const {
    const auto found = held_.find(path);
    return found == held_.end() ? nullptr : found->second.statement;
  }

  /// Whether a value was meant but is not to be had, which has been told.
  [[nodiscard]] bool doubtful(const std::string& path) const {
    const Statement* statement = held(path);
    return statement != nullptr ? !statement->valid() : file_.doubtful.contains(path);
  }

  void set(const Parameter<Scene>& row, Scene& scene) {
    const std::string path = "scene/" + std::string(row.path);
    const Statement* statement = held(path);
    if (statement == nullptr)
      return;
    // Under an unknown law every parameter of a law may count.
    const bool law_unknown = doubtful("scene/psd/law") && row.path.substr(0, 4) == "psd/";
    if (!row.applies(scene) && !law_unknown)
      return;
    counted_[statement->group] = true;
    if (statement->leaf && row.applies(scene))
      row.set(scene, *statement->leaf);
  }

  void take_file(Scene& scene) {
    const Statement* statement = held(kFile);
    if (statement == nullptr)
      return;
    if (scene.psd.law != Law::histogram && !doubtful("scene/psd/law"))
      return;
    counted_[statement->group] = true;
    if (statement->sizes == nullptr || scene.psd.law != Law::histogram)
      return;
    const MeasuredSizes& sizes = *statement->sizes;
    scene.psd.edges = sizes.edges_in(scene.unit);
    scene.psd.weights = sizes.weights;
    if (!sizes.weighting)
      return;
    const Statement* stated = held("scene/psd/weighting");
    if (stated != nullptr && stated->valid() && scene.psd.weighting != *sizes.weighting)
      add("psd/weighting",
          fmt::format("\"{}\" contradicts the header of {}, which counts by {}", stated->words, statement->words,
                      name_of(*sizes.weighting)),
          fmt::format("\"{}\", or no \"weighting\" at all", name_of(*sizes.weighting)));
    scene.psd.weighting = *sizes.weighting;
  }

  void add(const std::string& path, std::string what, std::string allowed) {
    SceneProblem problem{"scene/" + path, std::move(what), std::move(allowed), nullptr, false};
    auto found = held_.find(problem.path);
    if (found == held_.end() && (path == "psd/edges" || path == "psd/weights" || path == "psd/weighting"))
      found = held_.find(kFile);
    if (found != held_.end()) {
      problem.culprit = found->second.statement;
      problem.swept = found->second.swept;
    }
    out_.problems.push_back(std::move(problem));
  }

  /// Whether a problem at this path would only echo a value that has been told wrong.
  [[nodiscard]] bool echo(const std::string& path) const {
    const auto any = [&](std::initializer_list<const char*> names) {
      return std::any_of(names.begin(), names.end(), [&](const char* name) { return doubtful(name); });
    };
    if (doubtful("scene/" + path))
      return true;
    if (path == "size")
      return doubtful("scene/dimension");
    if (path == "psd/edges" || path == "psd/weights")
      return any({"scene/psd/law", "scene/psd/file", "scene/psd/edges", "scene/psd/weights"});
    if (path == "psd/mu_ln" || path == "psd/sigma_ln" || path == "psd/mean" || path == "psd/sd")
      return any({"scene/psd/law", "scene/psd/mu_ln", "scene/psd/sigma_ln", "scene/psd/mean", "scene/psd/sd"});
    return path.rfind("psd", 0) == 0 && doubtful("scene/psd/law");
  }

  /// Which values of the powder meet, for a problem that lies in their combination.
  [[nodiscard]] std::string powder_words() const {
    std::string words;
    for (const auto& [path, entry] : held_) {
      if (path.rfind("scene/psd/", 0) == 0 && entry.statement->valid())
        words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", path.substr(10), entry.statement->words);
    }
    return words;
  }

  /// Puts a problem as the model words it into what the user wrote and what is allowed.
  void tell(const std::string& path, const std::string& message) {
    if (echo(path))
      return;
    const auto* row = find_row(scene_parameters(), path);
    const std::string name = path.substr(path.rfind('/') + 1);
    const Statement* statement = held("scene/" + path);
    if (statement == nullptr && path.rfind("psd/", 0) == 0)
      statement = held(kFile);
    if (row != nullptr && statement == nullptr && is_unstated(row->get(Scene{}))) {
      const bool missing = message.rfind("is missing", 0) == 0;
      add(path, fmt::format("\"{}\" {}", name, missing ? message : "is missing"), ValueRule(*row).allowed());
    } else if (message.rfind("must ", 0) == 0 && statement != nullptr) {
      add(path, fmt::format("\"{}\" {}; stated: {}", name, message, powder_words()),
          message.substr(message.rfind("must be ", 0) == 0 ? 8 : 5));
    } else if (path == "size") {
      const std::size_t advice = std::min(message.find("; "), message.size());
      const std::string rest = message.substr(std::min(advice + 2, message.size()));
      constexpr std::string_view allowed = "allowed: ";
      add(path, "\"size\" " + message.substr(0, advice), rest.substr(rest.rfind(allowed, 0) == 0 ? allowed.size() : 0));
    } else if (path == "psd") {
      add(path, message,
          fmt::format("parameters and moments that agree within {} %, or only one of the two pairs",
                      100 * kMomentTolerance));
    } else {
      add(path, fmt::format("\"{}\" {}; stated: {}", name, message, powder_words()), "");
    }
  }

  void check(Scene& scene) {
    if (const auto text = contradiction(scene.psd)) {
      tell("psd", *text);
      scene.psd.mean = scene.psd.sd = unstated;
    }
    scene = completed(scene);
    for (const Problem& problem : problems(scene))
      tell(problem.path, problem.message);
    out_.scene = std::move(scene);
  }

  const CampaignFile& file_;
  std::vector<bool>& counted_;
  std::map<std::string, Held> held_;
  SceneAtPoint out_;
};

} // namespace

SceneAtPoint scene_at(const CampaignFile& file, const SweepPoint& point, std::vector<bool>& counted) {
  return SceneBuilder(file, counted).build(point);
}

std::string point_words(const SweepPoint& point) {
  std::string words;
  for (const Step* step : point.steps) {
    for (const Statement& statement : step->statements)
      words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", statement.path, statement.words);
  }
  return words;
}

} // namespace tamp
