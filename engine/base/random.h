// Counter-based random streams: draw number i of stream s under key k is a pure function of (k, s, i).
#pragma once

#include <cstdint>
#include <string_view>

namespace tamp {

/// One independent stream of uniform draws. Philox4x64-10 (Salmon et al., SC'11) keyed by the first 128 bits of
/// SHA-256(key); the stream number is part of the counter, so streams of one job never overlap.
class RandomStream {
public:
  RandomStream(std::string_view key, std::uint64_t stream);

  /// 64 uniform bits at a given counter.
  [[nodiscard]] std::uint64_t bits_at(std::uint64_t i) const;
  /// Uniform in [0, 1) with 53 random bits at a given counter.
  [[nodiscard]] double uniform_at(std::uint64_t i) const { return to_unit(bits_at(i)); }

  /// The next draws in sequence.
  std::uint64_t bits();
  double uniform() { return to_unit(bits()); }
  /// Unbiased integer in [0, n), n > 0 (Lemire, ACM TOMACS 29, 2019).
  std::uint64_t below(std::uint64_t n);

  [[nodiscard]] std::uint64_t position() const { return next_; }

private:
  static double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1.0p-53; }

  static constexpr int kWords = 4; // words of one Philox block
  std::uint64_t key_[2] = {};
  std::uint64_t stream_;
  std::uint64_t next_ = 0;
  std::uint64_t block_[kWords] = {};
  std::uint64_t block_index_ = ~std::uint64_t{0};
};

} // namespace tamp
