// The paper's lognormal tables made from a campaign's runs: its columns beside ours, and the differences.
#pragma once

#include "report/paper_tables.h"
#include "report/runs.h"
#include "report/table.h"

#include <span>

namespace tamp {

/// What of the paper's row may be held against a scene. other_size: the paper's powder in another box, where counts,
/// times and H, which has a floor that depends on the count, say nothing against each other, but phi does.
enum class Likeness { same, other_size, other_powder };
Likeness likeness(const Scene& scene, const PaperTable& paper);

/// The groups of a campaign that belong into the table: a lognormal law in the table's dimension.
std::vector<RunGroup> lognormal_groups(std::span<const Run> runs, const PaperTable& paper);

/// Two panels: the paper's columns with lines "this run", "paper", "difference" (of times: the paper's time divided by
/// this run's), and what the paper does not print. A group in which no run ended ok shows how its runs ended in the
/// place of N; one that has not run has no row. Notes are not filled in.
Table lognormal_table(std::span<const RunGroup> groups, const PaperTable& paper);

} // namespace tamp
