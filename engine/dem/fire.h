// Constants of FIRE, the minimiser that follows the forces like a skier who turns uphill and stops.
#pragma once

namespace tamp {

/// FIRE 2.0 (Guénolé et al., Comput. Mater. Sci. 175, 109584, 2020; Bitzek et al., PRL 97, 170201, 2006), with its
/// published constants.
struct Fire {
  static constexpr double kGrow = 1.1;
  static constexpr double kShrink = 0.5;
  static constexpr double kMixing = 0.25;
  static constexpr double kMixingDecay = 0.99;
  static constexpr int kDelay = 20;
};

} // namespace tamp
