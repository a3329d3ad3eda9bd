// Notes on the lines and columns of lognormal tables.
#include "engine/base/canonical_json.h"
#include "report/density_oracle.h"
#include "report/lognormal_table.h"
#include "report/notes.h"
#include "report/quantities.h"

#include <fmt/format.h>

namespace tamp {

namespace {

const Metric* find_metric(const Plan& plan, MetricName name) {
  for (const Metric& metric : plan.metrics) {
    if (metric.name == name)
      return &metric;
  }
  return nullptr;
}

Note lines_note(const NotesInput& input) {
  std::string text =
      "\"this run\": mean ± sample standard deviation over the n replicates that ended ok, no standard deviation for "
      "n = 1 or where the replicates agree to nine digits. \"paper\": the figure as printed in " +
      std::string(kPaperCitation) +
      ". \"difference\": this run minus paper, with the digits that both have, for counts also in per cent of the "
      "paper's; for the time the factor paper / this run, above 1 where this run is faster. The paper's rows of "
      "methods "
      "that were not run are left out. Which row of the paper stands beside a group is decided by method and contact "
      "effects, whatever its label.";
  for (const RunGroup& group : input.groups) {
    if (group.ok_count() == 0)
      continue;
    const Likeness like = likeness(group.job().scene, *input.lognormal);
    const PaperRow* row = input.lognormal->find(group.job().method);
    if (!row)
      text += fmt::format(" {}: the paper has no such method with these effects.", group.heading);
    else if (like == Likeness::other_powder)
      text += fmt::format(" {}: not the paper's powder, so not compared.", group.heading);
    else if (like == Likeness::other_size)
      text += fmt::format(" {}: the paper's powder in another box than its {} µm, so only ⟨phi_paper⟩ is compared.",
                          group.heading, canonical_number(input.lognormal->edge_um));
    if (row && like != Likeness::other_powder) {
      const std::string protocol = other_protocol(group.job().method);
      text += fmt::format(" {} stands beside the paper's {}{}{}.", group.heading, row->method,
                          protocol.empty() ? "" : ", which was made by another protocol than this run's: ", protocol);
    }
  }
  return {"Lines", text};
}

Note columns_note(const NotesInput& input) {
  const bool two = input.lognormal->dimension == 2;
  std::string text = fmt::format("⟨X⟩: edge of the box. ⟨N_part⟩: particles in it. ⟨H_N⟩, ⟨{}⟩: Hellinger distance of "
                                 "the radii's histogram to the prescribed law, weighted by number and by {}",
                                 two ? "H_S" : "H_V", two ? "surface (r²)" : "volume (r³)");
  if (const Metric* hellinger = find_metric(input.plan, MetricName::hellinger))
    text += fmt::format(", with ⟨K⟩ = {} equal bins over the law's range of radii", hellinger->bins);
  else
    text += " (empty: this campaign does not ask for the metric hellinger)";
  text += fmt::format("; ⟨H_N_floor⟩, ⟨{}⟩: root mean square of it over perfect random samplers with as many particles "
                      "and the same bins.",
                      two ? "H_S_floor" : "H_V_floor");
  if (const Metric* metric = find_metric(input.plan, MetricName::phi_paper))
    text +=
        fmt::format(" ⟨phi_paper⟩: the paper's estimator, in the sub-box cut {} % of the bounding box of the centres "
                    "(along periodic axes: of the box) from each side: particles whose centre is inside, less the caps "
                    "that stick out; ⟨N_PB⟩: their number.",
                    canonical_number(100 * metric->inset));
  if (const Metric* metric = find_metric(input.plan, MetricName::phi))
    text += fmt::format(" ⟨phi⟩: exact {} of all particles inside the sub-box (inset {} %).", two ? "area" : "volume",
                        canonical_number(100 * metric->inset));
  if (any_has(input.groups, "phi_box"))
    text += " ⟨phi_box⟩: the same of the whole box, where it is periodic on all sides.";
  text +=
      " ⟨overlap_max⟩: deepest overlap of two particles, or of one with a wall, relative to the smaller radius, in the "
      "worst replicate. ⟨stable_alone⟩: share of the particles in equilibrium under their weight with their "
      "neighbours held, in the worst replicate; 1 means all. ⟨z⟩: mean number of contacts of a particle with others, "
      "walls not counted.";
  if (const Metric* metric = find_metric(input.plan, MetricName::coordination))
    text +=
        fmt::format(" A contact is a gap of at most {} of the smaller radius.", canonical_number(metric->contact_gap));
  if (!two)
    text += oracle_sentence();
  return {"Columns", text};
}

} // namespace

std::vector<Note> estimator_notes(const NotesInput& input) {
  if (input.groups.empty() || !input.lognormal)
    return {};
  return {lines_note(input), columns_note(input)};
}

} // namespace tamp
