#pragma once
/// A scene of the user's as a case of `seam-lab physics`: judged by the exact answer that it
/// carries, or, without one, by its own run at 32 times the rate.

#include <string>
#include <vector>

#include "tests/lab/hard/hard_case.h"

namespace seam {

/// Longest run of a scene by default, s.
constexpr double kSceneSecondsMax = 60;

/// The case of a scene's file; its name is the file's without folder and ".toml", with '-' for what
/// is no letter, digit or '-'. `seconds`: 0: the scene's duration, at most kSceneSecondsMax. Calls
/// exact(t) at the times of ticks of 30, 60, 120 and 240 Hz and of the scene's own rate, and throws
/// OperatorError "file:line: what" for all that is wrong with the file, the scene or its answer.
HardCase SceneCase(const std::string& file, double seconds);

/// The same for several files. A file in a folder "hard" that hard cases are known of is those
/// cases. Throws OperatorError for two of one name, too.
std::vector<HardCase> SceneCases(const std::vector<std::string>& files, double seconds);

}  // namespace seam
