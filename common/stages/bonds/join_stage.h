#pragma once
/// Finds connectors that meet.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

std::unique_ptr<Stage> MakeJoinStage(const StageWorld& world);

}  // namespace seam
