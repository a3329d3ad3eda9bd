// Known reasons for differences from the paper, each with the condition under which it concerns a table.
#include "report/lognormal_table.h"
#include "report/notes.h"

#include <algorithm>
#include <array>

namespace tamp {

namespace {

bool any_ok(const NotesInput& input, bool (*holds)(const Job& job, const PaperTable& paper)) {
  return std::any_of(input.groups.begin(), input.groups.end(), [&](const RunGroup& group) {
    return group.ok_count() > 0 && input.lognormal->find(group.job().method) && holds(group.job(), *input.lognormal);
  });
}

bool is_paper_powder(const Job& job, const PaperTable& paper) {
  return likeness(job.scene, paper) != Likeness::other_powder;
}

bool is_paper_powder_3d(const Job& job, const PaperTable& paper) {
  return is_paper_powder(job, paper) && paper.dimension == 3;
}

bool redraws_under_lid_3d(const Job& job, const PaperTable& paper) {
  return is_paper_powder_3d(job, paper) && job.method.name == MethodName::drop_and_roll &&
         job.method.drop_and_roll.lid && job.method.drop_and_roll.on_failure == OnFailure::redraw;
}

struct Reason {
  bool (*holds)(const Job& job, const PaperTable& paper);
  const char* heading;
  const char* text;
};

constexpr std::array kReasons = {
    Reason{is_paper_powder, "Powder",
           "The paper's table of the powder prints mu_N 0.30, sigma_N 1.70, mean 1.30 and standard deviation 0.68; "
           "these are permuted. By the identities of the lognormal law exp(0.30 + 0.68²/2) = 1.70 and "
           "1.70 · sqrt(exp(0.68²) − 1) = 1.30, so ⟨mu_ln⟩ = 0.30, ⟨sigma_ln⟩ = 0.68, mean 1.70 µm, standard deviation "
           "1.30 µm are used."},
    Reason{is_paper_powder, "⟨H⟩ and its floor",
           "The paper calls ⟨H⟩ independent of the bins and names a number of them (40) only in an example. For a "
           "perfect random sampler "
           "E[⟨H_N⟩²] is about (⟨K⟩ − 1)/(8 ⟨N_part⟩) with ⟨K⟩ occupied bins, so ⟨H⟩ depends on ⟨K⟩ and ⟨N_part⟩ and a "
           "difference from the paper may be one of bins: compare each ⟨H⟩ with the floor beside it."},
    Reason{is_paper_powder_3d, "⟨H_V⟩ of the paper",
           "19 615 independent draws of this law over [0.1, 50] µm give ⟨H_V⟩ = 0.216 ± 0.028 in 80 bins and 0.180 ± "
           "0.029 "
           "in 40 (mean ± standard deviation of 300 simulations). The paper's 0.232 for D&R is compatible with the "
           "drawing of "
           "radii alone. Stratified drawing lowers it by about an eighth in 80 bins."},
    Reason{
        is_paper_powder, "Packing fraction",
        "The paper's estimator removes the caps that stick out of the sub-box and never adds those that stick in from "
        "outside, so in a homogeneous bed it is lower than ⟨phi⟩, less so where a wall keeps large centres inside. "
        "⟨phi_paper⟩ is for comparison with the paper; ⟨phi⟩ is the packing fraction."},
    Reason{
        redraws_under_lid_3d, "⟨N_part⟩",
        "After a sphere that ends above the lid a new radius is drawn, which fills the last gap under the lid with the "
        "fine tail of the law; keeping the radius stops earlier, with fewer particles. ⟨N_part⟩ in 3D depends strongly "
        "on this choice, and the fine particles beyond their share in the law raise ⟨H_N⟩ above its floor."},
};

} // namespace

std::vector<Note> protocol_notes(const NotesInput& input) {
  std::vector<Note> notes;
  if (!input.lognormal)
    return notes;
  for (const Reason& reason : kReasons) {
    if (any_ok(input, reason.holds))
      notes.push_back({reason.heading, reason.text});
  }
  return notes;
}

} // namespace tamp
