// Says how a job differs from the recorded job that is most like it, by their canonical texts.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp::cli {

/// What decides a job's result: path ("scene/psd/sigma_ln") → JSON text of the value. A list is one value.
using Leaves = std::map<std::string, std::string>;

/// The leaves of a canonical text (engine/model/job.h). Throws Error for a text that is no JSON object.
Leaves leaves_of(std::string_view canonical);

/// One leaf that two jobs do not share; empty where a job does not state it.
struct Difference {
  std::string path;
  std::string recorded;
  std::string wanted;
};

/// All leaves in which two jobs differ, by path; empty if the two are one job.
std::vector<Difference> differences(const Leaves& recorded, const Leaves& wanted);

/// The index of the candidate with the fewest differences; nothing without candidates. Of equally near ones that wins
/// which differs in what a user changes least knowingly: a revision before a parameter, a parent, a seed or replicate.
std::optional<std::size_t> nearest_job(std::span<const Leaves> candidates, const Leaves& wanted);

/// "scene/psd/sigma_ln: 0.3 recorded, 0.31 wanted; …"; long values are cut.
std::string in_words(std::span<const Difference> differences);

} // namespace tamp::cli
