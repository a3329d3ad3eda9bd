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
/// never gives. `bins` comes back as used.
std::vector<Measure> measure_hellinger(const Metric& metric, const Packing& packing, const Scene& scene);

/// phi: share of the sub-box (see sub_box.h) that spheres fill, edges and corners of every sphere∩box piece included,
/// with spheres centred outside it and the images of periodic axes. Overlaps count twice.
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

/// z: mean number of contacts with other spheres (walls not counted; an image of itself counts at either end).
/// rattlers: share of spheres left out when those with fewer than dimension + 1 contacts are taken away until none is
/// left; here a wall counts as a contact, for it holds a sphere as well as a sphere does. z_no_rattlers: z of the rest
/// among themselves; 0 if there is no rest.
std::vector<Measure> measure_coordination(const Metric& metric, const Packing& packing, const Scene& scene);

/// Of a bimodal law: N_L, the number of large spheres; X_L, their share of the volume (2D: area) of all spheres; P_NL,
/// their share by number. A sphere is large if its radius is no farther from R_L than from R_S; so at size ratio 1,
/// where nothing tells them apart, all are large, as the paper counts. Throws NotApplicable for other laws.
std::vector<Measure> measure_composition(const Metric& metric, const Packing& packing, const Scene& scene);

} // namespace tamp
