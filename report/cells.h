// Cells of one kind each, and what sets a run's cell against the paper's: the parts that all tables share.
#pragma once

#include "report/paper_tables.h"
#include "report/quantities.h"
#include "report/table.h"

#include <string>
#include <string_view>

namespace tamp {

/// Micrometres in one of the unit.
double micrometres(LengthUnit unit);

/// The unit as people write it: µm.
std::string_view unit_text(LengthUnit unit);

/// Whether two numbers differ by no more than that share of the larger one.
bool agrees(double a, double b, double relative);

Cell count_cell(double value);
Cell printed_cell(const Printed& printed);
/// A length in µm, whole where it is.
Cell edge_cell(double edge_um);
/// A time in s without a spread.
Cell time_cell(double seconds);
/// The group's median time with the standard deviation; never of both timing modes (report/quantities.h).
Cell time_cell(const GroupTime& time);
/// A word in the place of a number: how a job ended.
Cell word_cell(std::string word);

/// This run's value minus the paper's, with no more digits than either has; empty if either is. `count`: also in per
/// cent.
Cell difference_cell(const Cell& run, const Cell& paper, bool count);
/// Behind the name of a group whose runs start from packings: "; from D&R", or empty.
std::string start_remark(const RunGroup& group);

/// The paper's time divided by this run's, which is that of the whole way from the scene.
Cell speed_cell(const Cell& run, const Cell& paper);

/// Behind the name of a group that stands beside the paper's: "; not the paper's protocol: on_failure keep", or empty.
std::string protocol_remark(const RunGroup& group);

/// The heading of a quantity's column.
Column heading(const Quantity& quantity);

/// How the runs of a group ended that are not ok, "memory-limited" or "memory-limited, failed"; of a group that could
/// not run, as what it starts from was not made, "not possible". Empty if all are ok or none has run.
std::string other_outcomes(const RunGroup& group);

} // namespace tamp
