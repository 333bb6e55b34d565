#pragma once
/// What a script's Lua state may use up, and how its C functions are written. For script_lua*.cpp.
///
/// Lua leaves a C function by longjmp when it raises an error. So between the construction of a C++
/// object that has a destructor and its end nothing of Lua may be called that can raise: what comes
/// from Lua is read first, what goes to Lua is pushed last, and Attempt turns what our own code
/// throws into an error of the script.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <lua5.4/lua.hpp>

#include "common/scene/part_rules.h"
#include "server/script/script_host.h"

namespace seam {

/// Longest string of a script, bytes: what one instruction can compare or copy is bounded by it.
constexpr std::size_t kScriptStringMax = 16384;
/// Most values that one call returns or takes as a list.
constexpr int kScriptValuesMax = 200;
/// Most lines of text that a script may say in a tick.
constexpr int kScriptSaysMax = 8;
/// Most changes of the world (pushes, parts, joints) that a script may ask for in a tick.
constexpr int kScriptCommandsMax = 64;

/// Of one script; reached from any of its coroutines.
struct LuaGuard {
  explicit LuaGuard(ScriptHost& h, const ScriptLimits& l) : host(h), limits(l) {}

  ScriptHost& host;
  const ScriptLimits limits;
  const char* scene_file = "";
  bool charging = false;       ///< false while the state is being built
  bool spent = false;          ///< a limit was met: nothing of the script runs any more
  char why[160] = "";          ///< the limit
  int line = 0;                ///< where the last error was raised; 0: not known
  std::int64_t memory = 0;     ///< bytes in use
  std::int64_t work = 0;       ///< left in this tick
  int says = 0, commands = 0;  ///< in this tick
};

inline LuaGuard& GuardOf(lua_State* L) { return **static_cast<LuaGuard**>(lua_getextraspace(L)); }

/// lua_Alloc with a LuaGuard: counts, charges, and refuses what is too much.
void* LuaAllocate(void* guard, void* block, std::size_t old_bytes, std::size_t new_bytes);
/// Lets `L` and the coroutines made by it be interrupted when the work of a tick is done.
void LuaWatch(lua_State* L);
/// Charges `units` of work, an instruction each; raises when there is no more.
void LuaCharge(lua_State* L, std::int64_t units);
/// Ends the script: raises an error that no pcall keeps.
[[noreturn]] void LuaSpend(lua_State* L);
/// Which limit was met, as one line in guard.why: when the work is not done, it was memory.
void LuaExplain(LuaGuard* guard);
/// After what ran protected inside ended with `status`: raises again what must not be kept, and
/// charges for an error that is.
void LuaAfter(lua_State* L, int status);

/// Raises `what` with the script's line, unless it begins with its scene's name and a line.
[[noreturn]] void LuaRefuse(lua_State* L, const char* what);

/// Runs `f`, which may throw but must not raise; what it throws is raised as the script's error.
template <class F>
void Attempt(lua_State* L, F f) {
  char what[240];
  try {
    f();
    return;
  } catch (const std::exception& e) {
    std::snprintf(what, sizeof what, "%s", e.what());
  }
  LuaRefuse(L, what);
}

/// A finite number as argument; else raises.
float LuaNumber(lua_State* L, int argument);
/// Counts what changes the world: it becomes messages to every peer. Raises when it is too much.
void LuaCountCommand(lua_State* L);

/// The globals a script begins with. Require that nothing else was opened in `L`.
void OpenLuaBase(lua_State* L);   ///< script_lua_base.cpp: basics and coroutines
void OpenLuaText(lua_State* L);   ///< script_lua_text.cpp: string
void OpenLuaTable(lua_State* L);  ///< script_lua_table.cpp: table, and pairs in order
void OpenLuaMath(lua_State* L, std::uint64_t seed);  ///< script_lua_table.cpp: math
void OpenLuaWorld(lua_State* L);                     ///< script_lua_world.cpp: world, print
/// Adds to the table on top what makes and removes parts and joints (script_lua_make.cpp).
void AddLuaMaking(lua_State* L);

/// The value on top as a tree whose nodes say `line`, of at most `entries_max` entries
/// (script_lua_make.cpp). Raises nothing, but needs kLuaNodeSlots on the stack; throws
/// ScriptRefusal for what is no value of a scene.
TomlNode LuaNode(lua_State* L, int line, int entries_max);
constexpr int kLuaNodeSlots = 24;

}  // namespace seam
