// Chooses and writes the packings of a page.
#include "report/page_packings.h"

#include "engine/base/canonical_json.h"
#include "engine/base/error.h"
#include "report/base64.h"
#include "report/cells.h"
#include "report/html.h"
#include "report/page_assets.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

namespace {

/// The runs that ended ok in the order in which the budget is spent: the first of each group, the second of each, …
std::vector<const Run*> runs_to_show(const std::vector<RunGroup>& groups, std::vector<std::string>& titles) {
  std::vector<const Run*> order;
  std::size_t longest = 0;
  for (const RunGroup& group : groups)
    longest = std::max(longest, group.runs.size());
  for (std::size_t i = 0; i < longest; ++i) {
    for (const RunGroup& group : groups) {
      if (i >= group.runs.size() || !group.runs[i].ok())
        continue;
      order.push_back(&group.runs[i]);
      titles.push_back(fmt::format("{}, {}D, replicate {}", group.heading, group.job().scene.dimension,
                                   group.runs[i].planned.job.replicate));
    }
  }
  return order;
}

/// Below which gap two spheres touch: as the run's own metrics say.
double contact_gap_of(const Run& run) {
  for (const MetricRun& metric : run.metrics) {
    if (metric.metric.name == MetricName::coordination || metric.metric.name == MetricName::stable_alone)
      return metric.metric.contact_gap;
  }
  return Metric{}.contact_gap;
}

std::string numbers_attribute(const std::array<double, 3>& values, int dimension) {
  std::string out;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    out += (axis == 0 ? "" : " ") + canonical_number(values[axis]);
  return out;
}

std::string boundary_attribute(const Packing& packing) {
  std::string out;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(packing.dimension); ++axis)
    out += (axis == 0 ? "" : " ") + std::string(name_of(packing.boundary[axis]));
  return out;
}

/// Centres, sphere by sphere, and then radii.
std::vector<double> numbers_of(const Packing& packing, std::span<const std::size_t> spheres) {
  const auto dimension = static_cast<std::size_t>(packing.dimension);
  std::vector<double> numbers;
  numbers.reserve(spheres.size() * (dimension + 1));
  for (const std::size_t i : spheres) {
    for (std::size_t axis = 0; axis < dimension; ++axis)
      numbers.push_back(packing.positions[i * dimension + axis]);
  }
  for (const std::size_t i : spheres)
    numbers.push_back(packing.radii[i]);
  return numbers;
}

std::string packing_block(const Run& run, const std::string& title, const Packing& packing, const ShownPart& part) {
  return fmt::format("<script type=\"application/octet-stream;base64\" class=\"packing\" data-key=\"{}\" "
                     "data-title=\"{}\" data-dimension=\"{}\" data-unit=\"{}\" data-size=\"{}\" data-boundary=\"{}\" "
                     "data-gap=\"{}\" data-count=\"{}\" data-shown=\"{}\" data-height=\"{}\">{}</script>\n",
                     run.planned.key, html_text(title), packing.dimension, unit_text(packing.unit),
                     numbers_attribute(packing.size, packing.dimension), boundary_attribute(packing),
                     canonical_number(contact_gap_of(run)), packing.count(), part.spheres.size(),
                     canonical_number(part.height), base64_of(numbers_of(packing, part.spheres)));
}

constexpr std::string_view kControls = R"html(<div class="view">
<div class="controls">
<label>Packing <select name="packing"></select></label>
<label>Colour <select name="colour"><option value="radius">radius</option>
<option value="coordination">coordination number</option><option value="stability">stable alone</option></select></label>
<span class="cuts">Cut <label>x <input type="range" name="cut0" max="1" step="0.005" value="1"></label>
<label>y <input type="range" name="cut1" max="1" step="0.005" value="1"></label>
<label>z <input type="range" name="cut2" max="1" step="0.005" value="1"></label></span>
<button type="button" name="home">Reset view</button>
</div>
<canvas tabindex="0" role="img" aria-label="The packing chosen above"></canvas>
<p class="legend"><span></span><i></i><span></span></p>
<p class="state soft" role="status"></p>
<p class="help soft">Drag turns (2D: moves), two fingers or Shift move, a pinch or + and − zoom; so does the wheel once the
picture is clicked.</p>
</div>
)html";

} // namespace

ShownPart shown_part(const Packing& packing, std::size_t most) {
  const std::size_t n = packing.count();
  const auto dimension = static_cast<std::size_t>(packing.dimension);
  const std::size_t vertical = dimension - 1;
  const double size = packing.size[vertical];
  // Height from which on a sphere belongs to the slab; one that reaches over a periodic lid always does.
  std::vector<double> bottom(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = packing.positions[i * dimension + vertical];
    const double r = packing.radii[i];
    bottom[i] = packing.boundary[vertical] == Boundary::periodic && z + r > size ? 0 : z - r;
  }
  ShownPart part{size, {}};
  if (n > most) {
    std::vector<double> order = bottom;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end());
    part.height = std::clamp(order[most], 0.0, size);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (n <= most || bottom[i] < part.height)
      part.spheres.push_back(i);
  }
  return part;
}

std::string packings_section(const ReportInput& input) {
  const std::vector<RunGroup> groups = group_runs(input.runs);
  std::vector<std::string> titles;
  const std::vector<const Run*> runs = runs_to_show(groups, titles);
  if (!input.packing || runs.empty())
    return {};
  std::string out = "<section id=\"packings\">\n<h2>Packings</h2>\n";
  if (kThreeJs.empty())
    return out + fmt::format("<p>This tamp was built without the Debian package {}, so its pages cannot draw packings. "
                             "Install it, build again, and repeat <code>tamp report</code>.</p>\n</section>\n",
                             kThreeJsPackage);
  std::string blocks;
  std::string missing;
  std::size_t left = kMostSpheresOfPage;
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double promised = runs[i]->measure("N").value_or(0); // spares reading what will not fit
    if (std::min(promised, static_cast<double>(kMostSpheresShown)) > static_cast<double>(left)) {
      ++left_out;
      continue;
    }
    try {
      const Packing packing = input.packing(runs[i]->planned.key);
      const ShownPart part = shown_part(packing, std::min(kMostSpheresShown, left));
      left -= part.spheres.size();
      blocks += packing_block(*runs[i], titles[i], packing, part);
    } catch (const Error& error) {
      missing += fmt::format("<p>{} cannot be shown: {}. To make what is lost again: <code>{}</code></p>\n",
                             html_text(titles[i]), html_text(error.what()), html_text(input.command));
    }
  }
  if (left_out > 0)
    missing += fmt::format("<p>{} further packings are not on this page, which holds {} spheres at most; all are in "
                           "the store <code>{}</code>.</p>\n",
                           left_out, kMostSpheresOfPage, html_text(input.store));
  if (blocks.empty())
    return out + missing + "</section>\n";
  return out + std::string(kControls) + missing + "</section>\n" + blocks +
         fmt::format("<script>/* {} */\n{}</script>\n", kThreeJsLicence, kThreeJs);
}

} // namespace tamp
