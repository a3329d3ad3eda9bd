// Tables in Markdown (GitHub flavour): one page with all of them and their notes.
#pragma once

#include "report/table.h"

#include <span>
#include <string>
#include <string_view>

namespace tamp {

/// Text in which no character means anything to Markdown or HTML; line breaks become spaces.
std::string markdown_text(std::string_view text);

/// Caption, grids and notes of one table under a second-level heading.
std::string markdown_table(const Table& table);

/// The page: title, an opening paragraph, what is missing, the tables, the figures' NAME.svg.
std::string markdown_page(std::string_view title, std::string_view opening, std::span<const Table> tables,
                          std::span<const FigureMention> figures = {}, std::span<const std::string> missing = {});

} // namespace tamp
