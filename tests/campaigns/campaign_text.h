// Campaign texts for tests, and what reading them tells.
#pragma once

#include "campaigns/campaign.h"
#include "engine/base/error.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace tamp::test {

/// A valid campaign, one line a key, so that tests can change one thing and know its line.
inline const std::string kValid = R"({
  "campaign": "test",
  "scene": {
    "size": 133,
    "psd": {
      "law": "lognormal",
      "mu_ln": 0.30,
      "sigma_ln": 0.68,
      "r_min": 0.1,
      "r_max": 50
    }
  },
  "methods": ["drop-and-roll"],
  "sweep": {"grid": {"scene/psd/sigma_ln": [0.6, 0.68]}},
  "replicates": 2
})";

/// `text` with its only occurrence of `before` replaced.
inline std::string with(const std::string& text, std::string_view before, std::string_view after) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos || text.find(before, at + 1) != std::string::npos)
    throw std::logic_error("not exactly once in the text: " + std::string(before));
  std::string out = text.substr(0, at);
  out.append(after).append(text, at + before.size());
  return out;
}

/// kValid with one thing changed.
inline std::string valid_with(std::string_view before, std::string_view after) {
  return with(kValid, before, after);
}

/// The message of the InputError that reading `text` under the name c.json throws; empty if it throws none.
inline std::string error_of(std::string_view text) {
  try {
    read_campaign(text, "c.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace tamp::test
