// Tables in HTML: cells that sort, and that name the runs behind their number.
#pragma once

#include "report/table.h"

#include <string>
#include <string_view>

namespace tamp {

/// Text in which no character means anything to HTML; also for attribute values in double quotes.
std::string html_text(std::string_view text);

/// Caption, grids and notes of one table as a <section> whose id is the table's name. Every group is a <tbody>, so that
/// its lines stay together when groups are sorted; a cell carries its exact value in `data-v` and the keys of its runs
/// in `data-k`, separated by blanks.
std::string html_table(const Table& table);

} // namespace tamp
