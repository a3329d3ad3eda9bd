// Philox4x64-10 draws behind RandomStream.
#include "engine/base/random.h"

#include "engine/base/sha256.h"

#include <Random123/philox.h>

#include <array>
#include <cstring>

namespace tamp {

namespace {

std::array<std::uint64_t, 4> philox_block(const std::uint64_t key[2], std::uint64_t stream, std::uint64_t block) {
  const r123::Philox4x64::ctr_type counter = {{block, stream, 0, 0}};
  const r123::Philox4x64::key_type philox_key = {{key[0], key[1]}};
  const auto out = r123::Philox4x64{}(counter, philox_key);
  return {out[0], out[1], out[2], out[3]};
}

} // namespace

RandomStream::RandomStream(std::string_view key, std::uint64_t stream) : stream_(stream) {
  const auto digest = sha256(key);
  std::memcpy(key_, digest.data(), sizeof key_);
}

std::uint64_t RandomStream::bits_at(std::uint64_t i) const {
  return philox_block(key_, stream_, i / kWords)[i % kWords];
}

std::uint64_t RandomStream::bits() {
  const std::uint64_t index = next_ / kWords;
  if (index != block_index_) {
    const auto fresh = philox_block(key_, stream_, index);
    std::memcpy(block_, fresh.data(), sizeof block_);
    block_index_ = index;
  }
  return block_[next_++ % kWords];
}

std::uint64_t RandomStream::below(std::uint64_t n) {
  __extension__ using Wide = unsigned __int128;
  const std::uint64_t reject_below = (0 - n) % n;
  for (;;) {
    const Wide product = static_cast<Wide>(bits()) * n;
    if (static_cast<std::uint64_t>(product) >= reject_below)
      return static_cast<std::uint64_t>(product >> 64U);
  }
}

} // namespace tamp
