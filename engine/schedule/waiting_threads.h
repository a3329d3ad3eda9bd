// Threads that mostly wait — for child processes — so that TBB's own threads stay free for work.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <queue>
#include <thread>
#include <vector>

namespace tamp {

/// A queue served by a fixed number of threads. The destructor lets what was submitted finish.
class WaitingThreads {
public:
  explicit WaitingThreads(int count);
  ~WaitingThreads();
  WaitingThreads(const WaitingThreads&) = delete;
  WaitingThreads& operator=(const WaitingThreads&) = delete;

  /// Runs `work` in one of the threads; it must not throw. Any thread may call.
  void submit(std::function<void()> work);

private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<std::function<void()>> queue_; // guarded by mutex_
  bool closing_ = false;                    // guarded by mutex_
  std::vector<std::jthread> threads_;
};

} // namespace tamp
