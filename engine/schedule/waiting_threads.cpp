// A small pool of threads for waiting.
#include "engine/schedule/waiting_threads.h"

#include <utility>

namespace tamp {

WaitingThreads::WaitingThreads(int count) {
  threads_.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    threads_.emplace_back([this] { serve(); });
}

WaitingThreads::~WaitingThreads() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
}

void WaitingThreads::submit(std::function<void()> work) {
  {
    const std::scoped_lock lock(mutex_);
    queue_.push(std::move(work));
  }
  changed_.notify_one();
}

void WaitingThreads::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !queue_.empty(); });
    if (queue_.empty())
      return;
    const std::function<void()> work = std::move(queue_.front());
    queue_.pop();
    lock.unlock();
    work();
    lock.lock();
  }
}

} // namespace tamp
