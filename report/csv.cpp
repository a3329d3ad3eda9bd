// Writes tables as comma-separated values.
#include "report/csv.h"

#include "engine/base/canonical_json.h"
#include "report/symbols.h"

#include <array>
#include <cmath>

namespace tamp {

namespace {

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos)
    return std::string(text);
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

} // namespace

std::string csv_record(std::span<const std::string> fields) {
  std::string out;
  for (std::size_t i = 0; i < fields.size(); ++i)
    out += (i == 0 ? "" : ",") + csv_field(fields[i]);
  return out + "\n";
}

std::string csv_number(double value) {
  return std::isfinite(value) ? canonical_number(value) : std::string();
}

std::string csv_table(const Table& table) {
  std::string out = "table,panel,method,source,quantity,unit,value,sd,n\n";
  for (const Panel& panel : table.panels) {
    for (const Group& group : panel.groups) {
      for (const Group::Line& line : group.lines) {
        for (std::size_t i = 0; i < line.cells.size(); ++i) {
          const Cell& cell = line.cells[i];
          if (cell.empty())
            continue;
          const bool word = !cell.word.empty();
          const std::string& quantity = cell.quantity.empty() ? panel.columns[i].quantity : cell.quantity;
          const std::array<std::string, 9> fields = {table.name,
                                                     plain_text(panel.title),
                                                     plain_text(group.heading),
                                                     line.name.empty() ? "this run" : line.name,
                                                     word && cell.quantity.empty() ? "outcome" : quantity,
                                                     word ? std::string() : std::string(cell.unit),
                                                     word ? cell.word : csv_number(cell.value),
                                                     csv_number(cell.spread),
                                                     cell.n == 0 ? std::string() : std::to_string(cell.n)};
          out += csv_record(fields);
        }
      }
    }
  }
  return out;
}

} // namespace tamp
