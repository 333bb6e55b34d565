#pragma once
/// Disagreement of peers: how far two of them show one body from each other.

#include <optional>

#include "common/record/recording.h"

namespace seam {

/// Returns the root mean square, m, over all ticks, pairs of peers, and bodies that both show at
/// that tick with the same parts, of the largest displacement of a point of the body between the
/// two views. nullopt: no two peers show a body at one tick. Throws OperatorError when the recorded
/// scene does not parse.
std::optional<double> PeersApart(const Recording& recording);

}  // namespace seam
