// Contact forces and weight on every sphere: the one loop over near pairs and walls, for any contact law.
#pragma once

#include "engine/base/parallel.h"
#include "engine/contact/contact_law.h"
#include "engine/contact/material.h"
#include "engine/dem/near_list.h"
#include "engine/dem/state.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tamp {

/// What a look at all contacts tells.
struct ContactSummary {
  double overlap = 0;  ///< largest, relative to the smaller radius (at a wall: to the radius)
  double energy = 0;   ///< of all normal contacts
  double force = 0;    ///< sum of |F| of all contacts
  double contacts = 0; ///< their number
  void operator+=(const ContactSummary& other) {
    overlap = std::max(overlap, other.overlap);
    energy += other.energy;
    force += other.force;
    contacts += other.contacts;
  }
};

/// What loads the spheres beside their contacts: their weight ...
struct Weight {
  static constexpr bool presses = false;
};
/// ... or a pressure on their box, which asks for the virial of the contacts and for no weight.
struct Pressing {
  static constexpr bool presses = true;
};

/// Spheres in a box under a load. Every sum over the contacts of a sphere goes in the order of the near list, which
/// only depends on who touches whom: the same bits on any number of threads and whenever the list was built.
template <int D, class Law, class LoadKind = Weight>
class ForceField {
public:
  using History = typename Law::template History<D>;
  static constexpr bool remembers = !std::is_empty_v<History>;

  /// skin: margin of the near list, a length; it decides speed alone.
  ForceField(Law law, const SearchBox<D>& box, double skin) : law_(std::move(law)), box_(box), skin_(skin) {}

  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] const SearchBox<D>& box() const { return box_; }
  [[nodiscard]] const CandidateList<D>& near() const { return near_; }
  [[nodiscard]] std::uint64_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] const Memories<D, Law>& memories() const { return memories_; }

  /// Sets force (and torque) of every sphere at its present place; moves the memory of contacts by dt.
  void evaluate(State<D, Law>& state, double dt) {
    if (near_.stale(box_.size, state.centre))
      rebuild(state);
    if constexpr (LoadKind::presses)
      virials_.resize(near_.pairs().size());
    if (threads_for(state.count()) > 1)
      gather(state, dt);
    else
      scatter(state, dt);
  }

  /// Goes on in a periodic box of another size, to which the spheres have been taken along.
  void resize(const Vec<D>& size) { box_.size = size; }

  /// Σ f·d over the contacts of the last evaluate(): D times pressure times volume. Friction pulls across d.
  [[nodiscard]] double virial() const {
    static_assert(LoadKind::presses);
    return sum_by_sphere([&](std::size_t p) { return virials_[p]; });
  }

  /// Lists the near pairs anew; the memory of contacts that stay is kept.
  void rebuild(const State<D, Law>& state) {
    const std::vector<NearPair<D>> old_pairs(near_.pairs().begin(), near_.pairs().end());
    const std::vector<NearWall> old_walls(near_.walls().begin(), near_.walls().end());
    std::vector<double> hold(state.count());
    for (std::size_t i = 0; i < hold.size(); ++i)
      hold[i] = law_.normal.reach(state.radius[i]);
    near_.build(box_, state.centre, state.radius, hold, skin_);
    if constexpr (remembers) {
      memories_.of_pair = carried_over(old_pairs, memories_.of_pair, near_.pairs());
      memories_.of_wall = carried_over(old_walls, memories_.of_wall, near_.walls());
    }
    index_contacts(state.count());
    ++rebuilds_;
  }

  /// Goes on with another law of the same kind, such as a stiffer one; contacts keep their memory.
  void set_law(Law law, const State<D, Law>& state) {
    law_ = std::move(law);
    rebuild(state);
  }

  /// Sets what the contacts of a list remember, as after reading it from a file; pairs and walls in the list's order.
  void restore(const State<D, Law>& state, std::span<const NearPair<D>> pairs, std::span<const NearWall> walls,
               Memories<D, Law> memories) {
    rebuild(state);
    if constexpr (remembers) {
      memories_.of_pair = carried_over(pairs, memories.of_pair, near_.pairs());
      memories_.of_wall = carried_over(walls, memories.of_wall, near_.walls());
    }
  }

  /// For each sphere the sum of its contacts' stiffnesses, as Law::stiffness() has them.
  [[nodiscard]] std::vector<double> stiffness(const State<D, Law>& state, double gyration) const {
    std::vector<double> sums(state.count(), 0.0);
    const auto stiffness_of = [&](const Contact<D>& contact, History history) {
      return law_.template touches<D>(contact.overlap, contact.radius, history)
                 ? law_.stiffness(contact.overlap, contact.radius, gyration)
                 : 0.0;
    };
    for (std::size_t p = 0; p < near_.pairs().size(); ++p) {
      const NearPair<D>& pair = near_.pairs()[p];
      const double k = stiffness_of(contact_of(state, pair), memory_of_pair(p));
      sums[pair.i] += k;
      sums[pair.j] += k;
    }
    for (std::size_t w = 0; w < near_.walls().size(); ++w)
      sums[near_.walls()[w].i] += stiffness_of(contact_of(state, near_.walls()[w]), memory_of_wall(w));
    return sums;
  }

  /// Σ k d² of normal motion: what the contacts set against a stretch of the whole box.
  [[nodiscard]] double stretch_stiffness(const State<D, Law>& state) const {
    return sum_by_sphere([&](std::size_t p) {
      const Contact<D> contact = contact_of(state, near_.pairs()[p]);
      History history = memory_of_pair(p);
      if (!law_.template touches<D>(contact.overlap, contact.radius, history))
        return 0.0;
      const double distance = state.radius[near_.pairs()[p].i] + state.radius[near_.pairs()[p].j] - contact.overlap;
      return 2 * law_.normal.modulus * law_.normal.at(contact.overlap, contact.radius).contact_radius * distance *
             distance;
    });
  }

  [[nodiscard]] ContactSummary summary(const State<D, Law>& state) const {
    const auto look = [&](const Contact<D>& contact, double smaller, History history) {
      if (!law_.template touches<D>(contact.overlap, contact.radius, history))
        return ContactSummary{};
      return ContactSummary{contact.overlap / smaller, law_.normal.energy(contact.overlap, contact.radius),
                            std::abs(law_.normal.at(contact.overlap, contact.radius).force), 1};
    };
    const auto pairs = near_.pairs();
    const auto walls = near_.walls();
    ContactSummary all = parallel_sum<ContactSummary>(pairs.size(), [&](std::size_t p) {
      return look(contact_of(state, pairs[p]), std::min(state.radius[pairs[p].i], state.radius[pairs[p].j]),
                  memory_of_pair(p));
    });
    all += parallel_sum<ContactSummary>(walls.size(), [&](std::size_t w) {
      return look(contact_of(state, walls[w]), state.radius[walls[w].i], memory_of_wall(w));
    });
    return all;
  }

private:
  using Load = std::conditional_t<Law::turns, ForceAndTorques<D>, Vec<D>>;

  [[nodiscard]] Vec<D> apart(const State<D, Law>& s, const NearPair<D>& p) const {
    Vec<D> d = s.centre[p.i] - s.centre[p.j];
    for (int a = 0; a < D; ++a)
      d[a] -= p.image[static_cast<std::size_t>(a)] * box_.size[a];
    return d;
  }

  [[nodiscard]] Contact<D> contact_of(const State<D, Law>& s, const NearPair<D>& p) const {
    const Vec<D> d = apart(s, p);
    const double distance = d.norm();
    // Spheres whose centres coincide part upwards.
    return {distance > 0 ? Vec<D>(d / distance) : Vec<D>(Vec<D>::Unit(vertical<D>)),
            s.radius[p.i] + s.radius[p.j] - distance, effective(s.radius[p.i], s.radius[p.j]),
            effective(s.mass[p.i], s.mass[p.j]), s.velocity[p.i] - s.velocity[p.j]};
  }

  [[nodiscard]] Contact<D> contact_of(const State<D, Law>& s, const NearWall& w) const {
    const double x = s.centre[w.i][w.axis];
    const double height = w.side == 0 ? x : box_.size[w.axis] - x;
    const Vec<D> inwards = (w.side == 0 ? 1.0 : -1.0) * Vec<D>::Unit(w.axis);
    return {inwards, s.radius[w.i] - height, s.radius[w.i], s.mass[w.i], s.velocity[w.i]};
  }

  History memory_of_pair(std::size_t p) const {
    if constexpr (remembers)
      return memories_.of_pair[p];
    else
      return {};
  }
  History memory_of_wall(std::size_t w) const {
    if constexpr (remembers)
      return memories_.of_wall[w];
    else
      return {};
  }

  /// Calls f(history of pair p); what it leaves there is kept.
  template <class F>
  bool with_memory(std::vector<History>* memories, std::size_t p, F&& f) {
    if constexpr (remembers) {
      return f((*memories)[p]);
    } else {
      History none;
      return f(none);
    }
  }
  std::vector<History>* pair_memories() {
    if constexpr (remembers)
      return &memories_.of_pair;
    else
      return nullptr;
  }
  std::vector<History>* wall_memories() {
    if constexpr (remembers)
      return &memories_.of_wall;
    else
      return nullptr;
  }

  /// The load of a contact, if it is one.
  bool load_of(const Contact<D>& contact, [[maybe_unused]] const Turning<D>& turning, History& history,
               [[maybe_unused]] double dt, Load& load) const {
    if (!law_.template touches<D>(contact.overlap, contact.radius, history)) {
      history = {};
      return false;
    }
    if constexpr (Law::turns)
      load = law_.template force<D>(contact, turning, history, dt);
    else
      load = law_.template force<D>(contact);
    return true;
  }

  bool pair_load(const State<D, Law>& s, std::size_t p, double dt, Load& load) {
    const NearPair<D>& pair = near_.pairs()[p];
    if constexpr (LoadKind::presses)
      virials_[p] = 0;
    return with_memory(pair_memories(), p, [&](History& history) {
      if constexpr (!Law::holds_at_a_gap) { // most near pairs do not touch: no root for them
        const double sum = s.radius[pair.i] + s.radius[pair.j];
        if (apart(s, pair).squaredNorm() >= sum * sum) {
          history = {};
          return false;
        }
      }
      Turning<D> turning{};
      if constexpr (Law::turns)
        turning = {s.radius[pair.i], s.radius[pair.j], s.spin[pair.i], s.spin[pair.j]};
      const Contact<D> contact = contact_of(s, pair);
      const bool acts = load_of(contact, turning, history, dt, load);
      if constexpr (LoadKind::presses) {
        if (acts)
          virials_[p] = force_of(load).dot(contact.normal) * (s.radius[pair.i] + s.radius[pair.j] - contact.overlap);
      }
      return acts;
    });
  }

  bool wall_load(const State<D, Law>& s, std::size_t w, double dt, Load& load) {
    const NearWall& wall = near_.walls()[w];
    return with_memory(wall_memories(), w, [&](History& history) {
      Turning<D> turning{};
      if constexpr (Law::turns)
        turning = {s.radius[wall.i], 0, s.spin[wall.i], zero_spin<D>()};
      return load_of(contact_of(s, wall), turning, history, dt, load);
    });
  }

  static const Vec<D>& force_of(const Load& load) {
    if constexpr (Law::turns)
      return load.force;
    else
      return load;
  }

  void clear(State<D, Law>& s, std::size_t i) const {
    if constexpr (LoadKind::presses)
      s.force[i].setZero();
    else
      s.force[i] = -s.weight[i] * Vec<D>::Unit(vertical<D>);
    if constexpr (Law::turns)
      s.torque[i] = zero_spin<D>();
  }
  static void add_first(State<D, Law>& s, std::size_t i, const Load& load) {
    s.force[i] += force_of(load);
    if constexpr (Law::turns)
      s.torque[i] += load.torque_i;
  }
  static void add_second(State<D, Law>& s, std::size_t j, const Load& load) {
    s.force[j] -= force_of(load);
    if constexpr (Law::turns)
      s.torque[j] += load.torque_j;
  }

  /// One thread: each load is added to both spheres as it is found.
  void scatter(State<D, Law>& s, double dt) {
    for (std::size_t i = 0; i < s.count(); ++i)
      clear(s, i);
    Load load;
    for (std::size_t p = 0; p < near_.pairs().size(); ++p) {
      if (pair_load(s, p, dt, load)) {
        add_first(s, near_.pairs()[p].i, load);
        add_second(s, near_.pairs()[p].j, load);
      }
    }
    for (std::size_t w = 0; w < near_.walls().size(); ++w) {
      if (wall_load(s, w, dt, load))
        add_first(s, near_.walls()[w].i, load);
    }
  }

  /// Several threads: loads first, then each sphere adds its own, in the order in which scatter() would.
  void gather(State<D, Law>& s, double dt) {
    const std::size_t pairs = near_.pairs().size();
    loads_.resize(pairs + near_.walls().size());
    acts_.resize(loads_.size());
    parallel_for(loads_.size(), [&](std::size_t c) {
      acts_[c] = c < pairs ? pair_load(s, c, dt, loads_[c]) : wall_load(s, c - pairs, dt, loads_[c]);
    });
    parallel_for(s.count(), [&](std::size_t i) {
      clear(s, i);
      for (std::size_t k = first_contact_[i]; k < first_contact_[i + 1]; ++k) {
        const std::size_t c = contacts_of_[k];
        if (acts_[c] == 0)
          continue;
        if (c >= pairs || near_.pairs()[c].i == i)
          add_first(s, i, loads_[c]);
        else
          add_second(s, i, loads_[c]);
      }
    });
  }

  /// Σ f(pair), grouped by spheres: pairs that do not touch give 0, and so the list itself leaves no trace in the bits.
  template <class F>
  [[nodiscard]] double sum_by_sphere(F&& f) const {
    return parallel_sum<double>(first_contact_.empty() ? 0 : first_contact_.size() - 1, [&](std::size_t i) {
      double sum = 0;
      for (std::size_t p = first_pair_[i]; p < first_pair_[i + 1]; ++p)
        sum += f(p);
      return sum;
    });
  }

  /// For each sphere the contacts of the list that it takes part in, in the list's order.
  void index_contacts(std::size_t n) {
    first_contact_.assign(n + 1, 0);
    first_pair_.assign(n + 1, 0);
    for (const auto& pair : near_.pairs()) {
      ++first_pair_[pair.i + 1];
      ++first_contact_[pair.i + 1];
      ++first_contact_[pair.j + 1];
    }
    for (const auto& wall : near_.walls())
      ++first_contact_[wall.i + 1];
    for (std::size_t i = 0; i < n; ++i)
      first_contact_[i + 1] += first_contact_[i];
    std::partial_sum(first_pair_.begin(), first_pair_.end(), first_pair_.begin());
    contacts_of_.resize(first_contact_[n]);
    std::vector<std::uint32_t> next(first_contact_.begin(), first_contact_.end() - 1);
    std::uint32_t c = 0;
    for (const auto& pair : near_.pairs()) {
      contacts_of_[next[pair.i]++] = c;
      contacts_of_[next[pair.j]++] = c++;
    }
    for (const auto& wall : near_.walls())
      contacts_of_[next[wall.i]++] = c++;
  }

  /// The memories of those contacts of an ordered list that an old one had, too.
  template <class Old, class New>
  static std::vector<History> carried_over(const Old& before, const std::vector<History>& memories, const New& now) {
    std::vector<History> kept(now.size());
    std::size_t b = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      while (b < before.size() && before[b] < now[k])
        ++b;
      if (b < before.size() && before[b] == now[k])
        kept[k] = memories[b];
    }
    return kept;
  }

  Law law_;
  SearchBox<D> box_;
  double skin_;
  CandidateList<D> near_;
  [[no_unique_address]] Memories<D, Law> memories_;
  std::vector<std::uint32_t> first_pair_;    // of each sphere as the first of a pair
  std::vector<std::uint32_t> first_contact_; // of each sphere in contacts_of_
  std::vector<std::uint32_t> contacts_of_;   // pairs by number, then walls
  std::vector<double> virials_;              // of the pairs, under pressure
  std::vector<Load> loads_;
  std::vector<std::uint8_t> acts_;
  std::uint64_t rebuilds_ = 0;
};

} // namespace tamp
