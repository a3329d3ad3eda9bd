// Text names of enumerations, declared once beside each enumeration and used by files, records and messages.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tamp {

/// Specialise with `static constexpr std::array<std::string_view, n> value{…}` in the order of the enumerators.
template <class E>
struct EnumNames;

/// The name of an enumerator.
template <class E>
constexpr std::string_view name_of(E e) {
  return EnumNames<E>::value[static_cast<std::size_t>(e)];
}

/// The enumerator of a name; nothing for an unknown name.
template <class E>
constexpr std::optional<E> enum_of(std::string_view name) {
  for (std::size_t i = 0; i < EnumNames<E>::value.size(); ++i) {
    if (EnumNames<E>::value[i] == name)
      return static_cast<E>(i);
  }
  return std::nullopt;
}

} // namespace tamp
