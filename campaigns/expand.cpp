// Joins the points of a sweep, methods and replicates into jobs.
#include "campaigns/expand.h"

#include "campaigns/json_document.h"
#include "campaigns/sweep_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace tamp {

namespace {

class Expander {
public:
  Expander(const CampaignFile& file, Mistakes& mistakes)
      : file_(file), mistakes_(mistakes), counted_(file.groups.size(), false) {}

  std::vector<PlannedJob> expand() {
    if (!file_.whole)
      return {};
    const auto sweep = sweep_points(file_, kMostJobs, mistakes_);
    if (!sweep) {
      too_many("points");
      return {};
    }
    const std::vector<SweepPoint>& points = sweep->points;
    std::vector<Scene> scenes;
    std::vector<std::vector<SceneProblem>> problems;
    for (const SweepPoint& point : points) {
      auto at = scene_at(file_, point, counted_);
      scenes.push_back(std::move(at.scene));
      problems.push_back(std::move(at.problems));
      count_methods(point);
    }
    tell_problems(points, problems);
    tell_uncounted();
    if (mistakes_.count() > 0)
      return {};
    if (count_jobs(points) > kMostJobs) {
      too_many("jobs");
      return {};
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      add_jobs(points[i], scenes[i]);
    return std::move(jobs_);
  }

private:
  void too_many(std::string_view what) {
    const std::size_t offset = file_.sweep.empty() ? 0 : file_.sweep.front().place.offset;
    mistakes_.add({{file_.sweep.empty() ? "/replicates" : "/sweep", offset},
                   fmt::format("the campaign expands into more than {} {}", kMostJobs, what),
                   fmt::format("at most {}", kMostJobs),
                   ""});
  }

  /// Marks the swept values that count for some method, or for the point as a whole.
  void count_methods(const SweepPoint& point) {
    for (const Step* step : point.steps) {
      for (const Statement& statement : step->statements) {
        bool counts = find_row(repeat_parameters(), statement.path) != nullptr;
        for (std::size_t m = 0; m < file_.methods.size(); ++m)
          counts = counts || (point.methods[m] && method_row(statement.path, file_.methods[m].method) != nullptr);
        if (counts)
          counted_[statement.group] = true;
      }
    }
  }

  /// Where to point for a problem whose own value the sweep does not state: at the step that varies the scene, or at
  /// the whole block if several do.
  static Place sweep_place(const SweepPoint& point) {
    std::vector<const Step*> of_scene;
    for (const Step* step : point.steps) {
      const auto& list = step->statements;
      if (std::any_of(list.begin(), list.end(), [](const auto& s) { return s.path.rfind("scene/", 0) == 0; }))
        of_scene.push_back(step);
    }
    return of_scene.size() == 1 ? of_scene.front()->place : point.block->place;
  }

  /// Where the base scene states a value, or would.
  [[nodiscard]] Place base_place(const SceneProblem& problem) const {
    if (problem.culprit != nullptr)
      return problem.culprit->place;
    Place place;
    for (const auto& [object, offset] : file_.objects) { // "scene" before "scene/psd": the deeper one wins
      if (problem.path.rfind(object, 0) == 0)
        place.offset = offset;
    }
    place.pointer = "/" + problem.path;
    return place;
  }

  /// A problem of every point belongs to the base scene; others to the sweep, told once for each place.
  void tell_problems(const std::vector<SweepPoint>& points, const std::vector<std::vector<SceneProblem>>& problems) {
    std::map<std::string, std::size_t> frequency;
    for (const auto& list : problems) {
      std::set<std::string> paths;
      for (const SceneProblem& problem : list)
        paths.insert(problem.path);
      for (const std::string& path : paths)
        ++frequency[path];
    }
    std::set<std::string> told;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const SceneProblem& problem : problems[i]) {
        const bool base = !problem.swept && frequency[problem.path] == points.size();
        const Place place = base || problem.swept ? base_place(problem) : sweep_place(points[i]);
        // In the base scene two problems of one value at one point both count; elsewhere one for each place suffices.
        const bool again = !told.insert(place.pointer + ' ' + problem.path + (base ? problem.what : "")).second;
        if (again || (base && i > 0))
          continue;
        std::string what = problem.what;
        if (!base)
          what = fmt::format("{} (at the point {})", what, point_words(points[i]));
        mistakes_.add({place, what, problem.allowed, ""});
      }
    }
  }

  void tell_uncounted() {
    std::set<std::string> names;
    for (const MethodEntry& entry : file_.methods)
      names.insert(std::string(name_of(entry.method.name)));
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      if (counted_[i])
        continue;
      const auto& [path, place] = file_.groups[i];
      const auto rule = sweep_rule(path);
      const std::string_view when = rule ? rule->when : std::string_view("psd/law = histogram");
      const bool of_method = path.rfind("method/", 0) == 0;
      mistakes_.add({place,
                     of_method ? fmt::format("\"{}\" fits none of the methods ({})", path, fmt::join(names, ", "))
                               : fmt::format("\"{}\" counts nowhere here", path.substr(path.rfind('/') + 1)),
                     fmt::format("only where {}", when), ""});
    }
  }

  [[nodiscard]] Repeats repeats_at(const SweepPoint& point) const {
    Repeats repeats = file_.repeats;
    for (const auto& row : repeat_parameters()) {
      if (const Statement* statement = find_statement(point, row.path))
        row.set(repeats, *statement->leaf);
    }
    return repeats;
  }

  /// Number of jobs before equal ones are joined.
  [[nodiscard]] std::size_t count_jobs(const std::vector<SweepPoint>& points) const {
    std::size_t sum = 0; // at most kMostJobs points of at most 10^5 replicates each
    for (const SweepPoint& point : points)
      sum += static_cast<std::size_t>(repeats_at(point).replicates) * file_.methods.size();
    return sum;
  }

  void add_jobs(const SweepPoint& point, const Scene& scene) {
    const Repeats repeats = repeats_at(point);
    std::map<std::string, std::string> of_point;
    for (const Step* step : point.steps) {
      for (const Statement& statement : step->statements) {
        if (statement.path.rfind("method/", 0) != 0 && statement.path != "replicates")
          of_point[statement.path] = statement.words;
      }
    }
    std::vector<std::vector<std::string>> keys; // of each entry and replicate
    for (std::size_t m = 0; m < file_.methods.size(); ++m) {
      keys.emplace_back();
      if (!point.methods[m])
        continue;
      const MethodEntry& entry = file_.methods[m];
      PlannedJob planned;
      planned.job = {scene, entry.method, repeats.seed, 0, ""};
      planned.label = entry.label;
      planned.point = of_point;
      for (const Step* step : point.steps) {
        for (const Statement& statement : step->statements) {
          if (const auto* row = method_row(statement.path, entry.method)) {
            row->set(planned.job.method, *statement.leaf);
            planned.point[statement.path] = statement.words;
          }
        }
      }
      for (std::int64_t i = 0; i < repeats.replicates; ++i) {
        planned.job.replicate = i;
        if (entry.from)
          planned.job.parent = keys[*entry.from][static_cast<std::size_t>(i)];
        planned.key = job_key(planned.job);
        keys.back().push_back(planned.key);
        if (keys_.insert(planned.key).second)
          jobs_.push_back(planned);
      }
    }
  }

  const CampaignFile& file_;
  Mistakes& mistakes_;
  std::vector<bool> counted_; ///< of each group
  std::vector<PlannedJob> jobs_;
  std::unordered_set<std::string> keys_; ///< asked only whether it holds a key; its order decides nothing
};

} // namespace

std::vector<PlannedJob> expand(const CampaignFile& file, Mistakes& mistakes) {
  return Expander(file, mistakes).expand();
}

} // namespace tamp
