// Hands out ready jobs as far as cores and memory go.
#include "engine/schedule/dispatcher.h"

namespace tamp {

Dispatcher::Dispatcher(const Agenda& agenda, const Resources& resources)
    : agenda_(agenda), tokens_(resources), followers_(agenda.items.size()) {
  for (std::size_t i = 0; i < agenda.items.size(); ++i) {
    const Item& item = agenda.items[i];
    if (item.standing != Standing::open)
      continue;
    const bool waits = item.after && agenda.items[*item.after].standing == Standing::open;
    if (waits)
      followers_[*item.after].push_back(i);
    else
      make_ready(i);
  }
}

Share Dispatcher::share(const Item& item) const {
  if (item.kind == JobKind::metric)
    return {.cores = 1, .memory_bytes = 0}; // a packing in memory is small beside what its generation was granted
  const RunSettings& run = agenda_.task(item).run;
  const bool exclusive = run.timing == TimingMode::exclusive;
  return {.cores = exclusive ? tokens_.all().cores : 1, .memory_bytes = memory_bytes(run)};
}

void Dispatcher::make_ready(std::size_t item) {
  if (agenda_.items[item].kind == JobKind::metric)
    metrics_.push_back(item);
  else
    generations_.insert(item);
}

std::vector<std::size_t> Dispatcher::start() {
  std::vector<std::size_t> started;
  while (!metrics_.empty() && tokens_.try_take(share(agenda_.items[metrics_.front()]))) {
    started.push_back(metrics_.front());
    metrics_.pop_front();
  }
  // Nothing overtakes the first one that does not fit, or an exclusive job would wait for ever.
  while (!generations_.empty() && tokens_.try_take(share(agenda_.items[*generations_.begin()]))) {
    started.push_back(*generations_.begin());
    generations_.erase(generations_.begin());
  }
  return started;
}

std::vector<std::size_t> Dispatcher::finish(std::size_t item, bool usable) {
  tokens_.give_back(share(agenda_.items[item]));
  if (usable) {
    for (const std::size_t follower : followers_[item])
      make_ready(follower);
    return {};
  }
  std::vector<std::size_t> barred = followers_[item];
  for (std::size_t b = 0; b < barred.size(); ++b) { // grows by those that wait for the barred ones
    const std::vector<std::size_t>& further = followers_[barred[b]];
    barred.insert(barred.end(), further.begin(), further.end());
  }
  return barred;
}

} // namespace tamp
