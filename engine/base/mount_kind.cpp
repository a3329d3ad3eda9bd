// The numbers are those of linux/magic.h and, of file systems outside the kernel, of their own sources.
#include "engine/base/mount_kind.h"

#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <utility>

namespace tamp {

namespace {

constexpr std::array<std::pair<unsigned, std::string_view>, 12> kNetwork = {{
    {0x6969U, "NFS"},
    {0x517BU, "SMB"},
    {0xFF534D42U, "CIFS"},
    {0xFE534D42U, "SMB2"},
    {0x0BD00BD0U, "Lustre"},
    {0x47504653U, "GPFS"},
    {0x19830326U, "BeeGFS"},
    {0x00C36400U, "Ceph"},
    {0x5346414FU, "AFS"},
    {0x01021997U, "9P"},
    {0xAAD7AAEAU, "PanFS"},
    {0x65735546U, "FUSE"}, // sshfs, GlusterFS and others; a local one loses only a little speed by this
}};

} // namespace

std::string_view network_file_system(long type) {
  const auto number = static_cast<unsigned>(type); // f_type is signed, and its width depends on the machine
  const auto* found =
      std::find_if(kNetwork.begin(), kNetwork.end(), [&](const auto& row) { return row.first == number; });
  return found == kNetwork.end() ? std::string_view() : found->second;
}

std::string_view network_file_system(const std::filesystem::path& path) {
  struct statfs facts {};
  return ::statfs(path.c_str(), &facts) == 0 ? network_file_system(static_cast<long>(facts.f_type))
                                             : std::string_view();
}

} // namespace tamp
