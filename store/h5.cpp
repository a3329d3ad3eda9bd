// The error stack and the lock of HDF5.
#include "store/h5.h"

#include "engine/base/error.h"

#include <fmt/format.h>

#include <mutex>

namespace tamp {
namespace {

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Keeps the text of the innermost entry of the error stack, which says what really went wrong.
herr_t keep_innermost(unsigned, const H5E_error2_t* entry, void* text) {
  if (entry->desc != nullptr)
    *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

} // namespace

H5Session::H5Session(std::string what, const std::filesystem::path& path)
    : what_(std::move(what)), path_(path.string()) {
  library_mutex().lock();
  // Every file is closed by its owner. HDF5's own cleaning up at exit would complain about what damaged files left.
  [[maybe_unused]] static const herr_t no_cleaning_up = H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

H5Session::~H5Session() {
  H5Eclear2(H5E_DEFAULT);
  H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_);
  library_mutex().unlock();
}

void H5Session::fail(const std::string& problem) const {
  throw Error(fmt::format("cannot {} {}: {}", what_, path_, problem));
}

void H5Session::fail_with_reason(const char* doing) const {
  std::string reason = "no reason given";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &reason);
  fail(fmt::format("{} failed; HDF5: {}", doing, reason));
}

} // namespace tamp
