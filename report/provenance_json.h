// The runs behind a page's numbers as JSON: what the page shows when a number is asked where it comes from.
#pragma once

#include "report/runs.h"

#include <span>
#include <string>
#include <string_view>

namespace tamp {

/// A canonical JSON string without "<", which could end the <script> element that it stands in.
std::string script_string(std::string_view words);

/// {"KEY":{"method","seed","replicate","parent","job" (canonical JSON, as text),"outcome","reason","commit","dirty",
/// "host","cpu","compiler","start","mode","wall","measures":{name:value},"metrics":{metric:key}}}, in the order of the
/// runs, on one line each; "<" is escaped, so that the text may stand inside a <script> element.
std::string provenance_json(std::span<const Run> runs);

} // namespace tamp
