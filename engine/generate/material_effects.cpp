// The rules from a material's numbers to contact effects, and their words in records.
#include "engine/generate/material_effects.h"

#include "engine/contact/material.h"
#include "engine/contact/tabor.h"

#include <fmt/format.h>

#include <string>

namespace tamp {

double hard_modulus(const Material& material) {
  const Elastic solid{material.young, material.poisson};
  return effective_modulus(solid, solid);
}

double tabor_of(const Material& material, double radius) {
  return tabor_parameter(hard_modulus(material), material.adhesion, effective(radius, radius), kAttractionRange);
}

ContactEffects effects_of(const Material& material, double tabor) {
  ContactEffects effects;
  effects.friction = material.friction > 0;
  if (material.adhesion > 0) {
    const bool jkr = material.adhesion_model == AdhesionModel::tabor ? adheres_as_jkr(tabor)
                                                                     : material.adhesion_model == AdhesionModel::jkr;
    effects.adhesion = jkr ? AdhesionLaw::jkr : AdhesionLaw::dmt;
  }
  return effects;
}

void tell_contact_effects(const Material& material, double tabor, Effects& effects) {
  const ContactEffects called = effects_of(material, tabor);
  if (called.friction) {
    effects.simulated.emplace_back("friction (Mindlin, Coulomb), with rotation and memory of contacts");
  } else {
    effects.left_out.push_back({"friction", "mu = 0"});
    effects.left_out.push_back({"rotation", "without friction nothing turns a sphere"});
  }
  if (called.adhesion == AdhesionLaw::none) {
    effects.left_out.push_back({"adhesion", "W = 0"});
  } else {
    const bool forced = material.adhesion_model != AdhesionModel::tabor;
    const std::string why = forced ? std::string("as asked for") : fmt::format("Tabor's parameter {:.3g}", tabor);
    effects.simulated.push_back(
        fmt::format("adhesion ({}: {})", called.adhesion == AdhesionLaw::jkr ? "JKR" : "DMT", why));
  }
  effects.left_out.push_back({"rolling resistance", "the method has no parameter for it"});
}

} // namespace tamp
