// Symbols of measured quantities in each output format, and text that mentions them.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace tamp {

/// `name` is the plain form, as in CSV files; the others are complete marks of their format.
struct Symbol {
  std::string_view name;
  std::string_view latex;
  std::string_view markdown;
};

/// The symbol of a name; nullptr if there is none.
const Symbol* find_symbol(std::string_view name);

/// Text of notes and headings names a symbol as ⟨H_N⟩. This splits such a text: what stands between symbols goes
/// through `escape`, the symbols through `mark`; angle brackets around any other word are text.
std::string render_text(std::string_view text, const std::function<std::string(std::string_view)>& escape,
                        const std::function<std::string(const Symbol&)>& mark);

/// Such a text with the plain names of its symbols.
std::string plain_text(std::string_view text);

} // namespace tamp
