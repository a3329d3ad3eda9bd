// Decides which jobs start next: the rules of the run, without a thread in sight.
#pragma once

#include "engine/schedule/agenda.h"
#include "engine/schedule/resources.h"

#include <deque>
#include <set>
#include <vector>

namespace tamp {

/// Keeps what is ready and what is free. Used by one thread at a time.
class Dispatcher {
public:
  /// The agenda must outlive the dispatcher.
  Dispatcher(const Agenda& agenda, const Resources& resources);

  /// Indices of the items to start now; their tokens are taken. An item is handed out once.
  std::vector<std::size_t> start();

  /// A started item has ended, with a packing or record if `usable`: its tokens come back, those that waited for it
  /// become ready or are barred. Returns the barred ones.
  std::vector<std::size_t> finish(std::size_t item, bool usable);

private:
  [[nodiscard]] Share share(const Item& item) const;
  void make_ready(std::size_t item);

  const Agenda& agenda_;
  Tokens tokens_;
  std::vector<std::vector<std::size_t>> followers_; ///< open items that wait for an item
  std::deque<std::size_t> metrics_;                 ///< ready, first come first served
  std::set<std::size_t> generations_;               ///< ready, in the order of the agenda
};

} // namespace tamp
