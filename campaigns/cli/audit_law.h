// The size law by which an audit judges radii: stated in words, taken from a campaign, or fitted.
#pragma once

#include "engine/model/lognormal_fit.h"
#include "engine/model/packing_builder.h"

#include <optional>
#include <string>

namespace tamp::cli {

struct StatedLaw {
  Psd psd;
  std::optional<LengthUnit> unit; ///< of its lengths; nothing: the unit of each file
  std::string words;              ///< for the page
};

/// Of "lognormal,mu_ln=0.3,sigma_ln=0.68,r_min=0.1,r_max=50,unit=um": the law's name, then parameters as in campaign
/// files. Throws InputError saying what is wrong and what is allowed.
StatedLaw law_of_words(const std::string& words);

/// The powder of the first job of a campaign file. Throws InputError with the mistakes of the file.
StatedLaw law_of_campaign(const std::string& file);

/// Brings a packing that was read to the unit of the law: without a unit of its own it is taken to have the law's.
/// Throws InputError if the median radius then differs from the law's by a factor near 10³, 10⁶ or 10⁹: a mistaken
/// unit is likelier than such a powder. The message says which unit fits; `as_it_is` lets it pass.
void bring_to_unit(ReadPacking& read, const StatedLaw& law, const std::string& file, bool as_it_is);

} // namespace tamp::cli
