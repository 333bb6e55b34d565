#pragma once
/// Scenes by name: `seam-server crossing` from any folder, installed or in the source tree.

#include <string>
#include <vector>

namespace seam {

/// Returns the scene file for a word of the command line. A path (with '/' or ending in ".toml"),
/// the name of an existing file and "" are returned unchanged. Any other word NAME means the first
/// file NAME.toml in SceneFolders(); if there is none, throws OperatorError with the places
/// searched.
std::string FindScene(const std::string& word);

/// Returns the folders that are searched for scene names, in order: scenes, scenes/hard and
/// scenes/exact of the current folder, then the same three in ../share/seam2d relative to the
/// running program's folder: those installed, or of the source tree that it is built in.
std::vector<std::string> SceneFolders();

/// Returns the names that FindScene would find, sorted, except those in folders `hard` and `exact`.
std::vector<std::string> SceneNames();

}  // namespace seam
