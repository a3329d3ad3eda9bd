// Puts items into nodes, and what they wait for into edges.
#include "campaigns/cli/flow_dot.h"

#include "campaigns/cli/names.h"
#include "report/figures/style.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

constexpr std::string_view kFade = "50";        // of a method's colour as RGBA, so that letters stay readable
constexpr std::string_view kMetric = "#eeeeee"; // metrics are no methods
constexpr std::size_t kStandings = 3;           // recorded, open, barred
constexpr std::array<std::string_view, kStandings> kWords{"recorded", "to run", "not possible"};
constexpr std::array<std::string_view, kStandings> kBorder{"solid", "dashed", "dotted"};

/// A string of DOT: only quotes and backslashes mean something in it. Lines are centred.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + "\"";
}

/// The jobs that one node stands for.
struct Node {
  std::string title;
  std::string fill;
  std::array<std::size_t, kStandings> counts{};

  [[nodiscard]] std::string_view border() const { return kBorder[counts[1] > 0 ? 1 : (counts[2] > 0 ? 2 : 0)]; }
  [[nodiscard]] std::string text(FlowDetail detail) const {
    if (detail == FlowDetail::jobs)
      return title;
    std::string words;
    for (std::size_t s = 0; s < kStandings; ++s) {
      if (counts[s] > 0)
        words += fmt::format("{}{} {}", words.empty() ? "" : ", ", counts[s], kWords[s]);
    }
    return title + "\n" + words;
  }
};

class Graph {
public:
  Graph(const Agenda& agenda, FlowDetail detail) : agenda_(agenda), detail_(detail) {
    std::vector<std::size_t> node_of;
    for (const Item& item : agenda.items) {
      const std::size_t node = node_for(item);
      ++nodes_[node].counts[static_cast<std::size_t>(item.standing)];
      if (item.after)
        ++edges_[{node_of[*item.after], node}];
      node_of.push_back(node);
    }
  }

  [[nodiscard]] std::string text() const {
    std::string out = "digraph tamp {\n"
                      "  rankdir=LR;\n"
                      "  node [shape=box, fontname=\"Helvetica\", fontsize=11];\n"
                      "  edge [fontname=\"Helvetica\", fontsize=9, color=\"#444444\"];\n";
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      out += fmt::format("  n{} [label={}, style=\"filled,{}\", fillcolor=\"{}\"];\n", i,
                         quoted(nodes_[i].text(detail_)), nodes_[i].border(), nodes_[i].fill);
    for (const auto& [ends, count] : edges_)
      out += fmt::format("  n{} -> n{}{};\n", ends.first, ends.second,
                         count > 1 ? fmt::format(" [label=\"{}\"]", count) : "");
    return out + "}\n";
  }

private:
  std::size_t node_for(const Item& item) {
    const Task& task = agenda_.task(item);
    const bool generation = item.kind == JobKind::generation;
    const MethodName method = task.planned.job.method.name;
    Node node;
    node.fill = generation ? fmt::format("{}{}", method_hex(method), kFade) : std::string(kMetric);
    if (!generation) {
      node.title = name_of(agenda_.metric(item).name);
    } else if (detail_ == FlowDetail::jobs) {
      node.title = job_name(task.planned.label, task.planned.point, task.planned.job.replicate);
    } else {
      node.title = task.planned.label;
      if (node.title != name_of(method))
        node.title += fmt::format("\n{}", name_of(method));
    }
    if (detail_ == FlowDetail::jobs)
      node.title +=
          fmt::format("\n{}\n{}", short_key(item.key),
                      item.recorded ? name_of(*item.recorded) : kWords[static_cast<std::size_t>(item.standing)]);
    const auto [found, is_new] = index_.emplace(std::pair{item.kind, node.title}, nodes_.size());
    if (is_new)
      nodes_.push_back(std::move(node));
    return found->second;
  }

  const Agenda& agenda_;
  FlowDetail detail_;
  std::vector<Node> nodes_;
  std::map<std::pair<JobKind, std::string>, std::size_t> index_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges_; ///< from, to → number of jobs that wait
};

} // namespace

std::string flow_dot(const Agenda& agenda, FlowDetail detail) {
  return Graph(agenda, detail).text();
}

} // namespace tamp::cli
