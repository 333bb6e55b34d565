#pragma once
/// A scene as data: ParseScene and LoadScene.

#include "common/base/check.h"
#include "common/scene/scene.h"
