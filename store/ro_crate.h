// A campaign as a Workflow Run RO-Crate: a folder that a data repository takes, with every run told in linked data.
#pragma once

#include "store/store.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace tamp {

/// What the records do not know. Empty: not stated.
struct CrateStatements {
  std::string license;   ///< of the data: an SPDX identifier ("CC-BY-4.0") or an address
  std::string author;    ///< who made the data and ran the jobs
  std::string author_id; ///< address that names the author, such as an ORCID
};

/// What has been written.
struct CrateContents {
  std::size_t packings = 0;
  std::size_t attempts = 0; ///< of generations and metrics; one action and one record file each
  std::size_t failed = 0;   ///< of these, those that did not end ok
};

/// Writes what the store has of a plan's jobs into the folder `out`, which must be absent or empty:
///   ro-crate-metadata.json         Process Run Crate 0.5 (https://w3id.org/ro/wfrun/process/0.5)
///   campaigns/NAME                 the campaign file
///   packings/XX/KEY.h5, KEY.files/ as in the store, each checked against the SHA-256 of its record
///   records/XX/KEY-N.json          attempt N at a job, the form of record_json.h
/// Each attempt is an action, also those that failed. The same store and statements give the same bytes: dates are
/// those of the records. Memory does not grow with packings. The metadata come last, so that a folder that has them is
/// whole. Throws InputError if `out` is in use, nothing is recorded or a statement makes no sense, Error for a damaged
/// packing or a full disk.
CrateContents write_ro_crate(const Store& store, const Plan& plan, const CrateStatements& statements,
                             const std::filesystem::path& out);

} // namespace tamp
