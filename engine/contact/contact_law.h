// A contact law put together from its effects: each effect is a type, an absent effect an empty one that costs nothing.
#pragma once

#include "engine/contact/damping.h"
#include "engine/contact/dmt.h"
#include "engine/contact/friction.h"
#include "engine/contact/hertz.h"
#include "engine/contact/jkr.h"
#include "engine/contact/rolling.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace tamp {

/// Two bodies at a contact. A wall is a body j of arm 0 that does not turn, with the radius and mass of i as effective.
template <int D>
struct Contact {
  Vec<D> normal;   ///< unit vector from j to i
  double overlap;  ///< δ
  double radius;   ///< effective radius R
  double mass;     ///< effective mass m
  Vec<D> velocity; ///< v_i − v_j, of the centres
};

/// What only laws with friction ask for.
template <int D>
struct Turning {
  double radius_i;
  double radius_j; ///< 0: a wall
  Spin<D> spin_i;  ///< ω_i
  Spin<D> spin_j;
};

/// Force on i (its reverse acts on j), and the torques about the centres.
template <int D>
struct ForceAndTorques {
  Vec<D> force;
  Spin<D> torque_i;
  Spin<D> torque_j;
};

/// Normal: Hertz, Dmt or Jkr. Damping: NoDamping or TsujiDamping. Friction: NoFriction or Mindlin. Rolling: NoRolling
/// or RollingSpring, which needs friction: nothing else makes spheres turn.
template <class Normal, class Damping = NoDamping, class Friction = NoFriction, class Rolling = NoRolling>
struct ContactLaw {
  static_assert(Friction::turns || !Rolling::resists);

  Normal normal;
  [[no_unique_address]] Damping damping = {};
  [[no_unique_address]] Friction friction = {};
  [[no_unique_address]] Rolling rolling = {};

  static constexpr bool turns = Friction::turns;
  /// Whether a contact may outlast touching, by a neck.
  static constexpr bool holds_at_a_gap = !std::is_empty_v<typename Normal::Memory>;

  /// What a contact remembers from step to step; an empty type if no effect needs any memory.
  template <int D>
  struct History : Normal::Memory, Friction::template Memory<D>, Rolling::template Memory<D> {};

  /// Whether a pair is in contact at this overlap (negative: a gap), given its history, which learns of the answer.
  template <int D>
  bool touches(double overlap, double radius, History<D>& history) const {
    if constexpr (!holds_at_a_gap) {
      return overlap > 0;
    } else {
      history.touching = history.touching ? overlap > -normal.reach(radius) : overlap > 0;
      return history.touching;
    }
  }

  /// Of a contact, against what moves its bodies most: normal motion, dF/dδ = 2 E* a of Hertz, or sliding, in which
  /// turning helps. gyration: moment of inertia divided by m r².
  [[nodiscard]] double stiffness(double overlap, double radius, [[maybe_unused]] double gyration) const {
    const double a = normal.at(overlap, radius).contact_radius;
    double k = 2 * normal.modulus * a;
    if constexpr (turns)
      k = std::max(k, 8 * friction.shear_modulus * a * (1 + 1 / gyration));
    return k;
  }

  /// Force along the normal alone; for laws without friction that is all.
  template <int D>
  Vec<D> force(const Contact<D>& c) const {
    static_assert(!turns);
    return normal_part(c).total * c.normal;
  }

  /// Force and torques; moves the history by dt. Call once a step, with the velocities of half a step ago.
  template <int D>
  ForceAndTorques<D> force(const Contact<D>& c, const Turning<D>& t, History<D>& history, double dt) const {
    static_assert(turns);
    const Part part = normal_part(c);
    // Adhesion adds to the weight that friction bears: Thornton, J. Phys. D 24, 1942, 1991; LAMMPS for `jkr` and `dmt`.
    const double critical = std::abs(Normal::adheres ? part.elastic.force + 2 * normal.pull_off(c.radius) : part.total);
    const Vec<D> turning = cross(Spin<D>(t.radius_i * t.spin_i + t.radius_j * t.spin_j), c.normal);
    const Vec<D> sliding = c.velocity - c.velocity.dot(c.normal) * c.normal - turning;
    const Vec<D> tangential =
        friction.template force<D>(history, c.normal, sliding, part.elastic.contact_radius, part.damping, critical, dt);

    // The force acts in the middle of the overlap: what one sphere's spin loses, orbit and the other's spin gain.
    const Spin<D> moment = cross(c.normal, tangential);
    ForceAndTorques<D> result{part.total * c.normal + tangential, -(t.radius_i - 0.5 * c.overlap) * moment,
                              -(t.radius_j - 0.5 * c.overlap) * moment};
    if constexpr (Rolling::resists) {
      const Spin<D> torque = rolling.template torque<D>(history, c.normal, t.spin_i - t.spin_j, c.radius, critical, dt);
      result.torque_i += torque;
      result.torque_j -= torque;
    }
    return result;
  }

private:
  struct Part {
    NormalForce elastic;
    double damping; ///< η
    double total;
  };

  template <int D>
  [[nodiscard]] Part normal_part(const Contact<D>& c) const {
    const NormalForce elastic = normal.at(c.overlap, c.radius);
    if constexpr (Damping::damps) {
      const double eta = damping.coefficient(normal.modulus, elastic.contact_radius, c.mass);
      return {elastic, eta, elastic.force - eta * c.velocity.dot(c.normal)};
    } else {
      return {elastic, 0, elastic.force};
    }
  }
};

// Effects that are left out leave nothing behind.
static_assert(std::is_empty_v<ContactLaw<Hertz, TsujiDamping>::History<3>>);
static_assert(std::is_empty_v<ContactLaw<Dmt>::History<2>>);
static_assert(sizeof(ContactLaw<Hertz>) == sizeof(Hertz));

} // namespace tamp
