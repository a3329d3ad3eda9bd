// The figures of the paper's tables, as printed, for the columns that tamp's own figures stand beside.
#pragma once

#include "engine/model/method.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tamp {

/// The source of every number of this file.
inline constexpr std::string_view kPaperCitation =
    "A. Tainturier, L. Lemarquis, V. Szczepan, M. Bernacki, \"Generation of representative powder particle packing in "
    "2D/3D: which tool for which application?\"";

/// The machine of the paper's times: one core, jobs one after the other.
inline constexpr std::string_view kPaperMachine = "Intel Core Ultra 7 155H";

/// What the paper calls packings of a method in its tables of the lognormal powder and of binary mixtures (empty: not
/// there). NANF: no adhesion, no friction.
struct PaperMethod {
  std::string_view lognormal;
  std::string_view bimodal;
};

/// By what runs, its name and the contact effects that its material calls for, whatever a campaign calls it. Under
/// gravity Lee2018 is friction (campaigns/lognormal-3d.json says why), in compression friction and adhesion. Both names
/// are empty where the paper has no such packings or it cannot be told.
PaperMethod paper_method(const Method& method);

/// What the method does otherwise than the paper's of that name, in words: "on_failure keep"; empty if nothing.
std::string other_protocol(const Method& method);

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

  /// The row of that name in the paper; nullptr if there is none.
  [[nodiscard]] const PaperRow* find(std::string_view paper_name) const;
  /// The row that packings of the method stand beside; nullptr if the paper has none.
  [[nodiscard]] const PaperRow* find(const Method& method) const { return find(paper_method(method).lognormal); }
};

std::span<const PaperTable> paper_tables();

/// Throws InputError for a name that no table has.
const PaperTable& paper_table(std::string_view name);

} // namespace tamp
