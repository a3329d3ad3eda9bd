// The effects ledger of campaigns in words, before anything runs.
#pragma once

#include "engine/model/plan.h"

#include <string>

namespace tamp::cli {

/// For each label of the plan, and each of its settings that differs in this: what will be simulated, and what is left
/// out by which rule.
std::string effects_in_words(const Plan& plan);

} // namespace tamp::cli
