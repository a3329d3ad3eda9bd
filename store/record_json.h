// Records as JSON text: how a child process hands its result to the store.
#pragma once

#include "engine/model/record.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tamp {

/// The record as one JSON object, indented. record_from_json() gives back the same record, every double bit for bit;
/// bytes of a text that are not UTF-8 are replaced by U+FFFD. Throws Error for a number that is not finite.
std::string record_to_json(const Record& record);

/// The record of such a text. Throws Error saying what is missing, unknown or of the wrong type; `where` (a file name)
/// opens the message.
Record record_from_json(std::string_view text, std::string_view where);

/// The same to and from a file, written whole or not at all.
void write_record(const std::filesystem::path& path, const Record& record);
Record read_record(const std::filesystem::path& path);

} // namespace tamp
