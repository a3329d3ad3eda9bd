// Stores with damaged packings and damaged database pages, and stores that cannot be written to.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>
#include <sys/mount.h>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

constexpr std::size_t kPage = 4096;

/// Overwrites bytes of a file.
void scribble(const fs::path& file, std::size_t at, std::size_t count) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(at));
  stream << std::string(count, 'x');
}

} // namespace

TEST_CASE("fsck finds damaged, missing and strange packings, and the next run makes them again") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 4, R"(, "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const Said sound = shop.tamp("fsck");
  CHECK(sound.code == 0);
  CHECK_THAT(sound.out, Contains("packings: 4 intact, 0 damaged, 0 missing, 0 not of any record"));

  const fs::path packings = shop.folder() / "tamp-store" / "packings";
  const auto before = digests(packings);
  auto file = before.begin();
  fs::resize_file(packings / (file++)->first, 500); // as after a crash of a machine without a sync
  scribble(packings / (file++)->first, 3000, 8);
  fs::remove(packings / (file++)->first);
  fs::create_directories(packings / "zz");
  std::ofstream(packings / "zz" / "stranger.h5") << "?";

  const Said looked = shop.tamp("fsck --dry-run");
  CHECK(looked.code == 1);
  CHECK_THAT(looked.out, Contains("packings: 1 intact, 2 damaged, 1 missing, 1 not of any record"));
  CHECK_FALSE(fs::exists(shop.folder() / "tamp-store" / "quarantine"));
  const Said moved = shop.tamp("fsck");
  CHECK(moved.code == 1);
  CHECK_THAT(moved.out, Contains("2 damaged") && Contains("tamp-store/quarantine: 3"));
  CHECK(digests(shop.folder() / "tamp-store" / "quarantine").size() == 3);
  CHECK(shop.tamp("run discs.json").code == 0);
  CHECK(digests(packings) == before);
  CHECK(shop.tamp("fsck").code == 0);
}

TEST_CASE("of a damaged database fsck keeps every record that can be read") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(12, 60, R"(, "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const auto before = shop.results("tamp-store");
  const auto packings = digests(shop.folder() / "tamp-store" / "packings");
  const fs::path file = shop.folder() / "tamp-store" / "tamp.sqlite";
  const std::size_t pages = fs::file_size(file) / kPage;
  REQUIRE(pages > 30);

  std::size_t page = 0; // counted from nought
  SECTION("a page in the middle") {
    page = pages / 2;
  }
  SECTION("a page near the end") {
    page = pages - 2;
  }
  SECTION("the first page, without which nothing can be read") {
    page = 0;
  }
  scribble(file, page * kPage, kPage);
  CAPTURE(pages, page);

  const Said looked = shop.tamp("fsck --dry-run");
  CAPTURE(looked.out, looked.err);
  CHECK(looked.code == 1);
  CHECK_THAT(looked.out, Contains("the database is damaged"));
  const Said mended = shop.tamp("fsck");
  CAPTURE(mended.out, mended.err);
  CHECK(mended.code == 1);
  CHECK_THAT(mended.out, Contains("records read from the damaged one"));
  CHECK(fs::exists(shop.folder() / "tamp-store" / "quarantine" / "tamp.sqlite"));
  CHECK(shop.tamp("fsck").code == 0);

  const Said again = shop.tamp("run discs.json");
  CAPTURE(again.out, again.err);
  CHECK(again.code == 0);
  if (page > 0) // one page holds a few of the sixty
    CHECK_THAT(again.out, Contains("recorded before") || Contains("nothing to do"));
  CHECK(without_times(shop.results("tamp-store")) == without_times(before));
  CHECK(digests(shop.folder() / "tamp-store" / "packings") == packings);
}

TEST_CASE("a store on a read-only disk can be read, and whoever would write is told so") {
  const Workshop shop(TAMP_BINARY);
  const fs::path disk = shop.folder() / "disk";
  fs::create_directory(disk);
  if (::mount("tamp-fsck", disk.c_str(), "tmpfs", 0, "size=32m") != 0) {
    WARN("skipped: no tmpfs can be mounted");
    return;
  }
  shop.write("discs.json", disc_campaign(20, 2));
  CHECK(shop.tamp("run discs.json --store disk/store").code == 0);
  const auto before = shop.results("disk/store");
  REQUIRE(::mount(nullptr, disk.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) == 0);
  CHECK(shop.results("disk/store") == before);
  CHECK(shop.tamp("status --store disk/store").code == 0);
  CHECK(shop.tamp("fsck --dry-run --store disk/store").code == 0);
  for (const char* command : {"run discs.json", "fsck", "submit discs.json"}) {
    const Said said = shop.tamp(std::string(command) + " --store disk/store");
    CAPTURE(command, said.err);
    CHECK(said.code == 1);
    CHECK_THAT(said.err, Contains("disk/store") && (Contains("Read-only file system") || Contains("readonly")));
  }
  ::umount2(disk.c_str(), MNT_DETACH);
}
