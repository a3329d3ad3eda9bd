// One point of a sweep: the scene it asks for, and what is impossible about it.
#pragma once

#include "campaigns/campaign_file.h"

#include <string>
#include <vector>

namespace tamp {

/// The statements of one point of the sweep, and where they come from.
struct SweepPoint {
  std::vector<const Step*> steps; ///< one of each axis
  const SweepBlock* block = nullptr;
  bool included = false;     ///< by the block's "include": not subject to its "exclude"
  std::vector<bool> methods; ///< which entries of CampaignFile::methods are made here
};

/// What is impossible about one scene.
struct SceneProblem {
  std::string path; ///< with its root
  std::string what;
  std::string allowed;
  const Statement* culprit = nullptr; ///< the statement of `path`; null if it is not stated
  bool swept = false;                 ///< whether the culprit belongs to the sweep
};

struct SceneAtPoint {
  Scene scene; ///< completed
  std::vector<SceneProblem> problems;
};

/// The file's scene with the point's values in place of its own. Marks in `counted` the groups of statements that count
/// in this scene, or that the point replaces. Problems that wrong values told already would cause are left out.
SceneAtPoint scene_at(const CampaignFile& file, const SweepPoint& point, std::vector<bool>& counted);

/// "scene/size = 30, scene/psd/size_ratio = 5".
std::string point_words(const SweepPoint& point);

} // namespace tamp
