#pragma once
/// The parts of an imported body.

#include <string>
#include <vector>

#include "common/scene/mass.h"
#include "render/import/imported.h"
#include "render/import/outlines.h"

namespace seam {

/// A part, and its pose in its body's frame.
struct Placed {
  std::string name;
  PieceOutline piece;
  const ImportedShape* shape = nullptr;
  double density = 1;
};

/// Returns mass, centre and moment of inertia of a body of these parts.
MassProperties MassOf(const std::vector<Placed>& parts);

}  // namespace seam
