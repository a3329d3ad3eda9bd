// Joins the facts of the build and of the host.
#include "campaigns/cli/provenance.h"

#include "engine/base/host.h"
#include "tamp_build_info.h"

#include <fmt/format.h>
#include <unistd.h>

namespace tamp::cli {

Provenance this_program() {
  const HostFacts host = host_facts();
  Provenance p;
  p.commit = build_info::source_commit;
  p.dirty = build_info::source_dirty;
  p.compiler = build_info::compiler;
  p.flags = fmt::format("{}: {}", build_info::build_type, build_info::flags);
  for (const build_info::Library& library : build_info::libraries)
    p.libraries.emplace(library.name, library.version);
  p.host = host.name;
  p.boot_id = host.boot_id;
  p.pid = ::getpid();
  p.cpu_model = host.cpu_model;
  p.kernel = host.kernel;
  p.hardware_threads = host.hardware_threads;
  return p;
}

} // namespace tamp::cli
