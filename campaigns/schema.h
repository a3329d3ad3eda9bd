// The JSON Schema of campaign files, written from the parameter tables; editors complete and check with it.
#pragma once

#include <string>

namespace tamp {

/// JSON Schema 2020-12 of a campaign file, as campaigns/schema.json holds it. It accepts every file that load_campaign
/// accepts; what depends on several values at once (a box smaller than the largest sphere …) load_campaign alone
/// judges.
std::string schema_json();

} // namespace tamp
