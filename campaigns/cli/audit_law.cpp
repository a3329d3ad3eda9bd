// Reads stated laws, and asks about units that cannot be meant.
#include "campaigns/cli/audit_law.h"

#include "campaigns/campaign.h"
#include "engine/base/error.h"
#include "engine/base/line_reader.h"
#include "engine/model/parameter.h"
#include "engine/model/size_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp::cli {

namespace {

/// Powers of ten of metres.
constexpr std::array kPower = {-9, -6, -3, 0};
int power_of(LengthUnit unit) {
  return kPower[static_cast<std::size_t>(unit)];
}

/// Sets one parameter of the table; throws InputError for an unknown name or an impossible value.
void set_parameter(Scene& scene, const std::string& name, const std::string& value) {
  std::string allowed;
  for (const Parameter<Scene>& row : scene_parameters()) {
    if (!row.path.starts_with("psd/") || !row.applies(scene))
      continue;
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", row.path.substr(4));
    if (row.path.substr(4) != name)
      continue;
    double number = 0;
    if (row.kind == ParameterKind::choice) {
      if (std::find(row.choices.begin(), row.choices.end(), value) == row.choices.end())
        throw InputError(fmt::format("--law: {} = {}; allowed: {}", name, value, fmt::join(row.choices, ", ")));
      row.set(scene, value);
    } else if (row.kind == ParameterKind::number && parse_number(value, number) && row.range.holds(number)) {
      row.set(scene, number);
    } else {
      throw InputError(fmt::format("--law: {} = {}; allowed: {}", name, value, row.range.words()));
    }
    return;
  }
  throw InputError(fmt::format("--law: unknown parameter \"{}\"; allowed: {}, unit", name, allowed));
}

void scale(ReadPacking& read, double factor) {
  for (double& x : read.packing.positions)
    x *= factor;
  for (double& r : read.packing.radii)
    r *= factor;
  for (double& edge : read.packing.size)
    edge *= factor;
  for (double& corner : read.origin)
    corner *= factor;
}

double median(std::vector<double> radii) {
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

} // namespace

StatedLaw law_of_words(const std::string& words) {
  StatedLaw law;
  law.words = words;
  Scene scene;
  for (std::size_t first = 0; first <= words.size();) {
    const std::size_t last = std::min(words.find(',', first), words.size());
    const std::string_view part = trimmed(std::string_view(words).substr(first, last - first));
    const std::size_t equal = part.find('=');
    const std::string name(equal == part.npos ? "law" : trimmed(part.substr(0, equal)));
    const std::string value(equal == part.npos ? part : trimmed(part.substr(equal + 1)));
    if (name == "unit") {
      law.unit = enum_of<LengthUnit>(value);
      if (!law.unit)
        throw InputError(fmt::format("--law: unit = {}; allowed: nm, um, mm, m", value));
    } else {
      set_parameter(scene, name, value);
    }
    first = last + 1;
  }
  law.psd = scene.psd;
  if (const auto message = contradiction(law.psd))
    throw InputError("--law: " + *message);
  law.psd = completed(law.psd);
  if (const auto wrong = check(law.psd); !wrong.empty())
    throw InputError(fmt::format("--law: {}: {}", wrong.front().field, wrong.front().problem));
  return law;
}

StatedLaw law_of_campaign(const std::string& file) {
  const Plan plan = load_campaign(file);
  if (plan.jobs.empty())
    throw InputError(fmt::format("{} has no job, so no powder", file));
  const Scene& scene = plan.jobs.front().job.scene;
  return {scene.psd, scene.unit, fmt::format("{} of {}", name_of(scene.psd.law), file)};
}

void bring_to_unit(ReadPacking& read, const StatedLaw& law, const std::string& file, bool as_it_is) {
  Packing& packing = read.packing;
  const LengthUnit unit = law.unit.value_or(packing.unit);
  if (read.said.unit && packing.unit != unit)
    scale(read, std::pow(10, power_of(packing.unit) - power_of(unit)));
  const LengthUnit told = read.said.unit.value_or(unit);
  packing.unit = unit;
  if (as_it_is)
    return;
  const double found = median(packing.radii);
  const double expected = SizeLaw(law.psd, packing.dimension).quantile(0.5);
  const auto thousands = static_cast<int>(std::lround(std::log10(found / expected) / 3));
  if (thousands == 0 || std::abs(std::log10(found / expected) - 3 * thousands) > 0.5)
    return;
  std::string help = "or --as-it-is if the sizes are meant";
  for (std::size_t i = 0; i < kPower.size(); ++i) {
    if (kPower[i] == power_of(told) - 3 * thousands)
      help = fmt::format("say --unit {} if so, {}", EnumNames<LengthUnit>::value[i], help);
  }
  throw InputError(fmt::format("{}: the median radius is {:.4g} {}, about 1e{} times the law's {:.4g}: is the file in "
                               "another unit? {}",
                               file, found, name_of(unit), 3 * thousands, expected, help));
}

} // namespace tamp::cli
