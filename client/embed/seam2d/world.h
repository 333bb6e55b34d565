#pragma once
/// A scene's world alone: LoneWorld, which can be saved, and World below it.

#include "client/embed/lone_world.h"
#include "common/physics/world.h"
#include "common/scene/scene.h"
