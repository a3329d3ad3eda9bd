// Writes entities. MUST and SHOULD are those of the profile (section "Requirements") and of RO-Crate 1.1.
#include "store/ro_crate_entities.h"

#include "engine/base/sha256.h"
#include "store/file_digest.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp::crate {

namespace {

constexpr const char* kContext = "https://w3id.org/ro/crate/1.1";
constexpr std::size_t kShort = 12; // digits of a hash that tell builds apart

bool is_unreserved(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view("-._~/").find(c) != std::string_view::npos;
}

/// "1.25 s of wall-clock time …": what the measurements of a run rest on.
std::string circumstances(const Record& r) {
  const Provenance& p = r.provenance;
  return fmt::format(
      "{} revision {}; {:.6g} s of wall-clock time, {:.6g} s of CPU time, timing {}, {} of {} threads of "
      "{} ({}, {})",
      r.name, r.revision, r.timing.wall_s, r.timing.cpu_s, name_of(r.timing.mode), p.threads, p.hardware_threads,
      p.host, p.cpu_model, p.kernel);
}

} // namespace

Json reference(const std::string& id) {
  return Json{{"@id", id}};
}

Json references(const std::vector<std::string>& ids) {
  Json list = Json::array();
  for (const std::string& id : ids)
    list.push_back(reference(id));
  return list;
}

std::string path_id(const std::filesystem::path& path) {
  std::string id;
  for (const char c : path.generic_string()) {
    if (is_unreserved(c)) {
      id += c;
    } else {
      id += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return id;
}

std::string crate_time(const std::string& utc) {
  constexpr std::size_t kSeconds = std::string_view("2024-05-17T08:09:10").size();
  if (utc.size() < kSeconds)
    return utc;
  std::string digits = utc.size() > kSeconds && utc[kSeconds] == '.' ? utc.substr(kSeconds + 1, 3) : "000";
  while (!digits.empty() && (digits.back() < '0' || digits.back() > '9'))
    digits.pop_back();
  digits.resize(3, '0');
  return fmt::format("{}.{}+00:00", utc.substr(0, kSeconds), digits);
}

Json descriptor() {
  return {{"@id", kMetadataFile},
          {"@type", "CreativeWork"},
          {"conformsTo", reference(kContext)},
          {"about", reference("./")}};
}

Json profile() {
  return {{"@id", kProfile}, {"@type", "CreativeWork"}, {"name", "Process Run Crate"}, {"version", "0.5"}};
}

Json file_entity(const std::filesystem::path& root, const std::filesystem::path& path, const std::string& name,
                 const std::string& format, std::string sha256) {
  const std::filesystem::path file = root / path;
  if (sha256.empty())
    sha256 = file_sha256(file);
  return {{"@id", path_id(path)},
          {"@type", "File"},
          {"name", name},
          {"encodingFormat", format},
          {"contentSize", std::to_string(std::filesystem::file_size(file))},
          {"sha256", sha256}};
}

Software software_of(const Provenance& p) {
  Software software;
  std::vector<std::string> ids;
  std::string build = p.commit + (p.dirty ? "*" : "") + p.compiler + "\n" + p.flags;
  for (const auto& [name, version] : p.libraries) {
    const std::string id = fmt::format("#{}-{}", path_id(name), sha256_hex(version).substr(0, kShort));
    software.requirements.push_back(
        {{"@id", id}, {"@type", "SoftwareApplication"}, {"name", name}, {"softwareVersion", version}});
    ids.push_back(id);
    build += "\n" + name + " " + version;
  }
  software.program = {{"@id", "#tamp-" + sha256_hex(build).substr(0, kShort)},
                      {"@type", "SoftwareApplication"},
                      {"name", "tamp"},
                      {"description", fmt::format("{}compiled by {} with {}", p.dirty ? "a changed working tree, " : "",
                                                  p.compiler, p.flags)},
                      {"softwareVersion", p.commit + (p.dirty ? "+changed" : "")}};
  if (!ids.empty())
    software.program["softwareRequirements"] = references(ids);
  return software;
}

std::string action_id(const Record& record, std::size_t number) {
  return fmt::format("#{}-{}", record.key, number);
}

Json action(const Attempt& attempt) {
  const Record& r = attempt.record;
  const bool ok = r.outcome == Outcome::ok;
  Json json{{"@id", action_id(r, attempt.number)},
            {"@type", "CreateAction"},
            {"name", attempt.what},
            {"description", circumstances(r)},
            {"startTime", crate_time(r.provenance.start_utc)},
            {"endTime", crate_time(r.provenance.end_utc)},
            {"instrument", reference(software_of(r.provenance).id())},
            {"object", references(attempt.inputs)},
            {"result", references(attempt.results)},
            {"actionStatus", ok ? "http://schema.org/CompletedActionStatus" : "http://schema.org/FailedActionStatus"}};
  if (!attempt.agent.empty())
    json["agent"] = reference(attempt.agent);
  if (!ok)
    json["error"] = fmt::format("{}: {}", name_of(r.outcome), r.reason);
  return json;
}

bool is_address(std::string_view text) {
  const std::size_t scheme = text.find("://");
  return scheme != std::string_view::npos && scheme > 0 && text.find_first_of(" <>\"{}|\\^`") == std::string_view::npos;
}

License license_of(const std::string& stated) {
  if (stated.empty())
    return {"No licence is stated: ask the author before any use", {}};
  const std::string id = is_address(stated) ? stated : "https://spdx.org/licenses/" + stated;
  if (!is_address(stated) &&
      !std::all_of(stated.begin(), stated.end(), [](char c) { return c != '/' && is_unreserved(c); }))
    throw InputError(fmt::format("\"{}\" is neither an SPDX identifier, as CC-BY-4.0 is, nor an address", stated));
  return {reference(id),
          {{{"@id", id},
            {"@type", "CreativeWork"},
            {"name", stated},
            {"description", fmt::format("The licence {} of the data in this crate", stated)}}}};
}

} // namespace tamp::crate
