// The functions behind the table of metrics, one for each file of this room that is named after a metric.
#pragma once

#include "engine/model/metric.h"
#include "engine/model/packing.h"
#include "engine/model/record.h"
#include "engine/model/scene.h"

#include <vector>

namespace tamp {

/// An overlap above this share of the smaller radius is an overlap; below, it is the rounding of an exact contact.
inline constexpr double kOverlapTolerance = 1e-10;

/// H_N, and H_S (2D) or H_V (3D), of the radii against the scene's law in `bins` equal bins (one bin per size of a
/// discrete law), each with the floor a perfect random sampler of as many spheres has. H = sqrt(1 − Σ sqrt(p q)), the
/// paper's eq. (Hellinger). Radii outside the law's range are mass in no bin: they raise H as if of a size the law
/// never gives. `bins` comes back as used. H_N_se and H_V_se: standard errors of independent draws (multinomial, to
/// first order).
std::vector<Measure> measure_hellinger(const Metric& metric, const Packing& packing, const Scene& scene);

/// phi: share of the sub-box (see sub_box.h) that spheres fill, edges and corners of every sphere∩box piece included,
/// with spheres centred outside it and the images of periodic axes. Overlaps count twice. phi_se: its standard error
/// from the scatter of the densities of 3^D equal parts of the sub-box, taken for independent; they are less alike than
/// that, so it is on the safe side.
std::vector<Measure> measure_phi(const Metric& metric, const Packing& packing, const Scene& scene);

/// phi_paper: the paper's clipped estimator on the same sub-box, eq. (phiB): only spheres whose centre is inside, less
/// the caps beyond each face. Biased low by about (9/8) phi <R⁴>/<R³> / edge. N_PB: number of those spheres.
std::vector<Measure> measure_phi_paper(const Metric& metric, const Packing& packing, const Scene& scene);

/// overlap_max: deepest overlap of two spheres, or of a sphere and a wall, relative to the smaller radius; 0 if none.
/// overlap_pairs and overlap_walls: how many of each are deeper than kOverlapTolerance.
std::vector<Measure> measure_overlap(const Metric& metric, const Packing& packing, const Scene& scene);

/// stable_alone: the paper's condition (ii): share of spheres whose centre projects inside the hull of their supports.
/// Supports are contacts (gap ≤ contact_gap of the smaller radius) with spheres, the floor and side walls that do not
/// lie above the centre. unstable_count: the others.
std::vector<Measure> measure_stable_alone(const Metric& metric, const Packing& packing, const Scene& scene);

/// z: mean number of contacts with other spheres (walls not counted; an image of itself counts at either end). z_se:
/// its standard error from the scatter of the spheres' numbers. rattlers: share of spheres left out when those with
/// fewer than dimension + 1 contacts are taken away until none is left; here a wall counts as a contact, for it holds a
/// sphere as well as a sphere does. z_no_rattlers: z of the rest among themselves; 0 if there is no rest.
std::vector<Measure> measure_coordination(const Metric& metric, const Packing& packing, const Scene& scene);

/// Of a bimodal law: N_L, the number of large spheres; X_L, their share of the volume (2D: area) of all spheres; P_NL,
/// their share by number. A sphere is large if its radius is no farther from R_L than from R_S; so at size ratio 1,
/// where nothing tells them apart, all are large, as the paper counts. Throws NotApplicable for other laws.
std::vector<Measure> measure_composition(const Metric& metric, const Packing& packing, const Scene& scene);

/// Steinhardt, Nelson & Ronchetti, Phys. Rev. B 28, 784 (1983), over neighbours, whose gap is at most 0.41 of the
/// smaller radius, half-way to the second shell of a close packing: Q6 of all bonds together, Q6_local the mean of the
/// spheres' own; in 2D psi6 and psi6_local, |⟨e^{6iθ}⟩|. crystalline: share of spheres with at least 7 (2D: 5) bonds to
/// neighbours of like surroundings. neighbours: their mean number. Spheres without neighbours have no order of their
/// own; of a packing without any all numbers are 0.
std::vector<Measure> measure_bond_order(const Metric& metric, const Packing& packing, const Scene& scene);

/// Contact forces (gap ≤ contact_gap of the smaller radius; spheres, walls, floor) that push, with friction up to
/// `friction` times the push, and balance the weights (∝ r^dimension) of all spheres at once, as nearly as they can
/// (see load_network.h). In mean weights: loaded_residual, the rms net force (and, with friction, moment over radius)
/// of a sphere; loaded_residual_max; loaded_force_max; loaded_violation, how far the solution is from the optimum.
/// unbalanced: share of spheres whose net force is above 1 % of the largest force on them.
std::vector<Measure> measure_stable_loaded(const Metric& metric, const Packing& packing, const Scene& scene);

} // namespace tamp
