// The list of a report's files: what an earlier report left is removed, and nothing else.
#include "engine/base/files.h"
#include "report/manifest.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace tamp;

namespace {

void write_report_of(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const Manifest manifest(folder);
  manifest.announce(names);
  for (const std::string& name : names)
    write_atomically(folder / name, name);
  manifest.keep_only(names);
}

} // namespace

TEST_CASE("Files of an earlier report go, those of others stay") {
  const ScratchFolder scratch;
  const auto& folder = scratch.path();
  write_atomically(folder / "notes.txt", "mine");
  write_report_of(folder, {"a.csv", "b.csv"});
  write_report_of(folder, {"b.csv", "c.csv"});
  CHECK_FALSE(std::filesystem::exists(folder / "a.csv"));
  CHECK(std::filesystem::exists(folder / "b.csv"));
  CHECK(std::filesystem::exists(folder / "c.csv"));
  CHECK(std::filesystem::exists(folder / "notes.txt"));
}

TEST_CASE("A report that broke off leaves nothing behind either") {
  const ScratchFolder scratch;
  const auto& folder = scratch.path();
  Manifest(folder).announce(std::vector<std::string>{"half.csv", "never.csv"});
  write_atomically(folder / "half.csv", "");
  write_report_of(folder, {"whole.csv"});
  CHECK_FALSE(std::filesystem::exists(folder / "half.csv"));
  CHECK(read_file(folder / kManifestFile) == "whole.csv\n");
}

TEST_CASE("A list that leads out of the folder is not followed") {
  const ScratchFolder scratch;
  const auto folder = scratch.path() / "report";
  std::filesystem::create_directories(folder / "deep");
  write_atomically(scratch.path() / "outside.csv", "");
  write_atomically(folder / "deep" / "inner.csv", "");
  write_atomically(folder / kManifestFile,
                   "../outside.csv\n" + (scratch.path() / "outside.csv").string() + "\ndeep/inner.csv\n..\n.\n\n");
  write_report_of(folder, {"a.csv"});
  CHECK(std::filesystem::exists(scratch.path() / "outside.csv"));
  CHECK(std::filesystem::exists(folder / "deep" / "inner.csv"));
}
