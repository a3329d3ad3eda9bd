// Talks to Slurm through its commands: hands in arrays, asks for the state of all of them in one call.
#pragma once

#include "engine/base/error.h"
#include "engine/schedule/slurm_arrays.h"
#include "engine/schedule/slurm_state.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tamp {

/// The controller does not answer just now; the same call may succeed later.
struct SlurmUnreachable : Error {
  using Error::Error;
};

/// Slurm answered, and did not do what it was asked for.
struct SlurmRefused : Error {
  using Error::Error;
};

/// What to hand in.
struct ArrayRequest {
  std::string name; ///< unique: by it the array is found again
  ClusterArray array;
  std::vector<std::string> after; ///< Slurm's numbers of the arrays it waits for, however they end
  std::filesystem::path script;   ///< run for every element
  std::filesystem::path logs;     ///< folder for the output of the elements, NAME_ELEMENT.log
};

/// The arguments of sbatch. Time and memory are those of the fullest element, with room for starting and ending jobs.
std::vector<std::string> sbatch_arguments(const ArrayRequest& request, const ClusterProfile& profile);

/// Hands in an array and returns Slurm's number of it. A controller that does not answer is asked again with growing
/// pauses for profile.patience_s, but never given the same array twice: it is looked for by its name first. Throws
/// SlurmRefused with Slurm's words; SlurmUnreachable or another Error if the array may have been taken all the same.
std::string submit(const ArrayRequest& request, const ClusterProfile& profile);

/// States of all elements of this user's arrays, in one call. Throws SlurmUnreachable, Error.
ElementStates queue_states();

/// States from the accounting of these arrays, as far as there is one: empty if there is none.
ElementStates accounted_states(const std::vector<std::string>& jobs);

/// How many elements an array may have. Throws SlurmUnreachable, Error.
std::size_t largest_array();

} // namespace tamp
