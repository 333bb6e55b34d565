#pragma once
/// A JSON schema of scene files for editors' completion, learned from the loader: its tables and
/// keys, and the types and ranges with which it reads them.

#include <string>
#include <vector>

namespace seam {

/// Returns the schema (JSON Schema draft 7). A key that is read in none of the scenes has any type.
/// Throws OperatorError when a scene does not load, or there is none.
std::string SceneSchema(const std::vector<std::string>& scene_files);

/// Prints the schema learned from these scenes, files or names; without any from all that are found
/// by name. Returns the exit status.
int PrintSchema(const std::vector<std::string>& scenes);

}  // namespace seam
