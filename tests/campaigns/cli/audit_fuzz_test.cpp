// Whatever a damaged file still says, an audit ends, with findings or a message.
#include "campaigns/cli/audit.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "store/formats/format.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/engine/model/some_packing.h"
#include "tests/store/formats/damage.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace tamp;

TEST_CASE("audits of damaged files end with findings or an InputError") {
  const ScratchFolder folder;
  RandomStream random("fuzz audits", 0);
  int judged = 0;
  for (const char* name : {"csv", "lammps-dump"}) {
    const Format& format = format_named(name);
    std::vector<std::string> sources;
    for (const int dimension : {2, 3}) {
      format.write(folder / "p", test::some_packing(dimension, 12), {});
      sources.push_back(read_file(folder / "p"));
    }
    for (int i = 0; i < 150; ++i) {
      std::string bytes = sources[random.below(2)];
      for (std::uint64_t n = 1 + random.below(3); n > 0; --n)
        test::damage(bytes, random);
      std::ofstream(folder / "p", std::ios::binary | std::ios::trunc) << bytes;
      std::optional<ReadPacking> read;
      try {
        read = format.read(folder / "p", {});
      } catch (const InputError&) {
        continue;
      }
      INFO(bytes);
      try {
        const cli::Audit found = cli::audit("p", std::move(*read), std::nullopt, 1e-6);
        REQUIRE_FALSE(cli::audit_text(found).empty());
        REQUIRE_FALSE(cli::audit_json({found}).empty());
        ++judged;
      } catch (const InputError&) {
        ++judged;
      }
    }
  }
  CHECK(judged > 15);
}
