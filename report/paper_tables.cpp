// The numbers of the paper's lognormal tables (its labels tab:2d-micro-block and tab:3d-micro-block).
#include "report/paper_tables.h"

#include "engine/base/error.h"

#include <fmt/format.h>

#include <array>

namespace tamp {

namespace {

// clang-format off
constexpr std::array kLognormal2d = {
    //       method            N_part   H_N         H_S         phi         N_PB   time (s; printed as 4.65 s, 32.2 min, 10.9 h …)
    PaperRow{"D&R",            20654, {0.030, 3}, {0.14, 2},  {0.811, 3}, 16546, {4.65, 2}},
    PaperRow{"D&R-ME",         20694, {0.036, 3}, {0.14, 2},  {0.823, 3}, 16578, {1932, 1}},
    PaperRow{"LAMMPS_Lee2018", 25557, {0.040, 3}, {0.12, 2},  {0.918, 3}, 21091, {39240, 1}},
    PaperRow{"LAMMPS_NANF",    25555, {0.040, 3}, {0.13, 2},  {0.918, 3}, 21090, {39240, 1}},
    PaperRow{"dp3D_Lee2018",   23041, {0.020, 3}, {0.088, 3}, {0.894, 3}, 18571, {64800, 1}},
    PaperRow{"dp3D_NANF",      23118, {0.020, 3}, {0.088, 3}, {0.901, 3}, 18653, {71640, 1}},
};
constexpr std::array kLognormal3d = {
    //       method            N_part   H_N         H_V         phi         N_PB   time
    PaperRow{"D&R",            19615, {0.030, 3}, {0.232, 3}, {0.636, 3}, 13214, {26, 0}},
    PaperRow{"D&R-ME",         19701, {0.038, 3}, {0.243, 3}, {0.639, 3}, 13163, {600, 1}},
    PaperRow{"LAMMPS_Lee2018", 28407, {0.038, 3}, {0.234, 3}, {0.668, 3}, 20610, {38880, 1}},
    PaperRow{"LAMMPS_NANF",    26726, {0.042, 3}, {0.219, 3}, {0.698, 3}, 19115, {43920, 1}},
    PaperRow{"dp3D_Lee2018",   26000, {0.069, 3}, {0.085, 3}, {0.584, 3}, 18899, {46080, 1}},
    PaperRow{"dp3D_NANF",      26000, {0.069, 3}, {0.085, 3}, {0.723, 3}, 18847, {92448, 2}},
};
// clang-format on

// The law's parameters as the identities of the lognormal law say they must be meant: the paper's Table 1 has its
// columns permuted (exp(0.30 + 0.68^2/2) = 1.70, its mean; 1.70 sqrt(exp(0.68^2) - 1) = 1.30, its standard deviation).
constexpr std::array kPaperTables = {
    PaperTable{"lognormal_2d", "tab:2d-micro-block", 2, 600, 0.30, 0.68, 0.1, 50, kLognormal2d},
    PaperTable{"lognormal_3d", "tab:3d-micro-block", 3, 133, 0.30, 0.68, 0.1, 50, kLognormal3d},
};

} // namespace

PaperMethod paper_method(const Method& method) {
  const bool friction = method.material.friction > 0;
  const bool adhesion = method.material.adhesion > 0;
  switch (method.name) {
  case MethodName::drop_and_roll:
    return {"D&R", "D&R"};
  case MethodName::drop_and_roll_me:
    return {"D&R-ME", ""};
  case MethodName::dem_gravity:
  case MethodName::lammps_gravity:
    if (adhesion && !friction)
      return {};
    return friction ? PaperMethod{"LAMMPS_Lee2018", ""} : PaperMethod{"LAMMPS_NANF", "LAMMPS"};
  case MethodName::dem_isostatic:
    if (friction != adhesion || stated(method.dem_isostatic.target_phi)) // the paper's are jammed
      return {};
    return friction ? PaperMethod{"dp3D_Lee2018", ""} : PaperMethod{"dp3D_NANF", "dp3D"};
  case MethodName::lammps_isostatic:
  case MethodName::lattice:
    break;
  }
  return {};
}

std::string other_protocol(const Method& method) {
  std::string words;
  const auto add = [&](bool differs, const std::string& what) {
    if (differs)
      words += (words.empty() ? "" : ", ") + what;
  };
  if (method.name == MethodName::drop_and_roll) {
    const DropAndRoll& ours = method.drop_and_roll;
    constexpr DropAndRoll kPaper; // the defaults are the paper's
    add(ours.on_failure != kPaper.on_failure, fmt::format("on_failure {}", name_of(ours.on_failure)));
    add(ours.lid != kPaper.lid, "no lid");
    add(ours.max_failures != kPaper.max_failures, fmt::format("max_failures {}", ours.max_failures));
  }
  add(method.hard, "widened until nothing overlaps");
  return words;
}

const PaperRow* PaperTable::find(std::string_view paper_name) const {
  for (const PaperRow& row : rows) {
    if (row.method == paper_name)
      return &row;
  }
  return nullptr;
}

std::span<const PaperTable> paper_tables() {
  return kPaperTables;
}

const PaperTable& paper_table(std::string_view name) {
  for (const PaperTable& table : kPaperTables) {
    if (table.name == name)
      return table;
  }
  throw InputError(fmt::format("the paper has no table for \"{}\"", name));
}

} // namespace tamp
