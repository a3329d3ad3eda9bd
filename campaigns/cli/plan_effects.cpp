// Writes the effects ledger of campaigns.
#include "campaigns/cli/plan_effects.h"

#include "engine/generate/effects_ledger.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

std::string ledger_in_words(const Effects& effects) {
  std::string words;
  if (!effects.simulated.empty())
    words += fmt::format("      simulated: {}\n", fmt::join(effects.simulated, "; "));
  std::string left_out;
  for (const Effects::LeftOut& one : effects.left_out)
    left_out += fmt::format("{}{} ({})", left_out.empty() ? "" : "; ", one.effect, one.why);
  return left_out.empty() ? words : words + fmt::format("      left out: {}\n", left_out);
}

} // namespace

std::string effects_in_words(const Plan& plan) {
  using Entry = std::pair<std::string, std::string>; // label, ledger
  std::vector<Entry> order;
  std::map<Entry, std::size_t> packings;
  for (const PlannedJob& planned : plan.jobs) {
    Entry entry{planned.label, ledger_in_words(effects_ledger(planned.job))};
    if (entry.second.empty())
      continue;
    if (packings[entry]++ == 0)
      order.push_back(std::move(entry));
  }
  std::string words;
  for (const Entry& entry : order)
    words += fmt::format("    {} ({} packing{})\n{}", entry.first, packings[entry], packings[entry] == 1 ? "" : "s",
                         entry.second);
  return words.empty() ? words : "  effects, at the mean radius of the law:\n" + words;
}

} // namespace tamp::cli
