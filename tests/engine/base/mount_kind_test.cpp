// File systems by their numbers.
#include "engine/base/mount_kind.h"

#include <catch2/catch.hpp>
#include <linux/magic.h>

using namespace tamp;

TEST_CASE("file systems of the network are known by their numbers, also by those that look negative") {
  CHECK(network_file_system(NFS_SUPER_MAGIC) == "NFS");
  CHECK(network_file_system(static_cast<long>(static_cast<int>(0xFF534D42U))) == "CIFS");
  CHECK(network_file_system(static_cast<long>(0xFE534D42L)) == "SMB2");
  for (const long local :
       {long{EXT4_SUPER_MAGIC}, long{TMPFS_MAGIC}, long{XFS_SUPER_MAGIC}, long{OVERLAYFS_SUPER_MAGIC}})
    CHECK(network_file_system(local).empty());
  CHECK(network_file_system(std::filesystem::path("/proc")).empty());
  CHECK(network_file_system(std::filesystem::path("/no such place")).empty());
}
