// The rules from a material's numbers to contact effects.
#include "engine/generate/material_effects.h"

#include "engine/contact/material.h"
#include "engine/contact/tabor.h"

namespace tamp {

double hard_modulus(const Material& material) {
  const Elastic solid{material.young, material.poisson};
  return effective_modulus(solid, solid);
}

double tabor_of(const Material& material, double radius) {
  return tabor_parameter(hard_modulus(material), material.adhesion, effective(radius, radius), kAttractionRange);
}

ContactEffects effects_of(const Material& material, double tabor) {
  const bool all = material.simulate == Simulate::all;
  ContactEffects effects;
  effects.friction = material.friction > 0 || all;
  if (all && material.adhesion == 0) {
    effects.adhesion = material.adhesion_model == AdhesionModel::dmt ? AdhesionLaw::dmt : AdhesionLaw::jkr;
  } else if (material.adhesion > 0) {
    const bool jkr = material.adhesion_model == AdhesionModel::tabor ? adheres_as_jkr(tabor)
                                                                     : material.adhesion_model == AdhesionModel::jkr;
    effects.adhesion = jkr ? AdhesionLaw::jkr : AdhesionLaw::dmt;
  }
  return effects;
}

bool moves_in_time(const Material& material) {
  return effects_of(material, 0) != ContactEffects{} || material.simulate != Simulate::called_for;
}

} // namespace tamp
