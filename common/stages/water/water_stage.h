#pragma once
/// Bodies of water as a stage: sensors in the contact pipeline say which bodies they hold.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

std::unique_ptr<Stage> MakeWaterStage(const StageWorld& world);

}  // namespace seam
