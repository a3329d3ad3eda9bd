// Which contact effects a material calls for, at the size of its particles; shared by all methods that know forces.
#pragma once

#include "engine/dem/effects.h"
#include "engine/model/method.h"
#include "engine/model/record.h"

namespace tamp {

/// E* of two bodies of the material, Pa.
double hard_modulus(const Material& material);

/// Tabor's parameter of particles of this radius in metres.
double tabor_of(const Material& material, double radius);

/// Friction if mu > 0; adhesion if W > 0, by the law that Tabor's parameter says or the material asks for.
ContactEffects effects_of(const Material& material, double tabor);

/// Adds to a record which of friction, rotation and adhesion ran, which did not, and why.
void tell_contact_effects(const Material& material, double tabor, Effects& effects);

} // namespace tamp
