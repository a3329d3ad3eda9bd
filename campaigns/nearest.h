// The nearest known word to a misspelt one.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace tamp {

/// Edit distance with insertions, deletions, substitutions and swaps of neighbours (optimal string alignment); capital
/// letters equal small ones, '-' equals '_', µ equals u.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `known` nearest to `word`, the first of equals; empty if even that differs in more than half its
/// letters. A known path ("psd/mu_ln") whose last step is the word comes before all others: the word stands in the
/// wrong place.
std::string nearest(std::string_view word, std::span<const std::string> known);

} // namespace tamp
