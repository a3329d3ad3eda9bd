// Tables in LaTeX: fragments for \input and one document that shows them.
#pragma once

#include "report/table.h"

#include <span>
#include <string>
#include <string_view>

namespace tamp {

/// Text as LaTeX: special characters and the signs that tamp's texts use become commands; letters of European languages
/// stay; any other character outside ASCII, which pdflatex could not set, becomes a question mark.
std::string latex_text(std::string_view text);

/// A floating table with caption and notes; its label is tab:NAME. Panels that do not fit on one page go on in another
/// float of the same number; a panel wider than the text shrinks. Needs the packages booktabs and graphicx.
std::string latex_fragment(const Table& table);

/// A document for A4 that inputs the fragment NAME.tex of each table and includes NAME.pdf of each figure.
std::string latex_document(std::string_view title, std::span<const Table> tables,
                           std::span<const FigureMention> figures = {});

} // namespace tamp
