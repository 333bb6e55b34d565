#pragma once
/// Finds mistakes in the scripts of a scene: by their text, and by a run in a room without players.

#include <map>
#include <string>
#include <vector>

#include "server/script/script.h"
#include "tests/lab/check/scene_check.h"

namespace seam {

/// Names that scripts of a scene may use.
struct ScriptNames {
  std::vector<std::string> parts, joints, players, characters, triggers, seats;
  std::vector<std::string> keys;                           ///< of values
  std::map<std::string, std::vector<std::string>> fields;  ///< of libraries; "_G": global ones
  bool any_part = false;              ///< a script makes parts or joints of names not known here
  std::vector<std::string> prefixes;  ///< of parts and joints that a script makes, "shot."

  /// True if a script may make a part or joint of this name.
  bool MayBeMade(const std::string& name) const;
};

/// Returns the names in a scene, in the text of its scripts, and in the sandbox around a `host`.
ScriptNames NamesOf(const Scene& scene, ScriptHost& host);
/// Returns "there is no part 'gaet' (did you mean 'gate'?)"; "" for a name that may be right.
/// `kind`: p part, q player or part, j joint, y player, c active character, k key of a value, g
/// trigger, e seat, w news of a seat.
std::string NameMistake(const ScriptNames& names, char kind, const std::string& name);

/// Adds the mistakes in a script that Lua has compiled: of names and callbacks, and loops without
/// an end.
void FindInScriptWords(const ScriptNames& names, const ScriptSource& script,
                       std::vector<Finding>* findings);
/// Adds the mistakes in its calls of libraries: functions that are not there, wrong arguments.
void FindInScriptCalls(const ScriptNames& names, const ScriptSource& script,
                       std::vector<Finding>* findings);

}  // namespace seam
