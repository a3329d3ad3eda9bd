// Options by which commands learn what a foreign file leaves unsaid.
#pragma once

#include "engine/model/packing_builder.h"

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace tamp::cli {

/// What the user states about files that are read, as words.
struct StatedSurroundings {
  std::string unit;
  int dimension = 0;
  std::string box;
  std::string boundary;
};

/// Adds --unit, --dimension, --box and --boundary.
void add_surroundings_options(CLI::App& app, StatedSurroundings& stated);

/// Throws InputError for words that say nothing.
Surroundings surroundings_of(const StatedSurroundings& stated);

} // namespace tamp::cli
