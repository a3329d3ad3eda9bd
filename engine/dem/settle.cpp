// The table from the effects that a bed calls for to the compiled kernel that settles it.
#include "engine/dem/settle.h"

#include "engine/base/error.h"
#include "engine/dem/relax.h"
#include "engine/dem/settle_run.h"

namespace tamp {

namespace {

/// Follows the motion in time, under damping.
template <int D, class Normal, class Friction>
Settled<D> integrate(const SettleTask<D>& task) {
  const ContactNumbers numbers{task.poisson, task.friction, task.restitution, task.adhesion};
  const auto make_law = [&](double modulus) { return contact_law<Normal, TsujiDamping, Friction>(numbers, modulus); };
  return SettleRun<D, ContactLaw<Normal, TsujiDamping, Friction>>(task, make_law).run();
}

template <int D>
struct Row {
  ContactEffects effects;
  bool minimise;
  Settled<D> (*kernel)(const SettleTask<D>&);
};

template <int D>
constexpr Row<D> kKernels[] = {
    {{AdhesionLaw::none, false}, true, &relax<D>},
    {{AdhesionLaw::none, false}, false, &integrate<D, Hertz, NoFriction>},
    {{AdhesionLaw::none, true}, false, &integrate<D, Hertz, Mindlin>},
    {{AdhesionLaw::dmt, false}, false, &integrate<D, Dmt, NoFriction>},
    {{AdhesionLaw::dmt, true}, false, &integrate<D, Dmt, Mindlin>},
    {{AdhesionLaw::jkr, false}, false, &integrate<D, Jkr, NoFriction>},
    {{AdhesionLaw::jkr, true}, false, &integrate<D, Jkr, Mindlin>},
};

// Without friction nothing turns and, unless necks form, nothing is remembered: there are no such arrays.
template <class Law>
concept HasSpins = requires(State<3, Law> s) {
  s.spin;
};
template <class Law>
concept HasMemories = requires(Memories<3, Law> m) {
  m.of_pair;
};
static_assert(!HasSpins<ContactLaw<Hertz, TsujiDamping>> && !HasMemories<ContactLaw<Hertz, TsujiDamping>>);
static_assert(!HasSpins<ContactLaw<Hertz>> && !HasMemories<ContactLaw<Hertz>>);
static_assert(!HasSpins<ContactLaw<Dmt, TsujiDamping>> && !HasMemories<ContactLaw<Dmt, TsujiDamping>>);
static_assert(!HasSpins<ContactLaw<Jkr, TsujiDamping>> && HasMemories<ContactLaw<Jkr, TsujiDamping>>);
static_assert(HasSpins<ContactLaw<Hertz, TsujiDamping, Mindlin>> &&
              HasMemories<ContactLaw<Hertz, TsujiDamping, Mindlin>>);

} // namespace

template <int D>
Settled<D> settle(const SettleTask<D>& task) {
  if (task.radii.empty())
    throw InputError("there are no spheres to settle");
  const bool energy_alone = task.effects == ContactEffects{} && task.minimise;
  for (const Row<D>& row : kKernels<D>) {
    if (row.effects == task.effects && row.minimise == energy_alone)
      return row.kernel(task);
  }
  throw InputError("no kernel has these effects");
}

template Settled<2> settle(const SettleTask<2>&);
template Settled<3> settle(const SettleTask<3>&);

} // namespace tamp
