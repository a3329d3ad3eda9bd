// Two free bodies, or one against a wall, moved under a contact law by velocity Verlet.
#pragma once

#include "engine/contact/contact_law.h"
#include "engine/contact/material.h"

namespace tamp::test {

template <int D>
struct Body {
  Vec<D> position = Vec<D>::Zero();
  Vec<D> velocity = Vec<D>::Zero();
  Spin<D> spin = zero_spin<D>();
  double radius = 1;
  double mass = 1;
  bool may_turn = true;

  [[nodiscard]] double inertia() const { return gyration<D> * mass * radius * radius; }
};

template <int D>
struct Loads {
  Vec<D> force_i = Vec<D>::Zero();
  Spin<D> torque_i = zero_spin<D>();
  Spin<D> torque_j = zero_spin<D>();
  double overlap = 0;
};

template <int D>
void kick(Body<D>& body, const Vec<D>& force, const Spin<D>& torque, double dt) {
  body.velocity += dt / body.mass * force;
  if (body.may_turn)
    body.spin += dt / body.inertia() * torque;
}

template <int D, class Law>
Loads<D> evaluate(const Law& law, const Contact<D>& c, const Turning<D>& turning,
                  typename Law::template History<D>& history, double dt) {
  Loads<D> loads;
  loads.overlap = c.overlap;
  if (!law.template touches<D>(c.overlap, c.radius, history)) {
    history = {};
  } else if constexpr (Law::turns) {
    const ForceAndTorques<D> f = law.template force<D>(c, turning, history, dt);
    loads.force_i = f.force;
    loads.torque_i = f.torque_i;
    loads.torque_j = f.torque_j;
  } else {
    loads.force_i = law.template force<D>(c);
  }
  return loads;
}

/// Two free spheres, a step of dt at a time.
template <int D, class Law>
struct TwoBodies {
  Law law;
  Body<D> i;
  Body<D> j;
  double dt;
  typename Law::template History<D> history = {};
  Loads<D> loads = {};

  void step() {
    kick<D>(i, loads.force_i, loads.torque_i, dt / 2);
    kick<D>(j, -loads.force_i, loads.torque_j, dt / 2);
    i.position += dt * i.velocity;
    j.position += dt * j.velocity;
    const Vec<D> apart = i.position - j.position;
    const double distance = apart.norm();
    const Contact<D> contact{apart / distance, i.radius + j.radius - distance, effective(i.radius, j.radius),
                             effective(i.mass, j.mass), i.velocity - j.velocity};
    loads = evaluate<D>(law, contact, {i.radius, j.radius, i.spin, j.spin}, history, dt);
    kick<D>(i, loads.force_i, loads.torque_i, dt / 2);
    kick<D>(j, -loads.force_i, loads.torque_j, dt / 2);
  }
};

/// A sphere on the wall at height 0, under gravity that may lean.
template <int D, class Law>
struct OnWall {
  Law law;
  Body<D> i;
  Vec<D> gravity;
  double dt;
  typename Law::template History<D> history = {};
  Loads<D> loads = {};

  void step() {
    kick<D>(i, loads.force_i + i.mass * gravity, loads.torque_i, dt / 2);
    i.position += dt * i.velocity;
    const Contact<D> contact{Vec<D>::Unit(vertical<D>), i.radius - i.position[vertical<D>], i.radius, i.mass,
                             i.velocity};
    loads = evaluate<D>(law, contact, {i.radius, 0, i.spin, zero_spin<D>()}, history, dt);
    kick<D>(i, loads.force_i + i.mass * gravity, loads.torque_i, dt / 2);
  }
};

} // namespace tamp::test
