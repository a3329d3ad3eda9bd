// Writes the scripts. LAMMPS's defaults that matter are stated, so that a script says what it does.
#include "engine/generate/lammps/lammps_script.h"

#include "engine/contact/damping.h"
#include "engine/contact/material.h"
#include "engine/contact/spin.h"
#include "engine/dem/scaled_inertia.h"
#include "engine/dem/settle_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

/// Radii further apart than this get collections of their own; each spans this factor.
constexpr double kCollection = 2;
/// Margin of the lists in median radii (of the distance of two spheres).
constexpr double kListMargin = 0.3;
/// Neighbours of the largest sphere: so many times the square of 1 + its size ratio to the smallest, as the smallest
/// ones may cover it. LAMMPS's own default is the least.
constexpr double kCover = 10;
constexpr double kFewestNeighbours = 2000;
/// A bed whose spheres have two contacts on average and little motion has its shape.
constexpr double kShapedContacts = 2;
/// Steps of a look at a bed that has its shape.
constexpr int kBedSteps = 400;
constexpr int kMostBedLooks = 1000;
/// Contacts that a sphere is counted to have beside those it has: with walls, and to come.
constexpr int kContactsToCome = 3;
/// Looks in a row at which the bed must be at rest.
constexpr int kRestLooks = 3;
/// Steps between two looks at the clock.
constexpr int kTimerSteps = 50;
/// Looks between two copies of the state, for those who stop a run.
constexpr int kSaveLooks = 20;

template <int D>
constexpr const char* kAxes = D == 2 ? "xy" : "xyz";

double largest(const std::vector<double>& radii) {
  return *std::max_element(radii.begin(), radii.end());
}
double smallest(const std::vector<double>& radii) {
  return *std::min_element(radii.begin(), radii.end());
}

bool is_disc(const SettleTask<2>& task) {
  return task.gyration == gyration<2>;
}
bool is_disc(const SettleTask<3>& /*task*/) {
  return false;
}

template <int D>
std::string walls(const SettleTask<D>& task, const std::string& law) {
  std::string out = "# Hard walls of the same material: floor, and sides where they are not periodic.\n";
  for (int a = 0; a < D; ++a) {
    const auto n = static_cast<std::size_t>(a);
    if (task.box.periodic[n])
      continue;
    const std::string high = task.box.wall[n][1] ? fmt::format("{:.17g}", task.box.size[a]) : "NULL";
    out += fmt::format("fix wall_{0} all wall/gran granular {1} {0}plane 0 {2}\n", kAxes<D>[a], law, high);
  }
  return out;
}

} // namespace

double lammps_median(std::vector<double> radii) {
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

std::string lammps_looks(std::string_view name, std::int64_t most, std::int64_t steps, std::string_view condition,
                         int times, std::string_view anew) {
  return fmt::format(R"(variable held equal 0
run 0 post no
label {0}
variable look_{0} loop {1}
variable before_height equal ${{height}}
variable before_contacts equal ${{contacts}}
{8}run {2} pre {9} post no
if "${{late}} == 1" then "variable ended string time" "jump SELF finish"
print "$(step) ${{kinetic}} ${{height}} ${{contacts}} ${{balance}} {0}" append {5} screen no
if "{3}" then "variable held equal ${{held}}+1" else "variable held equal 0"
if "${{held}} >= {4}" then "variable ended string rest" "jump SELF after_{0}"
if "$(v_look_{0}%{6}) == 0" then "write_dump all custom {7} id x y z radius modify sort id format float %.17g"
next look_{0}
jump SELF {0}
variable ended string gave-up
label after_{0}
)",
                     name, most, steps, condition, times, LammpsFiles::looks, kSaveLooks, LammpsFiles::state,
                     anew.empty() ? std::string() : fmt::format("{}\n", anew), anew.empty() ? "no" : "yes");
}

std::string lammps_drag(double rate) {
  return fmt::format(
      "variable drag_x atom -{0:.17g}*mass*vx\nvariable drag_y atom -{0:.17g}*mass*vy\nvariable drag_z atom "
      "-{0:.17g}*mass*vz\nfix drag all addforce v_drag_x v_drag_y v_drag_z\n",
      rate);
}

std::string lammps_deadline(double seconds) {
  if (!(seconds > 0))
    return "variable late equal 0\n";
  return fmt::format("\n# The state reached in this time is written, even if it is not at rest.\ntimer timeout {:.0f} "
                     "every {}\nvariable late equal timeremain<=0\n",
                     std::max(1.0, std::floor(seconds)), kTimerSteps);
}

std::string lammps_last_lines() {
  return fmt::format(
      "\nlabel finish\nprint \"${{ended}}\" file {} screen no\nwrite_dump all custom {} id x y z radius modify sort id "
      "format float %.17g\nwrite_restart {}\n",
      LammpsFiles::end, LammpsFiles::state, LammpsFiles::restart);
}

std::string lammps_neighbours(const std::vector<double>& radii, double reach) {
  const double low = smallest(radii);
  const double high = largest(radii);
  const bool multi = high / low > kCollection;
  std::string out = "# Neighbour lists: the margin is on the distance of two spheres; a list is made anew once one has "
                    "gone half of it.\n";
  out += fmt::format("neighbor {:.17g} {}\n", kListMargin * lammps_median(radii), multi ? "multi" : "bin");
  out += fmt::format("comm_modify mode {} vel yes\n", multi ? "multi" : "single");
  const double ratio = high / low;
  const double one =
      std::max(kFewestNeighbours,
               std::ceil(std::min(kCover * (1 + ratio) * (1 + ratio), 2 * static_cast<double>(radii.size()))));
  std::string modify = fmt::format("neigh_modify delay 0 every 1 check yes one {:.0f} page {:.0f}", one, 10 * one);
  if (multi) {
    std::vector<std::string> edges; // diameters, as LAMMPS wants them for finite spheres
    // Grids span the whole box: one for the finest spheres alone would have far more cells than there are spheres.
    for (double edge = 2 * std::max(low * kCollection, lammps_median(radii)); edge < 2 * high; edge *= kCollection)
      edges.push_back(fmt::format("{:.17g}", edge + reach));
    edges.push_back(fmt::format("{:.17g}", 2 * high * 1.01 + reach));
    modify += fmt::format(" collection/interval {} {}", edges.size(), fmt::join(edges, " "));
    out +=
        "# Spheres of similar size form collections with grids of their own: a single grid would be as coarse as the "
        "largest sphere.\n";
  }
  return out + modify + "\n";
}

template <int D>
std::string lammps_contact(const SettleTask<D>& task, double modulus) {
  const double young = 2 * (1 - task.poisson * task.poisson) * modulus; // E of two alike
  // LAMMPS's polynomial gives another restitution than it is told; this is what it must be told.
  const double told = lammps_restitution(damping_of_restitution(task.restitution));
  std::string normal = fmt::format("hertz/material {:.17g} {:.17g} {:.17g}", young, told, task.poisson);
  if (task.effects.adhesion != AdhesionLaw::none) // surface energy is half the work of adhesion
    normal =
        fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g}", task.effects.adhesion == AdhesionLaw::jkr ? "jkr" : "dmt",
                    young, told, task.poisson, task.adhesion / 2);
  std::string tangential = "linear_nohistory 0.0 0.0";
  if (task.effects.friction)
    tangential = fmt::format("mindlin NULL 1.0 {:.17g}", task.friction);
  else if (task.effects.adhesion == AdhesionLaw::jkr) // which needs a model with a memory for its own
    tangential = "mindlin NULL 0.0 0.0";
  return fmt::format("{} tangential {} damping tsuji", normal, tangential);
}

template <int D>
std::vector<std::string> lammps_styles(const SettleTask<D>& task) {
  std::vector<std::string> styles = {"atom sphere",    "pair granular",         "fix wall/gran",
                                     "fix gravity",    "fix addforce",          "compute contact/atom",
                                     "compute reduce", "compute property/atom", "compute pair/local"};
  styles.emplace_back(task.effects.friction ? "fix nve/sphere" : "fix nve");
  if (D == 2)
    styles.emplace_back("fix enforce2d");
  return styles;
}

template <int D>
std::string gravity_script(const SettleTask<D>& task, const LammpsStage& stage) {
  const std::string law = lammps_contact(task, stage.modulus);
  double weight = 0;
  for (const double m : task.masses)
    weight += m * task.gravity;
  std::string out =
      fmt::format("# {} spheres {} in {}D. Units: the mean radius, the density and gravity are 1.\n", task.radii.size(),
                  stage.first ? "fall from a loose start onto a floor and come to rest"
                              : "come to rest anew, with stiffer contacts",
                  D);
  // Where nothing turns, spheres need no spin; a neck between spheres (JKR) reaches out of the contact.
  const double reach = task.effects.adhesion == AdhesionLaw::jkr ? 0.1 * largest(task.radii) : 0;
  if (stage.first) {
    std::string boundary;
    for (int a = 0; a < D; ++a)
      boundary += task.box.periodic[static_cast<std::size_t>(a)] ? "p " : "f ";
    out += fmt::format("units lj\ndimension {}\natom_style sphere\nboundary {}\nnewton off\n", D,
                       boundary + (D == 2 ? "p" : ""));
    out += lammps_neighbours(task.radii, reach);
    out += fmt::format("read_data {}\n", LammpsFiles::start);
  } else {
    out += "newton off\n" + fmt::format("read_restart {}\n", LammpsFiles::restart);
    out += lammps_neighbours(task.radii, reach);
  }
  out += "\n# Contacts: E (of two alike with the effective modulus wanted), restitution as LAMMPS must be told it, "
         "Poisson's ratio.\n";
  out += fmt::format("pair_style granular\npair_coeff * * {}\n", law);
  out += walls(task, law);
  out += task.effects.friction ? fmt::format("fix motion all nve/sphere{}\n", is_disc(task) ? " disc" : "")
                               : "fix motion all nve # without friction nothing turns a sphere\n";

  // Spin does not count: without rolling resistance a loose sphere turns for ever.
  const char* volume =
      is_disc(task) ? "3.14159265358979323846*c_radius*c_radius" : "4.18879020478639098462*c_radius*c_radius*c_radius";
  out += fmt::format(R"(
# What is watched: mean kinetic energy (of translation) in weights times the mean radius, mean height, contacts of a
# sphere, and the balance of forces: root mean square of the net ones over the mean contact force.
compute radius all property/atom radius
compute finest all reduce min c_radius
compute place all property/atom x y z fx fy fz
compute touching all contact/atom
compute mean all reduce ave c_place[{1}] c_touching
compute net all reduce avesq c_place[4] c_place[5] c_place[6]
compute pairs all pair/local force
compute force all reduce ave c_pairs
variable kinetic equal ke/{0:.17g}
variable height equal c_mean[1]
variable contacts equal c_mean[2]
variable balance equal sqrt(c_net[1]+c_net[2]+c_net[3])/(c_force+(c_force==0)*1e-300)
thermo_style custom step ke v_kinetic v_height v_contacts v_balance c_finest
thermo_modify norm no # after thermo_style, which forgets it: ke is then of all spheres
)",
                     weight, D);
  const std::string plane = D == 2 ? "fix plane all enforce2d # the last fix\n" : "";
  out += fmt::format("timestep {:.17g}\n", stage.step) + lammps_deadline(stage.seconds);
  if (stage.first) {
    const auto steps = static_cast<std::int64_t>(std::ceil(std::sqrt(1 / task.gravity) / stage.step));
    const double fine = lammps_median(task.radii);
    out +=
        fmt::format("\n# The fall, until spheres have {} contacts on average and hardly move. Finer spheres than the "
                    "median one are denser, to allow its step; all fall alike.\nfix weight all gravity {:.17g} "
                    "vector {}\n{}run 0 post no\nvariable denser atom "
                    "{}*(1+(c_radius<{:.17g})*({:.17g}/(c_radius*c_radius)-1))\nset group all mass v_denser\n",
                    kShapedContacts, task.gravity, D == 2 ? "0 -1 0" : "0 0 -1", plane, volume, fine, fine * fine);
    out += lammps_looks("fall", stage.most_looks, std::max<std::int64_t>(1, steps),
                        fmt::format("${{kinetic}} < {} && ${{contacts}} >= {}", kShapedKinetic, kShapedContacts), 1);
    out += "unfix weight\n";
    if (D == 2)
      out += "unfix plane\n";
  }
  // k = 2 E* √(R δ) of a contact with an equal sphere; friction turns spheres, too: 1 + 5/2 of the tangential stiffness
  // 2(1−ν)/(2−ν) that Mindlin's law has beside it.
  const double shear = 2 * (1 - task.poisson) / (2 - task.poisson);
  const double stiffness =
      2 * stage.modulus * std::sqrt(0.5 * stage.overlap) * (task.effects.friction ? 1 + 2.5 * shear : 1);
  out += fmt::format(R"(
# The bed has its shape, and only rest counts. Weights stay; inertia is matched to the step: the least mass that keeps
# it stable is dt^2/2 times the stiffness of all contacts of a sphere. Each force is damped by a share of itself against
# the motion (local damping).
variable matched atom {0:.17g}*c_radius*(c_touching+{1})
variable weight atom -{2:.17g}*{3}
fix weight all addforce 0.0 {4}
variable damp_x atom -{5}*abs(fx)*vx/(abs(vx)+1e-300)
variable damp_y atom -{5}*abs(fy)*vy/(abs(vy)+1e-300)
variable damp_z atom -{5}*abs(fz)*vz/(abs(vz)+1e-300)
fix damping all addforce v_damp_x v_damp_y {6}
{7})",
                     kInertiaMargin * 0.5 * stage.step * stage.step * stiffness, kContactsToCome, task.gravity, volume,
                     D == 2 ? "v_weight 0.0" : "0.0 v_weight", kLocalDamping, D == 2 ? "0.0" : "v_damp_z", plane);
  std::string rests =
      fmt::format("${{balance}} < {:.17g} && ${{kinetic}} < {:.17g}",
                  stage.last ? task.force_balance : std::max(kStageBalance, task.force_balance), task.kinetic_energy);
  if (stage.last)
    rests +=
        fmt::format(" && $(abs(v_height-v_before_height)) < {:.17g} && $(abs(v_contacts-v_before_contacts)) < {:.17g}",
                    stage.height_drift, stage.contact_drift);
  out += fmt::format("# {}.\n", stage.last ? "At rest: forces balance, nothing moves, and height and contacts stay"
                                           : "Near balance, contacts are to be made stiffer");
  out +=
      lammps_looks("bed", kMostBedLooks, kBedSteps, rests, stage.last ? kRestLooks : 1, "set group all mass v_matched");
  return out + lammps_last_lines();
}

template std::string lammps_contact(const SettleTask<2>&, double);
template std::string lammps_contact(const SettleTask<3>&, double);
template std::vector<std::string> lammps_styles(const SettleTask<2>&);
template std::vector<std::string> lammps_styles(const SettleTask<3>&);
template std::string gravity_script(const SettleTask<2>&, const LammpsStage&);
template std::string gravity_script(const SettleTask<3>&, const LammpsStage&);

} // namespace tamp
