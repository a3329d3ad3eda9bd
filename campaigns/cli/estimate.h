// Guesses the remaining time of a run from the jobs that have ended.
#pragma once

#include "engine/schedule/agenda.h"

#include <map>
#include <optional>
#include <string>

namespace tamp::cli {

/// Jobs of one kind (a method under its label, a metric) are taken to last alike.
class Estimate {
public:
  /// The agenda must outlive the estimate.
  Estimate(const Agenda& agenda, int cores);

  /// An open item has ended.
  void finished(const Item& item, double wall_s);
  /// An item that is not open lasted so long in an earlier run.
  void known(const Item& item, double wall_s);
  /// An open item will not run.
  void barred(const Item& item);

  /// Seconds until the last job ends if each remaining one lasts the mean of its kind (of all, if none of its kind is
  /// known); nothing while that of the generations still to run is unknown.
  [[nodiscard]] std::optional<double> remaining_s() const;

private:
  struct Group {
    std::size_t ended = 0;
    double wall_s = 0; ///< of the ended ones
    std::size_t left = 0;
    double share = 1; ///< of the machine that one such job takes
    bool generation = false;
  };
  Group& group_of(const Item& item);

  const Agenda& agenda_;
  std::map<std::string, Group> groups_;
};

/// "45 s", "12 min", "3 h 20 min".
std::string in_words(double seconds);

} // namespace tamp::cli
