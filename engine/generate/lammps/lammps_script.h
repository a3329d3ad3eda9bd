// The text of LAMMPS input scripts, with comments, from a settling task.
#pragma once

#include "engine/dem/settle.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// Names of the files that a script reads and writes, all in its folder.
struct LammpsFiles {
  static constexpr const char* start = "start.data";
  static constexpr const char* state = "state.dump";
  static constexpr const char* restart = "state.restart";
  static constexpr const char* looks =
      "looks.txt"; ///< a line a look: step, kinetic energy, height, contacts, balance, phase
  static constexpr const char* end = "end.txt"; ///< "rest", "gave-up" or "time"
};

/// Radius below which spheres fall with more than their own mass: with m (median/r)², so that they may have the step of
/// the median one, as in the native engine (make_fines_denser).
double lammps_median(std::vector<double> radii);

/// Lines that set pair style, neighbour lists and communication up for spheres of these radii: `neighbor multi` with
/// collections a factor two apart where sizes differ, the finest reaching up to the median sphere at least, and room
/// for as many neighbours as the largest sphere can have.
std::string lammps_neighbours(const std::vector<double>& radii, double reach);

/// Runs `steps` steps look by look, until `condition` (of LAMMPS's `if`) has held at `times` looks in a row or `most`
/// looks are over; says which in the variable `ended`. Expects the variables kinetic, height, contacts and balance; the
/// values of the look before are v_before_height and v_before_contacts. Writes a line a look, and the state now and
/// then. `anew` is a command that changes spheres and comes before every look.
std::string lammps_looks(std::string_view name, std::int64_t most, std::int64_t steps, std::string_view condition,
                         int times, std::string_view anew = {});

/// A force of −rate times the momentum on every sphere, as fix `drag`.
std::string lammps_drag(double rate);

/// Lets LAMMPS end its looks after so many seconds and write its state; 0: never. Comes before lammps_looks.
std::string lammps_deadline(double seconds);

/// What every script ends with: how it ended, and the state.
std::string lammps_last_lines();

/// Coefficients after `pair_coeff * *` or `fix wall/gran granular`: Hertz, JKR or DMT of the task's material at the
/// stiffness `modulus` (E*), with Tsuji's damping told so that the restitution is the task's; Mindlin's friction, or
/// the tangential model that does nothing (LAMMPS must be given one) where there is none.
template <int D>
std::string lammps_contact(const SettleTask<D>& task, double modulus);

/// One run of LAMMPS.
struct LammpsStage {
  bool first = true;  ///< starts from the data file and follows the fall; else from the restart file
  double modulus = 0; ///< E*
  double step = 0;    ///< dt
  double overlap = 0; ///< expected of the deepest contacts, relative to the smaller radius
  bool last = true;   ///< ends at rest; else as soon as forces are near balance, to be stiffened
  double height_drift = 0;
  double contact_drift = 0;
  std::int64_t most_looks = 0; ///< of the fall
  double seconds = 0;          ///< that it may take; 0: any
};

/// The styles that a script of this task needs, as LammpsProgram names them.
template <int D>
std::vector<std::string> lammps_styles(const SettleTask<D>& task);

/// The script. Spheres fall in time, looked at once in the time one takes to fall half its radius (1 in BedUnits). Once
/// the bed has its shape only rest counts: as in the native engine (settle_run.h) inertia is then matched to the
/// stiffness of contacts, anew at every look, and motion damped by a share of the forces.
template <int D>
std::string gravity_script(const SettleTask<D>& task, const LammpsStage& stage);

extern template std::string lammps_contact(const SettleTask<2>&, double);
extern template std::string lammps_contact(const SettleTask<3>&, double);
extern template std::vector<std::string> lammps_styles(const SettleTask<2>&);
extern template std::vector<std::string> lammps_styles(const SettleTask<3>&);
extern template std::string gravity_script(const SettleTask<2>&, const LammpsStage&);
extern template std::string gravity_script(const SettleTask<3>&, const LammpsStage&);

} // namespace tamp
