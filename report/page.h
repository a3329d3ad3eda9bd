// The report as one self-contained web page: decision first, then figures and sortable tables, each number with its
// runs.
#pragma once

#include "report/report.h"
#include "report/table.h"

#include <span>
#include <string>

namespace tamp {

/// A figure on the page: its SVG, whole.
struct PageFigure {
  std::string name;
  std::string caption;
  std::string svg;
};

/// The page needs no network and no other file. `missing`: sentences on what could not be made, each with the command
/// that would make it.
std::string html_page(const ReportInput& input, std::span<const Table> tables, std::span<const PageFigure> figures,
                      std::span<const std::string> missing);

} // namespace tamp
