// A buffer, a temporary name, and the renaming at the end.
#include "engine/base/file_writer.h"

#include "engine/base/file_system.h"
#include "engine/base/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace tamp {

FileWriter::FileWriter(const std::filesystem::path& path)
    : path_(path), temporary_(temporary_name(path)),
      file_(file_system().open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666)) {
  if (!file_)
    throw system_error("cannot write " + path_.string(), errno);
}

FileWriter::~FileWriter() {
  ::unlink(temporary_.c_str()); // after finish() there is nothing left under this name
}

void FileWriter::write(std::string_view bytes) {
  buffer_.append(bytes.data(), bytes.data() + bytes.size());
  if (buffer_.size() >= kFull)
    flush();
}

void FileWriter::flush() {
  std::string_view rest(buffer_.data(), buffer_.size());
  while (!rest.empty()) {
    const auto count = file_system().write(file_.get(), rest.data(), rest.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      throw system_error("cannot write " + path_.string(), errno);
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  buffer_.clear();
}

void FileWriter::finish() {
  flush();
  file_.reset();
  publish(temporary_, path_);
}

} // namespace tamp
