// Writes by temporary name, sync and rename; finds what a killed writer left behind.
#include "engine/base/files.h"

#include "engine/base/file_system.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <optional>

namespace tamp {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_suffix = ".tamp-tmp";
constexpr std::size_t longest_stem = 120; // A file name may have 255 bytes; host and numbers need the rest.
constexpr std::size_t longest_host = 64;
constexpr auto foreign_age = std::chrono::hours(24);

FileDescriptor open_file(const fs::path& path, int flags) {
  FileDescriptor fd(file_system().open(path.c_str(), flags, 0666));
  if (!fd)
    throw system_error("cannot open " + path.string(), errno);
  return fd;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void sync(const FileDescriptor& fd, const fs::path& path) {
  int status = 0;
  do
    status = file_system().fsync(fd.get());
  while (status != 0 && errno == EINTR);
  if (status != 0)
    throw system_error("cannot sync " + path.string(), errno);
}

/// Renames the synced temporary, then syncs the folder, as the new name is part of the folder's own data.
void rename_durably(const fs::path& temporary, const fs::path& final_path) {
  const fs::path folder = folder_of(final_path);
  const FileDescriptor fd =
      open_file(folder, O_RDONLY | O_DIRECTORY); // First, so that a failure still changes nothing.
  if (file_system().rename(temporary.c_str(), final_path.c_str()) != 0)
    throw system_error("cannot rename " + temporary.string() + " to " + final_path.string(), errno);
  sync(fd, folder);
}

void write_all(const FileDescriptor& fd, std::string_view bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const auto count = file_system().write(fd.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      throw system_error("cannot write " + path.string(), errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Removes a temporary at the end of a scope; after a successful rename there is nothing left under its name.
class RemovedAtEnd {
public:
  explicit RemovedAtEnd(const fs::path& path) : path_(path) {}
  ~RemovedAtEnd() { ::unlink(path_.c_str()); }
  RemovedAtEnd(const RemovedAtEnd&) = delete;
  RemovedAtEnd& operator=(const RemovedAtEnd&) = delete;

private:
  const fs::path& path_;
};

/// The host's name as a part of a file name, without the dots that separate the parts.
std::string host_part() {
  std::array<char, longest_host + 1> name{};
  if (::gethostname(name.data(), longest_host) != 0)
    return "host";
  std::string part(name.data());
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; };
  std::replace_if(
      part.begin(), part.end(), [&](char c) { return !is_plain(static_cast<unsigned char>(c)); }, '-');
  return part;
}

/// Field 22 of /proc/PID/stat: when the process started, in ticks since boot; empty if it does not run.
std::string start_of_process(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  std::string text;
  if (!std::getline(file, text, '\0'))
    return {};
  // Field 2 is the program's name in brackets and may hold anything, so count from the last bracket: field 3 follows.
  const auto bracket = text.rfind(')');
  if (bracket == std::string::npos)
    return {};
  auto begin = bracket + 2;
  if (text.compare(begin, 1, "Z") == 0 || text.compare(begin, 1, "X") == 0)
    return {}; // Dead, though not yet reaped.
  for (int field = 3; field < 22 && begin != std::string::npos; ++field)
    begin = text.find_first_not_of(' ', text.find(' ', begin));
  return begin == std::string::npos ? std::string() : text.substr(begin, text.find(' ', begin) - begin);
}

struct Maker {
  std::string host, pid, start;
};

/// Who made a file of this name, or nothing if it is not the name of a temporary.
std::optional<Maker> maker_of(std::string name) {
  if (name.size() <= temporary_suffix.size() || name.front() != '.' || !name.ends_with(temporary_suffix))
    return {};
  name.resize(name.size() - temporary_suffix.size());
  std::array<std::string, 4> parts; // Count, start, pid, host: from the end, as the name in front may hold dots.
  for (auto& part : parts) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos || dot + 1 == name.size())
      return {};
    part = name.substr(dot + 1);
    name.resize(dot);
  }
  const auto is_number = [](const std::string& text) { return text.find_first_not_of("0123456789") == text.npos; };
  if (!is_number(parts[0]) || !is_number(parts[1]) || !is_number(parts[2]))
    return {};
  return Maker{parts[3], parts[2], parts[1]};
}

bool is_stale(const fs::directory_entry& entry, const std::string& host) {
  const auto maker = maker_of(entry.path().filename().string());
  if (!maker)
    return false;
  if (maker->host == host)
    return start_of_process(maker->pid) != maker->start;
  std::error_code error;
  const auto written = entry.last_write_time(error);
  return !error && fs::file_time_type::clock::now() - written > foreign_age;
}

} // namespace

void write_atomically(const fs::path& path, std::string_view bytes) {
  const fs::path temporary = temporary_name(path);
  FileDescriptor fd = open_file(temporary, O_WRONLY | O_CREAT | O_EXCL);
  const RemovedAtEnd removed(temporary);
  write_all(fd, bytes, temporary);
  sync(fd, temporary);
  fd.reset();
  rename_durably(temporary, path);
}

void publish(const fs::path& temporary, const fs::path& final_path) {
  FileDescriptor fd = open_file(temporary, O_RDONLY);
  const RemovedAtEnd removed(temporary);
  sync(fd, temporary);
  fd.reset();
  rename_durably(temporary, final_path);
}

std::string read_file(const fs::path& path) {
  const FileDescriptor fd = open_file(path, O_RDONLY);
  struct stat facts {};
  std::string bytes;
  if (::fstat(fd.get(), &facts) == 0 && facts.st_size > 0)
    bytes.reserve(static_cast<std::size_t>(facts.st_size));
  std::array<char, 65536> block;
  for (;;) {
    const auto count = ::read(fd.get(), block.data(), block.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      throw system_error("cannot read " + path.string(), errno);
    if (count == 0)
      return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

fs::path temporary_name(const fs::path& path) {
  static std::atomic<std::uint64_t> count{0};
  // Asked anew each time, as a fork changes the answers.
  const std::string pid = std::to_string(::getpid());
  const std::string name = '.' + path.filename().string().substr(0, longest_stem) + '.' + host_part() + '.' + pid +
                           '.' + start_of_process(pid) + '.' + std::to_string(count++) + std::string(temporary_suffix);
  return path.parent_path() / name;
}

std::vector<fs::path> stale_temporaries(const fs::path& folder) {
  std::vector<fs::path> stale;
  std::error_code error;
  const std::string host = host_part();
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_stale(*entry, host))
      stale.push_back(entry->path());
  if (error && error != std::errc::no_such_file_or_directory)
    throw system_error("cannot list " + folder.string(), error.value());
  std::sort(stale.begin(), stale.end());
  return stale;
}

std::size_t remove_stale_temporaries(const fs::path& folder) {
  std::size_t removed = 0;
  for (const auto& path : stale_temporaries(folder))
    removed += ::unlink(path.c_str()) == 0;
  return removed;
}

} // namespace tamp
