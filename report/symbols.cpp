// The table of symbols.
#include "report/symbols.h"

#include <array>

namespace tamp {

namespace {

constexpr std::array kSymbols = {
    Symbol{"X", "$X$", "*X*"},
    Symbol{"N_part", "$N_{\\mathrm{part}}$", "*N*<sub>part</sub>"},
    Symbol{"N_PB", "$N_{P,B}$", "*N*<sub>P,B</sub>"},
    Symbol{"H", "$H$", "*H*"},
    Symbol{"H_N", "$H_N$", "*H*<sub>N</sub>"},
    Symbol{"H_S", "$H_S$", "*H*<sub>S</sub>"},
    Symbol{"H_V", "$H_V$", "*H*<sub>V</sub>"},
    Symbol{"H_N_floor", "$H_N^{\\mathrm{floor}}$", "*H*<sub>N</sub> floor"},
    Symbol{"H_S_floor", "$H_S^{\\mathrm{floor}}$", "*H*<sub>S</sub> floor"},
    Symbol{"H_V_floor", "$H_V^{\\mathrm{floor}}$", "*H*<sub>V</sub> floor"},
    Symbol{"K", "$K$", "*K*"},
    Symbol{"phi", "$\\varphi$", "φ"},
    Symbol{"phi_box", "$\\varphi_{\\mathrm{box}}$", "φ<sub>box</sub>"},
    Symbol{"phi_paper", "$\\varphi_{\\mathrm{paper}}$", "φ<sub>paper</sub>"},
    Symbol{"rho", "$\\rho$", "ρ"},
    Symbol{"R_L", "$R_L$", "*R*<sub>L</sub>"},
    Symbol{"R_S", "$R_S$", "*R*<sub>S</sub>"},
    Symbol{"N_L", "$N_L$", "*N*<sub>L</sub>"},
    Symbol{"X_L", "$X_L$", "*X*<sub>L</sub>"},
    Symbol{"P_NL", "$P_{N,L}$", "*P*<sub>N,L</sub>"},
    Symbol{"X_RVE", "$X_{\\mathrm{RVE}}$", "*X*<sub>RVE</sub>"},
    Symbol{"n", "$n$", "*n*"},
    Symbol{"N_min", "$N_{\\min}$", "*N*<sub>min</sub>"},
    Symbol{"N_max", "$N_{\\max}$", "*N*<sub>max</sub>"},
    Symbol{"a", "$a$", "*a*"},
    Symbol{"beta", "$\\beta$", "β"},
    Symbol{"beta_low", "$\\beta_{\\mathrm{low}}$", "β<sub>low</sub>"},
    Symbol{"beta_high", "$\\beta_{\\mathrm{high}}$", "β<sub>high</sub>"},
    Symbol{"R_squared", "$R^2$", "*R*²"},
    Symbol{"p_curved", "$p_{\\mathrm{curved}}$", "*p*<sub>curved</sub>"},
    Symbol{"t_over_fit", "$t/t_{\\mathrm{fit}}$", "*t*/*t*<sub>fit</sub>"},
    Symbol{"best method", "best method", "best method"},
    Symbol{"next method", "next method", "next method"},
    Symbol{"its value", "its value", "its value"},
    Symbol{"told apart", "told apart", "told apart"},
    Symbol{"points", "points", "points"},
    Symbol{"plateau", "plateau", "plateau"},
    Symbol{"tolerance", "tolerance", "tolerance"},
    Symbol{"spread", "spread bound", "spread bound"},
    Symbol{"time", "Time", "Time"},
    Symbol{"overlap_max", "$\\delta_{\\max}$", "δ<sub>max</sub>"},
    Symbol{"stable_alone", "$s_{\\mathrm{alone}}$", "*s*<sub>alone</sub>"},
    Symbol{"z", "$z$", "*z*"},
    Symbol{"r_mean", "$\\bar{r}$", "mean *r*"},
    Symbol{"r_sd", "$s_r$", "*s*<sub>r</sub>"},
    Symbol{"r_10", "$r_{10}$", "*r*<sub>10</sub>"},
    Symbol{"r_50", "$r_{50}$", "*r*<sub>50</sub>"},
    Symbol{"r_90", "$r_{90}$", "*r*<sub>90</sub>"},
    Symbol{"r_50_weighted", "$r_{50}^{\\mathrm{weighted}}$", "*r*<sub>50</sub> weighted"},
    Symbol{"r_min", "$r_{\\min}$", "*r*<sub>min</sub>"},
    Symbol{"r_max", "$r_{\\max}$", "*r*<sub>max</sub>"},
    Symbol{"phi_exp", "$\\varphi_{\\mathrm{exp}}$", "φ<sub>exp</sub>"},
    Symbol{"phi_close", "$\\varphi_{\\mathrm{close}}$", "φ<sub>close</sub>"},
    Symbol{"phi_minus_close", "$\\varphi-\\varphi_{\\mathrm{close}}$", "φ − φ<sub>close</sub>"},
    Symbol{"phi_error", "$\\Delta\\varphi/\\varphi$", "Δφ/φ"},
    Symbol{"phi_error_at_most", "$|\\Delta\\varphi|/\\varphi\\le$", "|Δφ|/φ ≤"},
    Symbol{"phi_scatter", "$s_\\varphi/\\varphi$", "*s*<sub>φ</sub>/φ"},
    Symbol{"phi_reference", "$\\varphi_0$", "φ<sub>0</sub>"},
    Symbol{"z_error", "$\\Delta z$", "Δ*z*"},
    Symbol{"H_error", "$\\Delta H$", "Δ*H*"},
    Symbol{"force_balance", "$\\bar{f}_{\\mathrm{net}}/\\bar{f}$", "*f*<sub>net</sub>/*f*"},
    Symbol{"order", "$p$", "*p*"},
    Symbol{"gravity", "gravity", "gravity"},
    Symbol{"inertia", "inertia", "inertia"},
    Symbol{"damping", "damping", "damping"},
    Symbol{"friction", "friction", "friction"},
    Symbol{"rotation", "rotation", "rotation"},
    Symbol{"adhesion", "adhesion", "adhesion"},
    Symbol{"rolling resistance", "rolling resistance", "rolling resistance"},
    Symbol{"ratio", "ratio", "ratio"},
    Symbol{"phi_difference", "$\\Delta\\varphi$", "Δφ"},
    Symbol{"default", "default", "default"},
    Symbol{"on the front", "on the front", "on the front"},
    Symbol{"for 1 %", "for 1\\,\\%", "for 1 %"},
    Symbol{"for 0.3 %", "for 0.3\\,\\%", "for 0.3 %"},
    Symbol{"for 0.1 %", "for 0.1\\,\\%", "for 0.1 %"},
    Symbol{"mu_ln", "$\\mu_{\\ln}$", "μ<sub>ln</sub>"},
    Symbol{"sigma_ln", "$\\sigma_{\\ln}$", "σ<sub>ln</sub>"},
};

constexpr std::string_view kOpen = "⟨";
constexpr std::string_view kClose = "⟩";

} // namespace

const Symbol* find_symbol(std::string_view name) {
  for (const Symbol& symbol : kSymbols) {
    if (symbol.name == name)
      return &symbol;
  }
  return nullptr;
}

std::string render_text(std::string_view text, const std::function<std::string(std::string_view)>& escape,
                        const std::function<std::string(const Symbol&)>& mark) {
  std::string out;
  std::size_t done = 0;
  for (std::size_t open = text.find(kOpen); open != text.npos; open = text.find(kOpen, open + kOpen.size())) {
    const std::size_t close = text.find(kClose, open);
    if (close == text.npos)
      break;
    const Symbol* symbol = find_symbol(text.substr(open + kOpen.size(), close - open - kOpen.size()));
    if (!symbol)
      continue;
    out += escape(text.substr(done, open - done)) + mark(*symbol);
    done = close + kClose.size();
  }
  return out + escape(text.substr(done));
}

std::string plain_text(std::string_view text) {
  return render_text(
      text, [](std::string_view words) { return std::string(words); },
      [](const Symbol& symbol) { return std::string(symbol.name); });
}

} // namespace tamp
