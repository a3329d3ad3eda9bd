// The figures of the paper's tables, as printed, for the columns that tamp's own figures stand beside.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tamp {

/// The source of every number of this file.
inline constexpr std::string_view kPaperCitation =
    "A. Tainturier, L. Lemarquis, V. Szczepan, M. Bernacki, \"Generation of representative powder particle packing in "
    "2D/3D: which tool for which application?\"";

/// The machine of the paper's times: one core, jobs one after the other.
inline constexpr std::string_view kPaperMachine = "Intel Core Ultra 7 155H";

/// A label of our campaigns for a discrete element method, and what the paper calls such packings in its tables of the
/// lognormal powder and of binary mixtures (empty: not there). NANF: no adhesion, no friction.
struct PaperMethod {
  std::string_view label;
  std::string_view lognormal;
  std::string_view bimodal;
};

/// nullptr for any other label: the paper then may have the label itself.
const PaperMethod* paper_method(std::string_view label);

/// A number with the digits after the point with which the paper prints it.
struct Printed {
  double value;
  int decimals;
};

/// One row. H is by number, and by surface (2D) or volume (3D); phi is the paper's estimator; the time is in seconds,
/// its decimals are those of the unit in which it is printed (report/number.h, time_unit).
struct PaperRow {
  std::string_view method;
  std::int64_t particles;
  Printed hellinger_number;
  Printed hellinger_weighted;
  Printed phi;
  std::int64_t particles_in_sub_box;
  Printed time_s;
};

/// A table of the paper and the scene it belongs to: a cube or square of edge X and a lognormal law of radii, in µm.
struct PaperTable {
  std::string_view name;  ///< of the report table that it is compared with
  std::string_view label; ///< in the paper's source
  int dimension;
  double edge_um;
  double mu_ln; ///< of radii in µm
  double sigma_ln;
  double r_min_um;
  double r_max_um;
  std::span<const PaperRow> rows;

  /// The row of a method label of ours; nullptr if the paper has none.
  [[nodiscard]] const PaperRow* find(std::string_view our_label) const;
};

std::span<const PaperTable> paper_tables();

/// Throws InputError for a name that no table has.
const PaperTable& paper_table(std::string_view name);

} // namespace tamp
