// Writes a large file piece by piece through the one door: under its name there is the whole file or nothing.
#pragma once

#include "engine/base/system.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <utility>

namespace tamp {

/// Collects pieces under a temporary name. Without finish() nothing remains. Methods throw Error naming the file.
class FileWriter {
public:
  explicit FileWriter(const std::filesystem::path& path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  void write(std::string_view bytes);

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(fmt::appender(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() >= kFull)
      flush();
  }

  /// Makes the file real (see publish).
  void finish();

private:
  static constexpr std::size_t kFull = std::size_t{1} << 18U;
  void flush();

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  FileDescriptor file_;
  fmt::memory_buffer buffer_;
};

} // namespace tamp
