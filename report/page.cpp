// Puts the page together.
#include "report/page.h"

#include "report/html.h"
#include "report/page_assets.h"
#include "report/page_packings.h"
#include "report/provenance_json.h"

#include <fmt/format.h>

#include <regex>

namespace tamp {

namespace {

/// An SVG without what may not stand inside a page: the XML declaration, the document type, identifiers of others.
std::string inline_svg(const PageFigure& figure) {
  const std::size_t start = figure.svg.find("<svg");
  if (start == std::string::npos)
    return {};
  // gnuplot numbers the parts of every figure from 1 on, and a page may have an identifier but once.
  static const std::regex named(R"re(( id=["']|href=["']#|url\(#))re");
  return std::regex_replace(figure.svg.substr(start), named, "$1" + figure.name + "-");
}

std::string figure_block(const PageFigure& figure) {
  const std::string name = html_text(figure.name);
  return fmt::format("<figure id=\"figure-{0}\">{1}<figcaption>{2} <span class=\"soft\">Files: {0}.gp and its data, "
                     "{0}.svg, {0}.pdf, {0}.png.</span></figcaption></figure>\n",
                     name, inline_svg(figure), html_text(figure.caption));
}

std::string contents(std::span<const Table> tables, bool packings, bool figures) {
  std::string out = "<nav>";
  for (const Table& table : tables)
    out += fmt::format("<a href=\"#{0}\">{0}</a>", html_text(table.name));
  if (packings)
    out += "<a href=\"#packings\">packings</a>";
  return out + (figures ? "<a href=\"#figures\">figures</a></nav>\n" : "</nav>\n");
}

std::string state_of(const ReportInput& input) {
  std::size_t ok = 0;
  std::size_t missing = 0;
  std::size_t impossible = 0;
  for (const Run& run : input.runs) {
    ok += run.ok() ? 1U : 0U;
    const bool barred = run.barrier() != nullptr;
    missing += run.generation || barred ? 0U : 1U;
    impossible += !run.generation && barred ? 1U : 0U;
  }
  std::string text = fmt::format("<p>{} packings asked for, {} made, {} ended otherwise, {} not yet run.",
                                 input.runs.size(), ok, input.runs.size() - ok - missing - impossible, missing);
  if (missing > 0)
    text += " To run what is missing: <code>" + html_text(input.command) + "</code>.";
  if (impossible > 0)
    text +=
        fmt::format(" {} not possible, as the packings they start from ended otherwise: the notes of the tables say "
                    "which.",
                    impossible);
  return text + " Underlined numbers tell which runs they come from; headings sort.</p>\n";
}

} // namespace

std::string html_page(const ReportInput& input, std::span<const Table> tables, std::span<const PageFigure> figures,
                      std::span<const std::string> missing) {
  const std::string title = html_text(input.plan.title.empty() ? input.plan.campaign : input.plan.title);
  std::string out = fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                                "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                                "<title>{0}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>{1}</style>\n</head>\n"
                                "<body>\n<h1>{0}</h1>\n",
                                title, kPageStyle);
  out += state_of(input);
  for (const std::string& sentence : missing)
    out += "<p>" + html_text(sentence) + "</p>\n";
  const std::string packings = packings_section(input);
  out += contents(tables, !packings.empty(), !figures.empty());
  for (const Table& table : tables)
    out += html_table(table);
  if (!figures.empty()) {
    out += "<section id=\"figures\">\n<h2>Figures</h2>\n<div class=\"figures\">\n";
    for (const PageFigure& figure : figures)
      out += figure_block(figure);
    out += "</div>\n</section>\n";
  }
  out += packings;
  out += "<dialog><button>Close</button><div></div></dialog>\n";
  out += fmt::format("<script type=\"application/json\" id=\"page\">{{\"command\":{},\"store\":{}}}</script>\n",
                     script_string(input.command), script_string(input.store));
  out += fmt::format("<script type=\"application/json\" id=\"runs\">{}</script>\n", provenance_json(input.runs));
  return out + fmt::format("<script>'use strict';\n{}</script>\n</body>\n</html>\n", kPageScript);
}

} // namespace tamp
