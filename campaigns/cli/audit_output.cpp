// An audit as text, several as a table, and all as JSON.
#include "campaigns/cli/audit.h"
#include "store/formats/format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tamp::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kAxes = "xyz";

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

std::string box_words(const Audit& audit) {
  const Packing& packing = audit.read.packing;
  std::string text;
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a)
    text += fmt::format("{}{} from {} to {} {} ({})", a == 0 ? "" : ", ", kAxes[a], number(audit.read.origin[a]),
                        number(audit.read.origin[a] + packing.size[a]), name_of(packing.boundary[a]),
                        audit.read.said.box[a] ? "told" : "found");
  return text;
}

std::string overlap_words(const DeepOverlap& overlap) {
  return overlap.wall.empty() ? fmt::format("spheres {} and {}", overlap.a, overlap.b)
                              : fmt::format("sphere {} and the wall {}", overlap.a, overlap.wall);
}

std::string law_text(const Audit& audit) {
  const LognormalFit& fit = audit.fit;
  const std::string fitted =
      fmt::format("mu_ln {} ± {}, sigma_ln {} ± {} (95 %); Kolmogorov–Smirnov distance {}, lognormal at 5 % up to {}",
                  number(fit.mu_ln), number(fit.mu_ln_error), number(fit.sigma_ln), number(fit.sigma_ln_error),
                  number(fit.distance), number(fit.limit));
  if (fit.sigma_ln == 0)
    return fmt::format("  law            {} ({})\n", audit.law_words, audit.fitted ? "found" : "stated");
  return audit.fitted ? fmt::format("  law            fitted lognormal: {}\n", fitted)
                      : fmt::format("  law            stated: {}\n  lognormal fit  {}\n", audit.law_words, fitted);
}

/// All measures that any of the audits has, in their order.
std::vector<std::string> measure_names(const std::vector<Audit>& audits) {
  std::vector<std::string> names;
  for (const Audit& audit : audits) {
    for (const Finding& finding : audit.findings) {
      for (const Measure& m : finding.measures) {
        if (std::find(names.begin(), names.end(), m.name) == names.end())
          names.push_back(m.name);
      }
    }
  }
  return names;
}

Json json_of(const Audit& audit) {
  const Packing& packing = audit.read.packing;
  const auto d = static_cast<std::size_t>(packing.dimension);
  Json json = {{"file", audit.file},
               {"spheres", packing.count()},
               {"dimension", packing.dimension},
               {"unit", name_of(packing.unit)},
               {"unit_told", audit.read.said.unit.has_value()},
               {"step", audit.read.step}};
  for (std::size_t a = 0; a < d; ++a)
    json["box"].push_back({{"low", audit.read.origin[a]},
                           {"high", audit.read.origin[a] + packing.size[a]},
                           {"sides", name_of(packing.boundary[a])},
                           {"told", audit.read.said.box[a].has_value()}});
  json["law"] = {{"words", audit.law_words}, {"fitted", audit.fitted}};
  const LognormalFit& fit = audit.fit;
  json["lognormal_fit"] = {{"mu_ln", fit.mu_ln},       {"mu_ln_error", fit.mu_ln_error},
                           {"sigma_ln", fit.sigma_ln}, {"sigma_ln_error", fit.sigma_ln_error},
                           {"distance", fit.distance}, {"limit", fit.limit}};
  json["measures"] = Json::object();
  json["not_measured"] = Json::object();
  for (const Finding& finding : audit.findings) {
    for (const Measure& m : finding.measures)
      json["measures"][m.name] = {{"value", m.value}, {"unit", m.unit}};
    if (!finding.why_not.empty())
      json["not_measured"][finding.metric] = finding.why_not;
  }
  if (audit.close_packing)
    json["random_close_packing"] = *audit.close_packing;
  json["worst_overlaps"] = Json::array();
  for (const DeepOverlap& overlap : audit.worst) {
    Json entry = {{"sphere", overlap.a}, {"depth", overlap.depth}};
    if (overlap.wall.empty())
      entry["other"] = overlap.b;
    else
      entry["wall"] = overlap.wall;
    json["worst_overlaps"].push_back(std::move(entry));
  }
  json["floating"] = {{"count", audit.floating_count}, {"first", audit.floating}};
  return json;
}

} // namespace

std::string audit_text(const Audit& audit) {
  const Packing& packing = audit.read.packing;
  const auto [smallest, largest] = std::minmax_element(packing.radii.begin(), packing.radii.end());
  std::string text =
      fmt::format("{}: {} spheres in {}D, lengths in {}{}\n", audit.file, packing.count(), packing.dimension,
                  name_of(packing.unit), audit.read.said.unit ? "" : " (the file does not say)");
  text += fmt::format("  box            {}\n", box_words(audit));
  text += fmt::format("  radii          from {} to {}\n", number(*smallest), number(*largest));
  text += law_text(audit);
  for (const Finding& finding : audit.findings) {
    for (const Measure& m : finding.measures)
      text += fmt::format("  {:<14} {}{}\n", m.name, number(m.value), m.unit == "1" ? "" : " " + m.unit);
    if (!finding.why_not.empty())
      text += fmt::format("  {:<14} not measured: {}\n", finding.metric, finding.why_not);
  }
  if (const auto phi = value_of(audit, "phi"); phi && audit.close_packing)
    text += fmt::format("  close packing  {} at random by the law; phi lies {} {}\n", number(*audit.close_packing),
                        number(std::abs(*phi - *audit.close_packing)), *phi < *audit.close_packing ? "below" : "above");
  if (audit.floating_count > 0)
    text += fmt::format("  floating       {} spheres touch nothing: {}{}\n", audit.floating_count,
                        fmt::join(audit.floating, ", "), audit.floating_count > audit.floating.size() ? " …" : "");
  for (const DeepOverlap& overlap : audit.worst)
    text +=
        fmt::format("  overlap        {} of the smaller radius: {}\n", number(overlap.depth), overlap_words(overlap));
  return text;
}

std::string comparison_of(const std::vector<Audit>& audits) {
  constexpr std::size_t kGap = 2;
  std::vector<std::vector<std::string>> rows = {{""}, {"spheres"}};
  for (const Audit& audit : audits) {
    rows[0].push_back(audit.file);
    rows[1].push_back(fmt::format("{}", audit.read.packing.count()));
  }
  const auto add_row = [&](const std::string& name, auto&& value) {
    rows.push_back({name});
    for (const Audit& audit : audits) {
      const std::optional<double> found = value(audit);
      rows.back().push_back(found ? number(*found) : "–");
    }
  };
  for (const std::string& name : measure_names(audits))
    add_row(name, [&](const Audit& audit) { return value_of(audit, name); });
  add_row("close packing", [](const Audit& audit) { return audit.close_packing; });
  add_row("floating", [](const Audit& audit) { return std::optional(static_cast<double>(audit.floating_count)); });
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      std::size_t width = 0;
      for (const auto& other : rows)
        width = std::max(width, other[c].size());
      line += fmt::format("{:<{}}", row[c], width + kGap);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string audit_json(const std::vector<Audit>& audits) {
  Json json = {{"audits", Json::array()}};
  for (const Audit& audit : audits)
    json["audits"].push_back(json_of(audit));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace tamp::cli
