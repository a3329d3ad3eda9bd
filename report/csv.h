// Comma-separated values (RFC 4180): a table's cells, one a line, with all digits.
#pragma once

#include "report/table.h"

#include <span>
#include <string>
#include <string_view>

namespace tamp {

/// One record of RFC 4180 with a newline at its end; fields with commas, quotes or line breaks are quoted.
std::string csv_record(std::span<const std::string> fields);

/// A number with the shortest digits that read back as the same double; empty if it is not finite.
std::string csv_number(double value);

/// Header "table,method,source,quantity,unit,value,sd,n", then each cell that is not empty. `source` is the name of the
/// line ("this run", "paper", "difference"); a word instead of a number has the quantity "outcome"; n is empty where
/// the value is not a statistic.
std::string csv_table(const Table& table);

} // namespace tamp
