#pragma once
/// Iterates over the bodies of a mechanism.

#include <algorithm>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Calls `visit` with the ids of a mechanism's assemblies, which are its bodies' ids, ascending.
/// `mechanism`: index into Composition::mechanisms.
template <class Visit>
void EachIdOf(const Composition& composition, int mechanism, const Visit& visit) {
  for (const int a : composition.mechanisms[static_cast<std::size_t>(mechanism)].assemblies) {
    visit(composition.assemblies[static_cast<std::size_t>(a)].id);
  }
}

/// Returns true if `is` holds for any of these ids.
template <class Is>
bool AnyIdOf(const Composition& composition, int mechanism, const Is& is) {
  const auto& all = composition.mechanisms[static_cast<std::size_t>(mechanism)].assemblies;
  return std::any_of(all.begin(), all.end(), [&](int a) {
    return is(composition.assemblies[static_cast<std::size_t>(a)].id);
  });
}

}  // namespace seam
