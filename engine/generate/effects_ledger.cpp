// One function for each family of methods, in the words of records and of `tamp plan`.
#include "engine/generate/effects_ledger.h"

#include "engine/contact/tabor.h"
#include "engine/generate/material_effects.h"
#include "engine/model/size_law.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace tamp {

namespace {

/// Where every effect is asked for, those that the material does not call for run at 0.
std::string at_zero(double value) {
  return value > 0 ? "" : ", asked for at 0";
}

void contact_effects(const Material& material, double tabor, Effects& out) {
  const ContactEffects run = effects_of(material, tabor);
  if (run.friction) {
    out.simulated.push_back(
        fmt::format("friction (Mindlin, Coulomb; mu = {:g}{}), with rotation and memory of contacts", material.friction,
                    at_zero(material.friction)));
  } else {
    out.left_out.push_back({"friction", "mu = 0"});
    out.left_out.push_back({"rotation", "without friction nothing turns a sphere"});
  }
  if (run.adhesion == AdhesionLaw::none) {
    out.left_out.push_back({"adhesion", "W = 0"});
  } else {
    const bool forced = material.adhesion_model != AdhesionModel::tabor || !(material.adhesion > 0);
    out.simulated.push_back(
        fmt::format("adhesion ({}; W = {:g} J/m²{}; Tabor's parameter {:.3g}{})",
                    run.adhesion == AdhesionLaw::jkr ? "JKR" : "DMT", material.adhesion, at_zero(material.adhesion),
                    tabor, forced ? ", of no account here" : fmt::format(", JKR from {:g} on", kTaborThreshold)));
  }
  out.left_out.push_back({"rolling resistance", "the method has no parameter for it"});
}

/// Weight of the bed over the stiffness of its contacts, ρgH/E*: how little real contacts give, so that softer ones do.
double weight_over_stiffness(const Scene& scene, const Method& method) {
  const double height = scene.size.back() * metres(scene.unit);
  return method.material.density * method.dem_gravity.gravity * height / hard_modulus(method.material);
}

/// Pull-off force 3/2 πWR of two spheres, R half the radius, over the weight of one: JKR's; DMT's is 4/3 of it.
double pull_over_weight(const Method& method, double radius) {
  const double weight =
      4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * method.material.density * method.dem_gravity.gravity;
  return 1.5 * std::numbers::pi * method.material.adhesion * radius / 2 / weight;
}

void gravity(const Scene& scene, const Method& method, double radius, Effects& out) {
  out.simulated.push_back(method.material.adhesion > 0
                              ? fmt::format("gravity (two spheres hold together with {:.2g} times a sphere's weight)",
                                            pull_over_weight(method, radius))
                              : "gravity");
  out.simulated.push_back(
      fmt::format("Hertz contacts, softened to overlaps of at most {:g} (weight of the bed over E*: {:.1g})",
                  method.dem_gravity.overlap, weight_over_stiffness(scene, method)));
}

/// Inertial number of the fall from the height of the box H: shear rate √(2gH)/H times d/√(p/ρ) with p = ρgH.
double inertial_number(const Scene& scene, double radius) {
  return std::sqrt(2.0) * 2 * radius / (scene.size.back() * metres(scene.unit));
}

Effects dem_gravity(const Scene& scene, const Method& method, double radius) {
  Effects out;
  const double tabor = tabor_of(method.material, radius);
  gravity(scene, method, radius, out);
  if (moves_in_time(method.material)) {
    out.simulated.push_back(
        fmt::format("inertia (inertial number of the fall {:.2g})", inertial_number(scene, radius)));
    out.simulated.push_back(fmt::format("damping by restitution (Tsuji; e = {:g})", method.material.restitution));
    out.simulated.emplace_back("local damping and inertia matched to stiffness, once the bed has its shape");
    out.simulated.emplace_back("in the fall, particles below the median are denser");
  } else {
    const std::string quasi_static =
        "no friction and no adhesion: energy is minimised, which has no time (inertial number 0)";
    out.left_out.push_back({"inertia", quasi_static});
    out.left_out.push_back({"damping", quasi_static});
  }
  contact_effects(method.material, tabor, out);
  return out;
}

Effects dem_isostatic(const Scene&, const Method& method, double radius) {
  Effects out;
  const double tabor = tabor_of(method.material, radius);
  out.left_out = {{"gravity", "isostatic: the load is a pressure"}, {"walls", "isostatic: every axis is periodic"}};
  if (moves_in_time(method.material)) {
    out.simulated = {fmt::format("Hertz contacts, softened to overlaps of at most {:g} (load over E*: {:.1g})",
                                 method.dem_isostatic.overlap_tolerance,
                                 method.dem_isostatic.load / hard_modulus(method.material)),
                     "isotropic compression of a periodic box", "local damping and inertia matched to stiffness"};
    out.left_out.push_back({"inertia", "quasi-static: it only decides how long the way takes"});
    contact_effects(method.material, tabor, out);
    return out;
  }
  const std::string minimised =
      "without friction and adhesion the enthalpy is minimised, which has no time (inertial number 0)";
  out.simulated = {"elastic repulsion (harmonic)", "isotropic compression of a periodic box"};
  out.left_out.push_back({"inertia", minimised});
  out.left_out.push_back({"damping", minimised});
  contact_effects(method.material, tabor, out);
  return out;
}

Effects lammps_gravity(const Scene& scene, const Method& method, double radius) {
  Effects out;
  gravity(scene, method, radius, out);
  out.simulated.push_back(fmt::format("inertia (inertial number of the fall {:.2g})", inertial_number(scene, radius)));
  out.simulated.push_back(fmt::format("damping by restitution (Tsuji; e = {:g})", method.material.restitution));
  out.simulated.emplace_back("once the bed has its shape: inertia matched to the stiffness of contacts, local damping");
  contact_effects(method.material, tabor_of(method.material, radius), out);
  return out;
}

Effects lammps_isostatic(const Scene&, const Method&, double) {
  Effects out;
  out.simulated = {"elastic repulsion (Hertz)", "isotropic compression of a periodic box", "inertia",
                   "damping by restitution (Tsuji)", "drag beside the motion of the box"};
  out.left_out = {{"gravity", "isostatic: the load is a pressure"},
                  {"walls", "isostatic: every axis is periodic"},
                  {"friction", "the method has none (NANF)"},
                  {"rotation", "without friction nothing turns a sphere"},
                  {"adhesion", "the method has none (NANF)"}};
  return out;
}

Effects drop_and_roll(const Scene&, const Method&, double) {
  Effects out;
  out.simulated = {"gravity (quasi-static steepest descent)", "hard contacts"};
  out.left_out = {{"inertia", "drop-and-roll is quasi-static: a sphere has no velocity to keep"},
                  {"friction", "contacts are smooth: only the normal direction is blocked"},
                  {"adhesion", "contacts do not pull"},
                  {"response of the bed", "placed spheres do not move"}};
  return out;
}

Effects moving_enlarging(const Scene&, const Method&, double) {
  Effects out;
  out.simulated = {"hard contacts", "growth of the spheres"};
  out.left_out = {{"gravity", "spheres move into the middle of their neighbours, wherever that is"},
                  {"inertia", "spheres are placed, they have no velocity"},
                  {"friction", "spheres do not slide along each other"},
                  {"adhesion", "contacts do not pull"}};
  return out;
}

Effects lattice(const Scene&, const Method&, double) {
  return {};
}

struct Row {
  MethodName method;
  Effects (*effects)(const Scene& scene, const Method& method, double radius);
};

constexpr Row kRows[] = {
    {MethodName::drop_and_roll, drop_and_roll},       {MethodName::lattice, lattice},
    {MethodName::drop_and_roll_me, moving_enlarging}, {MethodName::dem_gravity, dem_gravity},
    {MethodName::dem_isostatic, dem_isostatic},       {MethodName::lammps_gravity, lammps_gravity},
    {MethodName::lammps_isostatic, lammps_isostatic},
};

} // namespace

Effects effects_ledger(const Scene& scene, const Method& method, double radius) {
  return kRows[static_cast<std::size_t>(method.name)].effects(scene, method, radius);
}

Effects effects_ledger(const Job& job) {
  const SizeLaw law(job.scene.psd, static_cast<int>(job.scene.dimension));
  return effects_ledger(job.scene, job.method, law.moment(1) * metres(job.scene.unit));
}

} // namespace tamp
