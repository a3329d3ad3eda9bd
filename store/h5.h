// Owned HDF5 handles, and HDF5's failures as errors that name the file.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>

namespace tamp {

/// Owns an identifier of any kind and lets go of it at the end.
class H5Handle {
public:
  H5Handle() = default;
  explicit H5Handle(hid_t id) : id_(id) {}
  H5Handle(H5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  H5Handle& operator=(H5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~H5Handle() {
    if (id_ >= 0)
      H5Idec_ref(id_); // closes what the identifier stands for, whatever its kind
  }

  operator hid_t() const { return id_; } // NOLINT(google-explicit-constructor): it is passed to the C functions

  /// Lets go now; negative on failure, as of a file whose last bytes cannot be written.
  herr_t close() { return id_ < 0 ? 0 : H5Idec_ref(std::exchange(id_, -1)); }

private:
  hid_t id_ = -1;
};

/// The work on one file: calls are checked, failures become an Error "cannot WHAT FILE: what; HDF5: why". While it
/// lives HDF5 prints nothing, and no other thread is inside HDF5, which Debian builds without thread safety.
class H5Session {
public:
  H5Session(std::string what, const std::filesystem::path& path);
  ~H5Session();
  H5Session(const H5Session&) = delete;
  H5Session& operator=(const H5Session&) = delete;

  /// The identifier, or the error that `doing` failed.
  H5Handle handle(hid_t id, const char* doing) const {
    if (id < 0)
      fail_with_reason(doing);
    return H5Handle(id);
  }
  /// For calls that answer with a negative number on failure.
  template <class T>
  T check(T result, const char* doing) const {
    if (result < 0)
      fail_with_reason(doing);
    return result;
  }
  /// Throws the Error "cannot WHAT FILE: problem".
  [[noreturn]] void fail(const std::string& problem) const;

private:
  [[noreturn]] void fail_with_reason(const char* doing) const;

  std::string what_;
  std::string path_;
  H5E_auto2_t printer_ = nullptr;
  void* printer_data_ = nullptr;
};

} // namespace tamp
