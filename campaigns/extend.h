// One campaign laid over another: "extends" names a file whose keys hold where this one states none of its own.
#pragma once

#include "campaigns/json_document.h"
#include "campaigns/mistakes.h"

#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

namespace tamp {

/// Parses a campaign file and lays it over the file that it extends, if any, and that over the next: objects are joined
/// key by key, anything else is replaced, null takes a key away (RFC 7396). Names, titles and schemas are not
/// inherited. Nodes keep their places; those of extended files lie behind, as `mistakes` knows (Mistakes::add_source),
/// whose texts `texts` keeps. Throws InputError (by `mistakes`) for text that is no JSON, a file that cannot be read,
/// or a circle.
JsonDocument read_extended(std::string_view text, const std::filesystem::path& file, std::deque<std::string>& texts,
                           Mistakes& mistakes);

} // namespace tamp
