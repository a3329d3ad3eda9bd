// Writes the scripts of a compression.
#include "engine/generate/lammps/isostatic_script.h"

#include "engine/generate/lammps/lammps_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

/// Strain rate of the compression in units of √(p/ρ)/r, the inertial number: below 1e-2 a flow of grains is
/// quasi-static (da Cruz et al., Phys. Rev. E 72, 021309, 2005).
constexpr double kInertialNumber = 5e-3;
/// Volume strain in a look while nothing resists.
constexpr double kStrainOfLook = 0.01;
/// Rate of the drag on the motion beside the box's in units of √(p/ρ)/r.
constexpr double kDrag = 1;
/// At rest spheres move with less than this energy, in units of p r³.
constexpr double kStill = 1e-4;

} // namespace

std::vector<std::string> isostatic_styles(int dimension) {
  std::vector<std::string> styles = {"atom sphere",  "pair granular",        "fix press/berendsen", "fix nve",
                                     "fix addforce", "compute contact/atom", "compute pressure",    "compute reduce"};
  if (dimension == 2)
    styles.emplace_back("fix enforce2d");
  return styles;
}

template <int D>
std::string isostatic_script(const SettleTask<D>& task, const IsostaticStage& stage) {
  const double beat = std::sqrt(stage.pressure); // √(p/ρ)/r
  const double rate = kInertialNumber * beat;
  const auto steps = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(kStrainOfLook / rate / stage.step)));
  std::string out =
      fmt::format("# {} spheres in a periodic box in {}D under the pressure {:g}. Units: the mean radius, "
                  "the density and the contacts' E* are 1.\n",
                  task.radii.size(), D, stage.pressure);
  if (stage.first) {
    out += fmt::format("units lj\ndimension {}\natom_style sphere\nboundary p p p\nnewton off\n", D);
    out += lammps_neighbours(task.radii, 0);
    out += fmt::format("read_data {}\n", LammpsFiles::start);
  } else {
    out += fmt::format("newton off\nread_restart {}\n", LammpsFiles::restart);
    out += lammps_neighbours(task.radii, 0);
  }
  out += fmt::format("\npair_style granular\npair_coeff * * {}\n", lammps_contact(task, task.modulus));
  out += "\ncompute touching all contact/atom\ncompute touches all reduce ave c_touching\n";
  out += fmt::format("variable kinetic equal ke/atoms/{:.17g}\nvariable height equal ln(vol)\nvariable contacts equal "
                     "c_touches\nvariable balance equal 0\nthermo_style custom step ke press vol c_touches v_kinetic "
                     "v_height\nthermo_modify norm no\n",
                     stage.pressure);
  out += "\n# The box follows the pressure; while nothing resists, it shrinks at a constant, quasi-static rate.\n";
  out +=
      fmt::format("fix motion all nve # without friction nothing turns a sphere\nfix squeeze all press/berendsen iso "
                  "{0:.17g} {0:.17g} {1:.17g} modulus 1.0 dilate all\n",
                  stage.pressure, stage.pressure / rate);
  out += lammps_drag(kDrag * beat);
  if (D == 2)
    out += "fix plane all enforce2d # the last fix\n";
  out += fmt::format("timestep {:.17g}\n", stage.step);
  out += lammps_deadline(stage.seconds);
  out += "\n# At rest: the volume (its logarithm), contacts and motion do not change any more.\n";
  out += lammps_looks("squeeze", stage.most_looks, steps,
                      fmt::format("${{kinetic}} < {:.17g} && ${{contacts}} > 1 && $(abs(v_height-v_before_height)) < "
                                  "{:.17g} && $(abs(v_contacts-v_before_contacts)) < {:.17g}",
                                  kStill, stage.stop_strain, stage.contact_drift),
                      3);
  return out + lammps_last_lines();
}

template std::string isostatic_script(const SettleTask<2>&, const IsostaticStage&);
template std::string isostatic_script(const SettleTask<3>&, const IsostaticStage&);

} // namespace tamp
