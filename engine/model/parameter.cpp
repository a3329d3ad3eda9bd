// The parameter tables: one row per parameter of scenes, methods, metrics and runs.
#include "engine/model/parameter.h"

#include <limits>
#include <type_traits>

namespace tamp {

namespace {

using Words = std::string_view;

const Range kAny{};
const Range kPositive{0, std::numeric_limits<double>::infinity(), true, false};
const Range kNotNegative{0, std::numeric_limits<double>::infinity(), false, false};
const Range kFraction{0, 1, false, false};

template <class Root>
bool always(const Root&) {
  return true;
}

/// One row. `field` is a stateless lambda from the root to its field; the field's type decides the kind.
template <class Root, class Field>
Parameter<Root> row(Words path, Words unit, Range range, Words doc, Field field, Words when = {},
                    bool (*applies)(const Root&) = &always<Root>) {
  using T = std::remove_cvref_t<decltype(field(std::declval<Root&>()))>;
  Parameter<Root> p{path, unit, range, doc, when, applies, {}, {}, {}, {}};
  // A field is read through the same lambda that writes it; reading does not change the root.
  const auto read = [field](const Root& root) -> const T& { return field(const_cast<Root&>(root)); };
  if constexpr (std::is_enum_v<T>) {
    p.kind = ParameterKind::choice;
    p.choices.assign(EnumNames<T>::value.begin(), EnumNames<T>::value.end());
    p.get = [read](const Root& root) { return JsonLeaf(std::string(name_of(read(root)))); };
    p.set = [field](Root& root, const JsonLeaf& leaf) { field(root) = *enum_of<T>(std::get<std::string>(leaf)); };
  } else {
    if constexpr (std::is_same_v<T, bool>) {
      p.kind = ParameterKind::boolean;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      p.kind = ParameterKind::integer;
    } else if constexpr (std::is_same_v<T, double>) {
      p.kind = ParameterKind::number;
    } else {
      static_assert(std::is_same_v<T, std::vector<double>>);
      p.kind = ParameterKind::numbers;
    }
    p.get = [read](const Root& root) { return JsonLeaf(read(root)); };
    p.set = [field](Root& root, const JsonLeaf& leaf) { field(root) = std::get<T>(leaf); };
  }
  return p;
}

template <Law... allowed>
bool law_is(const Scene& scene) {
  return ((scene.psd.law == allowed) || ...);
}

template <MethodName... allowed>
bool method_is(const Method& method) {
  return ((method.name == allowed) || ...);
}

template <MetricName... allowed>
bool metric_is(const Metric& metric) {
  return ((metric.name == allowed) || ...);
}

std::vector<Parameter<Scene>> scene_table() {
  constexpr auto continuous = &law_is<Law::lognormal, Law::normal, Law::weibull>;
  constexpr Words continuous_words = "psd/law = lognormal, normal or weibull";
  return {
      row<Scene>(
          "dimension", "1", {2, 3}, "Number of dimensions: 2 (discs) or 3 (spheres).",
          [](Scene & s) -> auto& { return s.dimension; }),
      row<Scene>(
          "unit", "1", kAny, "Unit of every length in the scene and in its packings.",
          [](Scene & s) -> auto& { return s.unit; }),
      row<Scene>(
          "size", "length", kPositive,
          "Edges of the box, the vertical one last; one number (or a list of one) means equal edges.",
          [](Scene & s) -> auto& { return s.size; }),
      row<Scene>(
          "sides", "1", kAny, "Lateral faces of the box: hard walls or periodic.",
          [](Scene & s) -> auto& { return s.sides; }),
      row<Scene>(
          "count", "1", {0, 1e9}, "Number of particles; 0 means as many as fit into the box.",
          [](Scene & s) -> auto& { return s.count; }),
      row<Scene>(
          "psd/law", "1", kAny, "Law of the radii (number-weighted unless psd/weighting says otherwise).",
          [](Scene & s) -> auto& { return s.psd.law; }),
      row<Scene>(
          "psd/radius", "length", kPositive, "Radius of equal spheres.",
          [](Scene & s) -> auto& { return s.psd.radius; }, "psd/law = monodisperse", &law_is<Law::monodisperse>),
      row<Scene>(
          "psd/mu_ln", "ln(length)", kAny, "Mean of the logarithm of the radius.",
          [](Scene & s) -> auto& { return s.psd.mu_ln; }, "psd/law = lognormal", &law_is<Law::lognormal>),
      row<Scene>(
          "psd/sigma_ln", "1", kPositive, "Standard deviation of the logarithm of the radius.",
          [](Scene & s) -> auto& { return s.psd.sigma_ln; }, "psd/law = lognormal", &law_is<Law::lognormal>),
      row<Scene>(
          "psd/mean", "length", kPositive,
          "Mean radius of the uncut law; for a lognormal law instead of, or as a check on, mu_ln and sigma_ln.",
          [](Scene & s) -> auto& { return s.psd.mean; }, "psd/law = lognormal or normal",
          &law_is<Law::lognormal, Law::normal>),
      row<Scene>(
          "psd/sd", "length", kPositive, "Standard deviation of the radius of the uncut law; used as psd/mean is.",
          [](Scene & s) -> auto& { return s.psd.sd; }, "psd/law = lognormal or normal",
          &law_is<Law::lognormal, Law::normal>),
      row<Scene>(
          "psd/small_radius", "length", kPositive, "Radius R_S of the small spheres.",
          [](Scene & s) -> auto& { return s.psd.small_radius; }, "psd/law = bimodal", &law_is<Law::bimodal>),
      row<Scene>(
          "psd/size_ratio", "1", {1, 1e4}, "Size ratio rho = R_L/R_S.",
          [](Scene & s) -> auto& { return s.psd.size_ratio; }, "psd/law = bimodal", &law_is<Law::bimodal>),
      row<Scene>(
          "psd/large_volume_fraction", "1", kFraction,
          "Share X_L of the large spheres in the volume (in 2D: area) of all spheres.",
          [](Scene & s) -> auto& { return s.psd.large_volume_fraction; }, "psd/law = bimodal", &law_is<Law::bimodal>),
      row<Scene>(
          "psd/scale", "length", kPositive, "Scale of the Weibull (Rosin-Rammler) law.",
          [](Scene & s) -> auto& { return s.psd.scale; }, "psd/law = weibull", &law_is<Law::weibull>),
      row<Scene>(
          "psd/shape", "1", kPositive, "Shape exponent of the Weibull (Rosin-Rammler) law.",
          [](Scene & s) -> auto& { return s.psd.shape; }, "psd/law = weibull", &law_is<Law::weibull>),
      row<Scene>(
          "psd/weighting", "1", kAny, "Whether the law counts particles or their volume (in 2D: area).",
          [](Scene & s) -> auto& { return s.psd.weighting; }, "psd/law = weibull or histogram",
          &law_is<Law::weibull, Law::histogram>),
      row<Scene>(
          "psd/edges", "length", kNotNegative, "Edges of the size classes, increasing: one more than weights.",
          [](Scene & s) -> auto& { return s.psd.edges; }, "psd/law = histogram", &law_is<Law::histogram>),
      row<Scene>(
          "psd/weights", "1", kNotNegative, "Weight of each size class; only their ratios count.",
          [](Scene & s) -> auto& { return s.psd.weights; }, "psd/law = histogram", &law_is<Law::histogram>),
      row<Scene>(
          "psd/r_min", "length", kPositive, "Smallest radius: the law is cut here and renormalised.",
          [](Scene & s) -> auto& { return s.psd.r_min; }, continuous_words, continuous),
      row<Scene>(
          "psd/r_max", "length", kPositive, "Largest radius: the law is cut here and renormalised.",
          [](Scene & s) -> auto& { return s.psd.r_max; }, continuous_words, continuous),
      row<Scene>(
          "sampler", "1", kAny,
          "How radii are drawn: independently, or one from each equal-probability stratum in shuffled order.",
          [](Scene & s) -> auto& { return s.sampler; }),
  };
}

std::vector<Parameter<Method>> method_table() {
  constexpr auto drop = &method_is<MethodName::drop_and_roll>;
  constexpr Words drop_words = "name = drop-and-roll";
  constexpr auto dem = &method_is<MethodName::dem_gravity, MethodName::lammps_gravity>;
  constexpr Words dem_words = "name = dem-gravity or lammps-gravity";
  constexpr auto gravity = dem;
  constexpr Words gravity_words = dem_words;
  constexpr auto forces = &method_is<MethodName::dem_gravity, MethodName::dem_isostatic, MethodName::lammps_gravity>;
  constexpr Words forces_words = "name = dem-gravity, dem-isostatic or lammps-gravity";
  constexpr auto isostatic = &method_is<MethodName::dem_isostatic>;
  constexpr Words isostatic_words = "name = dem-isostatic";
  return {
      row<Method>(
          "name", "1", kAny, "Which generator makes the packing.", [](Method & m) -> auto& { return m.name; }),
      row<Method>(
          "lid", "1", kAny, "A sphere must end wholly below the top of the box, else it counts as a failure.",
          [](Method & m) -> auto& { return m.drop_and_roll.lid; }, drop_words, drop),
      row<Method>(
          "on_failure", "1", kAny,
          "After a failure: draw a new radius (the paper's way; it fills the last gap with fines and so shifts the "
          "size "
          "distribution), or keep it for the next attempt (keeps to the law).",
          [](Method & m) -> auto& { return m.drop_and_roll.on_failure; }, drop_words, drop),
      row<Method>(
          "max_failures", "1", {1, 1e9}, "N_max: this many failures in a row end the packing.",
          [](Method & m) -> auto& { return m.drop_and_roll.max_failures; }, drop_words, drop),
      row<Method>(
          "kind", "1", kAny, "Which lattice; square and hexagonal in 2D, the others in 3D.",
          [](Method & m) -> auto& { return m.lattice.kind; }, "name = lattice", &method_is<MethodName::lattice>),
      row<Method>(
          "sweeps", "1", {1, 1e4},
          "Passes of moving and enlarging, each with a triangulation of its own. On the lognormal powder of sigma_ln "
          "0.68 "
          "phi is this far below where it ends: with four 0.47 % in 3D and 0.12 % in 2D, with five 0.29 % and 0.05 %, "
          "with "
          "eight 0.05 % and 0.005 %; five take about ten times as long as drop-and-roll.",
          [](Method & m) -> auto& { return m.moving_enlarging.sweeps; }, "name = drop-and-roll-me",
          &method_is<MethodName::drop_and_roll_me>),
      row<Method>(
          "young", "Pa", kPositive,
          "Young's modulus E of the material. Contacts are made as soft as the tolerated overlap allows, never stiffer "
          "than this.",
          [](Method & m) -> auto& { return m.material.young; }, forces_words, forces),
      row<Method>(
          "poisson", "1", {0, 0.5}, "Poisson's ratio of the material.",
          [](Method & m) -> auto& { return m.material.poisson; }, forces_words, forces),
      row<Method>(
          "density", "kg/m^3", kPositive, "Density of the material.",
          [](Method & m) -> auto& { return m.material.density; }, dem_words, dem),
      row<Method>(
          "friction", "1", kNotNegative,
          "Coulomb's coefficient mu between particles and with walls; 0 leaves out friction, rotation and the memory "
          "of "
          "contacts.",
          [](Method & m) -> auto& { return m.material.friction; }, forces_words, forces),
      row<Method>(
          "restitution", "1", {0.01, 0.99},
          "Coefficient of restitution e. Of no account without friction and adhesion, where energy is minimised.",
          [](Method & m) -> auto& { return m.material.restitution; },
          "name = dem-gravity, lammps-gravity or lammps-isostatic",
          &method_is<MethodName::dem_gravity, MethodName::lammps_gravity, MethodName::lammps_isostatic>),
      row<Method>(
          "adhesion", "J/m^2", kNotNegative, "Work of adhesion W; 0 leaves out adhesion.",
          [](Method & m) -> auto& { return m.material.adhesion; }, forces_words, forces),
      row<Method>(
          "adhesion_model", "1", kAny,
          "Law of adhesion: JKR, DMT, or whichever Tabor's parameter of the mean radius says.",
          [](Method & m) -> auto& { return m.material.adhesion_model; }, forces_words, forces),
      row<Method>(
          "simulate", "1", kAny,
          "Which effects run: those that the scene calls for; these, but always followed in time; or all there are, "
          "also "
          "those whose numbers are 0, to show what it saves to leave them out.",
          [](Method & m) -> auto& { return m.material.simulate; }, "name = dem-gravity or dem-isostatic",
          &method_is<MethodName::dem_gravity, MethodName::dem_isostatic>),
      row<Method>(
          "gravity", "m/s^2", kPositive, "Acceleration of gravity.",
          [](Method & m) -> auto& { return m.dem_gravity.gravity; }, gravity_words, gravity),
      row<Method>(
          "flat_body", "1", kAny, "What a particle of a 2D scene is: a disc, or a sphere held in the plane.",
          [](Method & m) -> auto& { return m.dem_gravity.flat_body; }, gravity_words, gravity),
      row<Method>(
          "cloud_phi", "1", {0.01, 0.3},
          "Packing fraction of the loose cloud that settles or is compressed (dem-isostatic: with friction or "
          "adhesion).",
          [](Method & m) -> auto& { return m.dem_gravity.cloud_phi; },
          "name = dem-gravity, dem-isostatic, lammps-gravity or lammps-isostatic",
          &method_is<MethodName::dem_gravity, MethodName::dem_isostatic, MethodName::lammps_gravity,
                     MethodName::lammps_isostatic>),
      row<Method>(
          "overlap", "1", {1e-6, 0.1},
          "Largest overlap of the bed relative to the smaller radius: contacts are stiffened until it is met.",
          [](Method & m) -> auto& { return m.dem_gravity.overlap; }, gravity_words, gravity),
      row<Method>(
          "force_balance", "1", {1e-9, 0.1},
          "The bed rests when the rms net force of a particle is this share of the mean contact force; where energy is "
          "minimised also when, after 20000 evaluations, the mean height no longer changes.",
          [](Method & m) -> auto& { return m.dem_gravity.force_balance; }, gravity_words, gravity),
      row<Method>(
          "steps_per_collision", "1", {1, 1e4},
          "Time steps in the duration of the shortest collision. A step that proves unstable is halved and done again. "
          "Of "
          "no account where energy is minimised. Half of the default takes a third fewer steps from a loose cloud and "
          "a "
          "quarter more from a bed, where more of them prove unstable; phi stays within 0.05 %.",
          [](Method & m) -> auto& { return m.dem_gravity.steps_per_collision; }, "name = dem-gravity",
          &method_is<MethodName::dem_gravity>),
      row<Method>(
          "kinetic_energy", "1", kPositive,
          "The bed rests when the mean kinetic energy of a particle is this many times its weight times the mean "
          "radius; "
          "of no account where energy is minimised.",
          [](Method & m) -> auto& { return m.dem_gravity.kinetic_energy; }, gravity_words, gravity),
      row<Method>(
          "height_drift", "1", kPositive,
          "The bed rests when, at three looks in a row, its mean height has changed by less than this many mean radii "
          "in 400 steps with matched inertia, and forces, motion and contacts are at rest, too.",
          [](Method & m) -> auto& { return m.lammps_gravity.height_drift; }, "name = lammps-gravity",
          &method_is<MethodName::lammps_gravity>),
      row<Method>(
          "contact_drift", "1", kPositive, "The same for the mean number of contacts of a particle.",
          [](Method & m) -> auto& { return m.lammps_gravity.contact_drift; }, "name = lammps-gravity",
          &method_is<MethodName::lammps_gravity>),
      row<Method>(
          "target_phi", "1", {0, 1, true, true},
          "Packing fraction of the result; not stated: the box shrinks until the particles jam.",
          [](Method & m) -> auto& { return m.dem_isostatic.target_phi; }, isostatic_words, isostatic),
      row<Method>(
          "start_phi", "1", {0.01, 0.6},
          "Packing fraction at which particles are thrown into the box at random; of no account for a start from a "
          "packing, and with friction or adhesion, which start from a loose cloud.",
          [](Method & m) -> auto& { return m.dem_isostatic.start_phi; }, isostatic_words, isostatic),
      row<Method>(
          "overlap_tolerance", "1", {1e-8, 0.1},
          "Largest overlap of the result relative to the smaller radius: the pressure is lowered until it is met; with "
          "friction or adhesion contacts are stiffened at the same load instead.",
          [](Method & m) -> auto& { return m.dem_isostatic.overlap_tolerance; },
          "name = dem-isostatic or lammps-isostatic",
          &method_is<MethodName::dem_isostatic, MethodName::lammps_isostatic>),
      row<Method>(
          "force_tolerance", "1", {1e-6, 0.5},
          "Forces balance, and the pressure may fall, when the rms net force of a particle is this share of the mean "
          "contact force; what is left is the measure force_balance. Without friction phi errs by about 0.25 % at "
          "0.02, in "
          "proportion to it, and half of it takes a quarter longer; with friction phi errs by less than 0.6 % up to "
          "0.2 "
          "and z by 0.1 at 0.02, half of which takes three times as long (campaigns/accuracy-cost.json).",
          [](Method & m) -> auto& { return m.dem_isostatic.force_tolerance; }, isostatic_words, isostatic),
      row<Method>(
          "pressure", "1", {1e-6, 0.1},
          "Pressure of the compression in units of the contacts' modulus: the order of relative overlaps on the way. "
          "Of "
          "no account with friction or adhesion.",
          [](Method & m) -> auto& { return m.dem_isostatic.pressure; }, isostatic_words, isostatic),
      row<Method>(
          "load", "Pa", kPositive,
          "Pressure on the box of particles that rub or adhere. Adhesion counts as W/(load r), r the mean radius; "
          "friction alone knows no scale, and the load is then of no account for the packing.",
          [](Method & m) -> auto& { return m.dem_isostatic.load; }, isostatic_words, isostatic),
      row<Method>(
          "rate", "1", {1e-6, 0.05}, "Largest share by which the box edge shrinks in one step.",
          [](Method & m) -> auto& { return m.dem_isostatic.rate; }, isostatic_words, isostatic),
      row<Method>(
          "stop_strain", "1", {1e-9, 0.1},
          "The box is at rest, and the pressure may fall, when its volume changes by less than this share in 100 "
          "evaluations of all forces (lammps-isostatic: in the time of a hundredth of free compression, three times in "
          "a row).",
          [](Method & m) -> auto& { return m.dem_isostatic.stop_strain; }, "name = dem-isostatic or lammps-isostatic",
          &method_is<MethodName::dem_isostatic, MethodName::lammps_isostatic>),
      row<Method>(
          "hard", "1", kAny,
          "At the end widen the box and the packing in it until nothing overlaps: hard particles, for a loss of about "
          "three times the largest overlap in phi (twice in 2D).",
          [](Method & m) -> auto& { return m.hard; },
          "name = dem-gravity, dem-isostatic, lammps-gravity or lammps-isostatic",
          &method_is<MethodName::dem_gravity, MethodName::dem_isostatic, MethodName::lammps_gravity,
                     MethodName::lammps_isostatic>),
  };
}

std::vector<Parameter<Metric>> metric_table() {
  return {
      row<Metric>(
          "name", "1", kAny, "What is measured.", [](Metric & m) -> auto& { return m.name; }),
      row<Metric>(
          "bins", "1", {2, 1e6}, "Number K of equal bins between the law's smallest and largest radius.",
          [](Metric & m) -> auto& { return m.bins; }, "name = hellinger", &metric_is<MetricName::hellinger>),
      row<Metric>(
          "inset", "1", {0, 0.5, false, true},
          "Share of each edge of the bounding box of centres cut off at each end to get the sub-box.",
          [](Metric & m) -> auto& { return m.inset; }, "name = phi or phi_paper",
          &metric_is<MetricName::phi, MetricName::phi_paper>),
      row<Metric>(
          "contact_gap", "1", {0, 1, false, true},
          "Largest gap that counts as a contact, relative to the smaller radius.",
          [](Metric & m) -> auto& { return m.contact_gap; }, "name = stable_alone, stable_loaded or coordination",
          &metric_is<MetricName::stable_alone, MetricName::stable_loaded, MetricName::coordination>),
      row<Metric>(
          "iterations", "1", {1, 1e9},
          "Most iterations of the solver, above 50 000 contacts fewer, so that it takes seconds; how far it is from "
          "the optimum "
          "then is loaded_violation.",
          [](Metric & m) -> auto& { return m.iterations; }, "name = stable_loaded",
          &metric_is<MetricName::stable_loaded>),
      row<Metric>(
          "friction", "1", kNotNegative,
          "Coulomb's mu of every contact; 0: contacts push along their normal alone. The material's own, or another "
          "one.",
          [](Metric & m) -> auto& { return m.friction; }, "name = stable_loaded",
          &metric_is<MetricName::stable_loaded>),
  };
}

std::vector<Parameter<RunSettings>> run_table() {
  return {
      row<RunSettings>(
          "wall_s", "s", kPositive, "Wall-clock time one job may take.",
          [](RunSettings & r) -> auto& { return r.wall_s; }),
      row<RunSettings>(
          "cpu_s", "s", kNotNegative, "CPU time one job may take, in whole seconds; 0: no bound.",
          [](RunSettings & r) -> auto& { return r.cpu_s; }),
      row<RunSettings>(
          "memory_mb", "MB", {1, 1e9}, "Memory one job may take (1 MB = 1e6 bytes).",
          [](RunSettings & r) -> auto& { return r.memory_mb; }),
      row<RunSettings>(
          "timing", "1", kAny,
          "exclusive: each job alone on one pinned thread (the paper's protocol); shared: jobs side by side.",
          [](RunSettings & r) -> auto& { return r.timing; }),
      row<RunSettings>(
          "samples", "1", {1, 1000},
          "Times that each job timed alone is run in turn, within its budget: its time is the median.",
          [](RunSettings & r) -> auto& { return r.samples; }),
  };
}

std::vector<Parameter<ReportSettings>> report_table() {
  return {
      row<ReportSettings>(
          "phi_exp", "1", {0, 1, true, true},
          "Packing fraction of an experiment on the powder: the report says which method comes closest.",
          [](ReportSettings & r) -> auto& { return r.phi_exp; }),
  };
}

} // namespace

std::span<const Parameter<Scene>> scene_parameters() {
  static const auto table = scene_table();
  return table;
}
std::span<const Parameter<Method>> method_parameters() {
  static const auto table = method_table();
  return table;
}
std::span<const Parameter<Metric>> metric_parameters() {
  static const auto table = metric_table();
  return table;
}
std::span<const Parameter<ReportSettings>> report_parameters() {
  static const auto table = report_table();
  return table;
}

std::span<const Parameter<RunSettings>> run_parameters() {
  static const auto table = run_table();
  return table;
}

} // namespace tamp
