// The text of LAMMPS input scripts that compress a periodic box.
#pragma once

#include "engine/dem/settle.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tamp {

/// One run of LAMMPS, in units of the mean radius, the density and the contacts' modulus E*.
struct IsostaticStage {
  bool first = true;      ///< from the data file; else from the restart file
  double pressure = 0;    ///< on all axes
  double step = 0;        ///< dt
  double stop_strain = 0; ///< change of the volume in a look at which it rests, relative
  double contact_drift = 0;
  std::int64_t most_looks = 0;
  double seconds = 0; ///< that it may take; 0: any
};

/// The styles that such a script needs, as LammpsProgram names them.
std::vector<std::string> isostatic_styles(int dimension);

/// The script of a task whose box is periodic on every axis, with E* = task.modulus.
template <int D>
std::string isostatic_script(const SettleTask<D>& task, const IsostaticStage& stage);

extern template std::string isostatic_script(const SettleTask<2>&, const IsostaticStage&);
extern template std::string isostatic_script(const SettleTask<3>&, const IsostaticStage&);

} // namespace tamp
