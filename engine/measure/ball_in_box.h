// The volume common to a ball and a box (the area common to a disc and a rectangle), in closed form.
#pragma once

#include "engine/base/vec.h"

namespace tamp {

/// Volume of the ball inside [low, high]; low < high on every axis, any place and any ratio of sizes. The rounding
/// error is a few 1e-16 of the ball's volume; it is exact to rounding when either body contains the other.
///
/// Inclusion and exclusion over the half-spaces beyond the faces: whole ball − caps + wedges beyond two faces − corners
/// beyond three (Freireich, Kodam & Wassgren, AIChE J. 56, 3036, 2010; Strobl, Formella & Pöschel, J. Comput. Phys.
/// 311, 158, 2016). The pieces follow from the divergence theorem, D·V = r·(curved surface) + Σ (signed distance)·(flat
/// face), with the curved surface from the theorem of Gauss and Bonnet.
template <int D>
double ball_in_box(const Vec<D>& centre, double radius, const Vec<D>& low, const Vec<D>& high);

/// Part of the unit ball beyond one plane at the distance h from its centre, 0 ≤ h ≤ 1: segment or cap.
template <int D>
double cap_of_unit_ball(double h);

/// Volume of the unit ball, area of the unit disc.
template <int D>
inline constexpr double kUnitBall = D == 2 ? 3.14159265358979323846 : 3.14159265358979323846 * 4 / 3;

} // namespace tamp
