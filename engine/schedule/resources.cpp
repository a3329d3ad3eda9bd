// Asks the machine what a run may use.
#include "engine/schedule/resources.h"

#include "engine/base/host.h"

namespace tamp {

Resources machine_resources() {
  const std::vector<int> cores = usable_cores();
  return {
      .cores = static_cast<int>(cores.size()), .memory_bytes = host_facts().memory_bytes, .pinned_core = cores.back()};
}

} // namespace tamp
