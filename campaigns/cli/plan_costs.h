// What the open jobs of an agenda will take, learned from the records of a store, in words.
#pragma once

#include "engine/schedule/agenda.h"
#include "store/store.h"

#include <string>

namespace tamp::cli {

/// Lines for each method and metric that has open jobs: how many, their time on so many cores with its 95 % interval,
/// the memory of the largest, from how many records; "nothing is known" where there are none; and the sum. Records of
/// this CPU model come first; those of others count only where it has none, and that is said. Only jobs that ended with
/// a packing (metrics: ok) are learned from, of those the latest few hundred.
std::string costs_in_words(const Agenda& agenda, const Store& store, int cores);

} // namespace tamp::cli
