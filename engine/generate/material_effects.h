// Which contact effects a material calls for, at the size of its particles; shared by all methods that know forces.
#pragma once

#include "engine/dem/effects.h"
#include "engine/model/method.h"

namespace tamp {

/// E* of two bodies of the material, Pa.
double hard_modulus(const Material& material);

/// Tabor's parameter of particles of this radius in metres.
double tabor_of(const Material& material, double radius);

/// Friction if mu > 0; adhesion if W > 0, by the law that Tabor's parameter says or the material asks for. All of them,
/// adhesion by JKR unless DMT is asked for, where the material wants every effect simulated.
ContactEffects effects_of(const Material& material, double tabor);

/// Whether motion is followed in time: with any of these effects, or because the material asks for it. Else energy is
/// minimised.
bool moves_in_time(const Material& material);

} // namespace tamp
