// Completion and cross-checks of scenes.
#include "engine/model/scene.h"

#include "engine/model/size_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace tamp {

double metres(LengthUnit unit) {
  switch (unit) {
  case LengthUnit::nm:
    return 1e-9;
  case LengthUnit::um:
    return 1e-6;
  case LengthUnit::mm:
    return 1e-3;
  case LengthUnit::m:
    break;
  }
  return 1;
}

double full_box_count(const Scene& scene, const SizeLaw& law) {
  double box = 1;
  for (const double edge : scene.size)
    box *= edge;
  const auto d = static_cast<int>(scene.dimension);
  const double unit_ball = d == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  return kGuessedPhi * box / (unit_ball * law.moment(d));
}

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

  const SizeLaw law(scene.psd, static_cast<int>(scene.dimension));
  const double largest = law.largest();
  const double shortest = *std::min_element(scene.size.begin(), scene.size.end());
  if (2 * largest > shortest) {
    found.push_back({"size", fmt::format("has the edge {0} {2}, smaller than the largest sphere (diameter {1} {2}); "
                                         "enlarge the box or lower the largest radius",
                                         shortest, 2 * largest, name_of(scene.unit))});
  }
  const double longest = *std::max_element(scene.size.begin(), scene.size.end());
  if (!(longest <= kLongestBox * law.smallest())) {
    found.push_back(
        {"size", fmt::format("has the edge {:g}, more than {:g} times the smallest radius {:g}, where rounding of "
                             "coordinates spoils contacts; shorten the box or raise the smallest radius",
                             longest, kLongestBox, law.smallest())});
  }
  if (const double spheres = full_box_count(scene, law); !(spheres <= kMostSpheres)) {
    found.push_back({"size", fmt::format("makes room for about {:g} spheres of this law; allowed: at most {:g}",
                                         spheres, kMostSpheres)});
  }
  return found;
}

} // namespace tamp
