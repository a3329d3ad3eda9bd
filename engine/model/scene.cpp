// Completion and cross-checks of scenes.
#include "engine/model/scene.h"

#include "engine/model/size_law.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

Scene completed(Scene scene) {
  if (scene.size.size() == 1)
    scene.size.assign(static_cast<std::size_t>(scene.dimension), scene.size.front());
  scene.psd = completed(scene.psd);
  return scene;
}

std::vector<Problem> problems(const Scene& scene) {
  std::vector<Problem> found;
  if (scene.size.size() != static_cast<std::size_t>(scene.dimension)) {
    found.push_back({"size", fmt::format("has {} numbers; allowed: 1 (equal edges) or {} (the dimension)",
                                         scene.size.size(), scene.dimension)});
  }
  for (const double edge : scene.size) {
    if (!(edge > 0))
      found.push_back({"size", fmt::format("has the edge {}; allowed: lengths above 0", edge)});
  }
  if (const auto text = contradiction(scene.psd))
    found.push_back({"psd", *text});
  for (const auto& [field, message] : check(scene.psd))
    found.push_back({"psd/" + field, message});
  if (!found.empty())
    return found;

  const double largest = SizeLaw(scene.psd, static_cast<int>(scene.dimension)).largest();
  const double shortest = *std::min_element(scene.size.begin(), scene.size.end());
  if (2 * largest > shortest) {
    found.push_back({"size", fmt::format("has the edge {0} {2}, smaller than the largest sphere (diameter {1} {2}); "
                                         "enlarge the box or lower the largest radius",
                                         shortest, 2 * largest, name_of(scene.unit))});
  }
  return found;
}

} // namespace tamp
