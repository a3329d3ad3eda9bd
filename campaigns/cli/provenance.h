// Where records of this program come from: its build and this machine.
#pragma once

#include "engine/model/record.h"

namespace tamp::cli {

/// Everything but start, end and threads.
Provenance this_program();

} // namespace tamp::cli
