// Claims on keys, by which processes that work in one folder share out the jobs; the kernel frees those of the dead.
#pragma once

#include "engine/base/system.h"

#include <filesystem>
#include <string_view>

namespace tamp {

/// Locks on single bytes of one file (open file description locks): a key claims the byte at the number that its first
/// 15 digits are. Two keys that agree in those exclude each other, which costs time alone. Claims end with the object,
/// or with the process by whatever cause. Any thread may call. All functions throw Error if the file system fails.
class Claims {
public:
  /// The file is made if it is not there, and stays empty.
  explicit Claims(const std::filesystem::path& file);

  /// Claims a key (at least 15 hexadecimal digits in front); false if another process, or another object, has it.
  bool take(std::string_view key);
  void give_back(std::string_view key);

  /// Beside the keys: any number of processes may be here together, or one alone. False if that cannot be just now.
  bool be_here();
  bool be_alone();
  void go();

private:
  bool lock(short type, off_t byte);

  std::filesystem::path file_;
  FileDescriptor fd_;
};

} // namespace tamp
