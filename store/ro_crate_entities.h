// The entities of an RO-Crate's graph as JSON: https://w3id.org/ro/crate/1.1 with the terms of Process Run Crate 0.5.
#pragma once

#include "engine/model/record.h"
#include "store/ro_crate.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tamp::crate {

using Json = nlohmann::ordered_json; // what an entity is stands before what is said of it

inline constexpr std::string_view kMetadataFile = "ro-crate-metadata.json";
inline constexpr std::string_view kProfile = "https://w3id.org/ro/wfrun/process/0.5";

/// {"@id": id}: how entities name each other.
Json reference(const std::string& id);
Json references(const std::vector<std::string>& ids);

/// The @id of a file at this path inside the crate: what no URI may hold is %-encoded.
std::string path_id(const std::filesystem::path& path);

/// "2024-05-17T08:09:10.123456Z" as "2024-05-17T08:09:10.123+00:00", the one form that all checkers take.
std::string crate_time(const std::string& utc);

/// Says that the file of metadata is about the folder, and by which specification.
Json descriptor();
/// The profile that the crate conforms to.
Json profile();

/// A file of the crate that lies below `root` at `path`; reads its size and, unless it is given, its SHA-256.
Json file_entity(const std::filesystem::path& root, const std::filesystem::path& path, const std::string& name,
                 const std::string& format, std::string sha256 = {});

/// The program that made a record, and the libraries and programs that it used.
struct Software {
  Json program;
  std::vector<Json> requirements;
  [[nodiscard]] std::string id() const { return program.at("@id"); }
};
Software software_of(const Provenance& provenance);

/// One attempt at a job.
struct Attempt {
  const Record& record;
  std::size_t number; ///< from 1
  std::string what;   ///< of the campaign: "drop-and-roll, scene/size = 60, replicate 2"
  std::vector<std::string> inputs;
  std::vector<std::string> results;
  std::string agent; ///< @id; may be empty
};
std::string action_id(const Record& record, std::size_t number);
Json action(const Attempt& attempt);

/// Whether the text can be the absolute @id of something: it has a scheme, and no character that no URI may hold.
bool is_address(std::string_view text);

/// The licence, as an entity if it has an address; else the root says in words that none is stated.
struct License {
  Json value; ///< of the root's property
  std::vector<Json> entities;
};
/// Throws InputError for what is neither an address nor like an SPDX identifier.
License license_of(const std::string& stated);

} // namespace tamp::crate
