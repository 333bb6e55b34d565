#include "tests/lab/check/script_check.h"

#include <algorithm>

#include "common/base/nearest.h"
#include "common/scene/character.h"
#include "common/scene/part_rules.h"
#include "tests/lab/check/lua_words.h"

namespace seam {
namespace {

/// Lists the names of the sandbox, by library; _G: the global ones.
constexpr const char* kLister = R"(
function names()
  local all = {}
  for _, library in ipairs{"_G", "world", "string", "table", "math", "coroutine"} do
    local list = {}
    for name in pairs(_G[library]) do list[#list + 1] = name end
    all[library] = list
  end
  return all
end
)";

/// Adds the names of parts and joints that a script makes, as far as its text has them.
void AddMade(const ScriptSource& script, ScriptNames* names) {
  LuaWords words(script.code, script.line);
  words.Resolve();
  const auto add = [&](std::size_t at) {
    if (!words.IsText(at)) {
      names->any_part = true;
    } else if (words.Is(at + 1, "..")) {
      names->prefixes.push_back(words.at(at).text);
    } else {
      names->parts.push_back(words.at(at).text);
      names->joints.push_back(words.at(at).text);
    }
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& name = words.at(i).text;
    if (!words.IsName(i) || !words.Is(i - 1, ".")) continue;
    if (name == "hinge" || name == "distance") add(i + (words.Is(i + 1, "(") ? 2 : 1));
    if (name != "add_part" && name != "add_joint") continue;
    const std::size_t open = i + (words.Is(i + 1, "(") ? 2 : 1);
    bool named = false;
    const std::size_t close = words.Is(open, "{") ? words.CloseOf(open) : open;
    for (std::size_t k = open + 1; k < close; ++k) {
      if (words.Is(k, "{")) k = words.CloseOf(k);
      if (words.at(k).text != "name" || !words.Is(k + 1, "=")) continue;
      add(k + 2);
      named = true;
    }
    names->any_part = names->any_part || !named;
  }
}

}  // namespace

bool ScriptNames::MayBeMade(const std::string& name) const {
  return any_part || std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
           return name.compare(0, prefix.size(), prefix) == 0;
         });
}

ScriptNames NamesOf(const Scene& scene, ScriptHost& host) {
  ScriptNames names;
  for (const Part& part : scene.parts) names.parts.push_back(part.name);
  for (const Joint& joint : scene.joints) names.joints.push_back(joint.name);
  for (const Player& player : scene.players) names.players.push_back(player.name);
  for (const Character& each : scene.characters) {
    if (each.active) names.characters.push_back(each.name);
  }
  for (const Trigger& trigger : scene.triggers) names.triggers.push_back(trigger.name);
  for (const Seat& seat : scene.seats) names.seats.push_back(seat.name);
  names.keys = {"health", "score", "checkpoint", "laps", "taken"};
  for (int i = 0; i < 10; ++i) names.keys.push_back("value" + std::to_string(i));
  for (const ScriptSource& script : scene.scripts) AddMade(script, &names);
  // Lua itself knows its names best.
  Script lister({"names", kLister, 1, {}}, "names", 1, host);
  for (const TomlNode& all : lister.Ask("names", 0, 1)) {
    for (const auto& [library, list] : all.members) {
      for (const TomlNode& name : list.items) names.fields[library].push_back(name.text);
    }
  }
  return names;
}

std::string NameMistake(const ScriptNames& names, char kind, const std::string& name) {
  const auto check = [&name](const std::vector<std::string>& known, const char* what) {
    const bool is = std::find(known.begin(), known.end(), name) != known.end();
    return is ? std::string()
              : std::string("there is no ") + what + " '" + name + "'" + DidYouMean(name, known);
  };
  std::vector<std::string> subjects = names.parts;
  subjects.insert(subjects.end(), names.players.begin(), names.players.end());
  switch (kind) {
    case 'p': return names.MayBeMade(name) ? "" : check(names.parts, "part");
    case 'q': return names.MayBeMade(name) ? "" : check(subjects, "player or part");
    case 'j': return names.MayBeMade(name) ? "" : check(names.joints, "joint");
    case 'y': return check(names.players, "player");
    case 'c': return check(names.characters, "active character");
    case 'k': return check(names.keys, "value");
    case 'g': return check(names.triggers, "trigger");
    case 'e': return check(names.seats, "seat");
    case 'w': return check({"in", "out", "far", "taken"}, "news of a seat");
    default: return "";
  }
}

}  // namespace seam
