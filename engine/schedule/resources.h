// What jobs compete for — cores and memory — as tokens that are taken and given back.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tamp {

/// What the jobs of a run may use together.
struct Resources {
  int cores = 1;
  std::uint64_t memory_bytes = 0;
  int pinned_core = 0; ///< number of the core on which exclusive jobs run
};

/// All cores this process may use and all memory of the machine; exclusive jobs are pinned to the last of the cores,
/// as the first one serves most interrupts.
Resources machine_resources();

/// What one job takes while it runs.
struct Share {
  int cores = 1;
  std::uint64_t memory_bytes = 0;
};

/// The tokens of one run; used by one thread at a time.
class Tokens {
public:
  explicit Tokens(const Resources& all) : all_{all.cores, all.memory_bytes}, free_(all_) {}

  /// Takes the share if all of it is free. A share larger than everything there is counts as everything: such a job
  /// runs alone instead of never.
  bool try_take(Share share) {
    share = possible(share);
    if (share.cores > free_.cores || share.memory_bytes > free_.memory_bytes)
      return false;
    free_.cores -= share.cores;
    free_.memory_bytes -= share.memory_bytes;
    return true;
  }
  void give_back(Share share) {
    share = possible(share);
    free_.cores += share.cores;
    free_.memory_bytes += share.memory_bytes;
  }
  [[nodiscard]] Share all() const { return all_; }

private:
  [[nodiscard]] Share possible(Share share) const {
    return {std::min(share.cores, all_.cores), std::min(share.memory_bytes, all_.memory_bytes)};
  }

  Share all_;
  Share free_;
};

} // namespace tamp
