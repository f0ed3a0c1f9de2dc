// From a choice at run time to a type.
#pragma once
#include <cstddef>

#include "kernels/traits.hpp"

namespace nanson {

/// Calls use.template operator()<value>() for the value of a choice.
template <class Choice, std::size_t at = 0, class Use>
auto with(Choice choice, Use use) {
  constexpr std::size_t count = words(Choice{}).size();
  if constexpr (at + 1 < count)
    if (static_cast<std::size_t>(choice) != at) return with<Choice, at + 1>(choice, use);
  return use.template operator()<static_cast<Choice>(at)>();
}

template <class Use>
auto with(bool choice, Use use) {
  return choice ? use.template operator()<true>() : use.template operator()<false>();
}

}  // namespace nanson
