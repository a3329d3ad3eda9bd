// The only home of TBB algorithms: loops over index ranges whose results do not depend on the number of threads.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tamp {

/// Below this many elements a loop runs on the calling thread: starting tasks would cost more than it saves.
inline constexpr std::size_t kSerialThreshold = 4096;

/// Elements summed in one go by parallel_sum; fixed, so the grouping of a sum never depends on the machine.
inline constexpr std::size_t kSumBlock = 4096;

/// Threads that a loop over n elements would use: for choosing between two ways to the same result.
inline std::size_t threads_for(std::size_t n) {
  using oneapi::tbb::global_control;
  if (n < kSerialThreshold)
    return 1;
  return std::min(static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency()),
                  global_control::active_value(global_control::max_allowed_parallelism));
}

/// Calls f(i) for every i in [0, n). f must write only to places of its own i.
template <class F>
void parallel_for(std::size_t n, F&& f) {
  if (n < kSerialThreshold) {
    for (std::size_t i = 0; i < n; ++i)
      f(i);
    return;
  }
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n, kSerialThreshold / 4),
                            [&](const auto& range) {
                              for (std::size_t i = range.begin(); i != range.end(); ++i)
                                f(i);
                            });
}

/// Calls f(i) for every i in [0, n), each call being work enough for a task of its own. f must write only to places of
/// its own i.
template <class F>
void parallel_tasks(std::size_t n, F&& f) {
  if (n == 1)
    f(std::size_t{0});
  else
    oneapi::tbb::parallel_for(std::size_t{0}, n, f);
}

/// Sum of f(i) over [0, n): blocks of fixed size summed in order, then the block sums in order,
/// so the result has the same bits on any number of threads. T needs `T{}` and `+=`.
template <class T, class F>
T parallel_sum(std::size_t n, F&& f) {
  const std::size_t blocks = (n + kSumBlock - 1) / kSumBlock;
  std::vector<T> partial(blocks, T{});
  const auto sum_block = [&](std::size_t b) {
    T sum{};
    const std::size_t end = std::min(n, (b + 1) * kSumBlock);
    for (std::size_t i = b * kSumBlock; i < end; ++i)
      sum += f(i);
    partial[b] = sum;
  };
  if (blocks < 2) {
    for (std::size_t b = 0; b < blocks; ++b)
      sum_block(b);
  } else {
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, sum_block);
  }
  T total{};
  for (const T& part : partial)
    total += part;
  return total;
}

} // namespace tamp
