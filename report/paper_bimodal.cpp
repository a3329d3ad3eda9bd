// The numbers of the paper's table of binary mixtures.
#include "report/paper_bimodal.h"

#include <array>

namespace tamp {

namespace {

// clang-format off
constexpr std::array kRows = {
    //              method   rho  outcome        N_P      P_NL           N_L    phi         time (s; printed as 5 s, 3.2 h …)
    PaperBimodalRow{"D&R",    1, "ok",           30000, {1.0, 1},       30000, {0.570, 3}, {5, 0}},
    PaperBimodalRow{"D&R",    2, "ok",           30000, {0.27, 2},       8182, {0.595, 3}, {6, 0}},
    PaperBimodalRow{"D&R",    5, "ok",           30000, {0.023, 3},       703, {0.632, 3}, {15, 0}},
    PaperBimodalRow{"D&R",   10, "ok",           33000, {0.0030, 4},      100, {0.720, 3}, {37, 0}},
    PaperBimodalRow{"D&R",   20, "ok",          270000, {0.00038, 5},     100, {0.751, 3}, {3540, 0}},
    PaperBimodalRow{"D&R",   40, "anomalous",  2140000, {0.000047, 6},    100, {0.644, 3}, {85680, 1}},
    PaperBimodalRow{"LAMMPS", 1, "ok",           30000, {1.0, 1},       30000, {0.657, 3}, {11520, 1}},
    PaperBimodalRow{"LAMMPS", 2, "ok",           30000, {0.27, 2},       8182, {0.670, 3}, {15120, 1}},
    PaperBimodalRow{"LAMMPS", 5, "ok",           30000, {0.023, 3},       703, {0.755, 3}, {19800, 1}},
    PaperBimodalRow{"LAMMPS", 10, "insufficient discretisation resolution"},
    PaperBimodalRow{"LAMMPS", 20, "insufficient discretisation resolution"},
    PaperBimodalRow{"LAMMPS", 40, "insufficient discretisation resolution"},
    PaperBimodalRow{"dp3D",   1, "ok",           30000, {1.0, 1},       30000, {0.664, 3}, {3960, 0}},
    PaperBimodalRow{"dp3D",   2, "ok",           30000, {0.27, 2},       8182, {0.692, 3}, {4680, 0}},
    PaperBimodalRow{"dp3D",   5, "ok",           30000, {0.023, 3},       703, {0.758, 3}, {6480, 0}},
    PaperBimodalRow{"dp3D",  10, "ok",           33000, {0.0030, 4},      100, {0.788, 3}, {7920, 1}},
    PaperBimodalRow{"dp3D",  20, "memory-limited"},
    PaperBimodalRow{"dp3D",  40, "memory-limited"},
};
// clang-format on

} // namespace

std::span<const PaperBimodalRow> paper_bimodal_rows() {
  return kRows;
}

const PaperBimodalRow* find_paper_bimodal(std::string_view paper_name, double size_ratio) {
  for (const PaperBimodalRow& row : kRows) {
    if (row.method == paper_name && row.size_ratio == size_ratio)
      return &row;
  }
  return nullptr;
}

const PaperBimodalRow* find_paper_bimodal(const Method& method, double size_ratio) {
  return find_paper_bimodal(paper_method(method).bimodal, size_ratio);
}

} // namespace tamp
