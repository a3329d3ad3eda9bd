// Random damage to files of packings.
#pragma once

#include "engine/base/random.h"

#include <string>
#include <vector>

namespace tamp::test {

/// One random change: a byte, a stretch that is lost or repeated, the end cut off, or a word in place of another.
inline void damage(std::string& bytes, RandomStream& random) {
  static const std::vector<std::string> words = {"nan",
                                                 "inf",
                                                 "-1",
                                                 "0",
                                                 "1e999",
                                                 "1e-320",
                                                 "1e308",
                                                 "",
                                                 "x",
                                                 ",",
                                                 "\n",
                                                 "99999999999999999999",
                                                 "-9223372036854775808",
                                                 "1e300",
                                                 "1e8",
                                                 "1e-8",
                                                 "1e4"};
  if (bytes.empty())
    return;
  const std::size_t at = random.below(bytes.size());
  const std::size_t length = 1 + random.below(20);
  switch (random.below(5)) {
  case 0:
    bytes[at] = static_cast<char>(random.below(256));
    break;
  case 1:
    bytes.erase(at, length);
    break;
  case 2:
    bytes.insert(random.below(bytes.size()), bytes.substr(at, length));
    break;
  case 3:
    bytes.resize(at);
    break;
  default: { // a whole word replaced
    const std::size_t begin = bytes.find_first_of("0123456789.", at);
    if (begin == std::string::npos)
      return;
    const std::size_t end = std::min(bytes.find_first_of(" ,\t\n\"", begin), bytes.size());
    bytes.replace(begin, end - begin, words[random.below(words.size())]);
  }
  }
}

} // namespace tamp::test
