// Arranges generation jobs into the job arrays of a cluster: alike in what they need, short ones bundled, parents
// first.
#pragma once

#include "engine/model/cluster_profile.h"
#include "engine/schedule/agenda.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tamp {

/// One array: every element asks for the same; it runs its tasks one after the other.
struct ClusterArray {
  RunSettings run;                                ///< of each task
  std::vector<std::vector<std::size_t>> elements; ///< indices into Agenda::tasks
  std::vector<std::size_t> after;                 ///< arrays further up that make the packings these tasks start from

  /// Tasks in the fullest element.
  [[nodiscard]] std::size_t longest() const;
};

/// Arrays for these tasks (ascending indices into agenda.tasks), each behind those it waits for. `largest`: how many
/// elements the cluster lets an array have; the profile may ask for fewer.
std::vector<ClusterArray> arrange(const Agenda& agenda, std::span<const std::size_t> tasks,
                                  const ClusterProfile& profile, std::size_t largest);

} // namespace tamp
