#pragma once
/// Resource limits of a script's Lua state, and rules for its C functions. For script_lua*.cpp.
///
/// Lua leaves a C function by longjmp when it raises an error. So no Lua function that can raise
/// may be called while a C++ object with a destructor is alive: read the arguments first and push
/// the results last. Attempt turns exceptions of our own code into errors of the script.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <lua5.4/lua.hpp>

#include "common/codec/lcm_types.h"
#include "common/scene/part_rules.h"
#include "server/script/saved_script.h"
#include "server/script/script_host.h"

namespace seam {

/// Longest string of a script, bytes: bounds the bytes that one instruction compares or copies.
constexpr std::size_t kScriptStringMax = 16384;
/// Most values that one call returns or takes as a list.
constexpr int kScriptValuesMax = 200;
/// Most lines of text from a script in a tick.
constexpr int kScriptSaysMax = 8;
/// Most changes of the world (pushes, parts, joints) by a script in a tick.
constexpr int kScriptCommandsMax = 64;

/// Limits and usage of one script; shared by its coroutines.
struct LuaGuard {
  explicit LuaGuard(ScriptHost& h, const ScriptLimits& l) : host(&h), limits(l) {}

  ScriptHost* host;
  const ScriptLimits limits;
  const char* scene_file = "";
  bool charging = false;       ///< false while the state is being built
  bool spent = false;          ///< a limit was exceeded: the script runs no more
  char why[160] = "";          ///< the exceeded limit
  int line = 0;                ///< line of the last error; 0: unknown
  std::int64_t memory = 0;     ///< bytes in use
  std::int64_t work = 0;       ///< units left in this tick
  int says = 0, commands = 0;  ///< in this tick
};

inline LuaGuard& GuardOf(lua_State* L) { return **static_cast<LuaGuard**>(lua_getextraspace(L)); }
inline ScriptHost& HostOf(lua_State* L) { return *GuardOf(L).host; }

/// The lua_Alloc function with a LuaGuard: counts, charges, and refuses above the limit.
void* LuaAllocate(void* guard, void* block, std::size_t old_bytes, std::size_t new_bytes);
/// Installs a hook that interrupts `L` and its coroutines when a tick's work is used up.
void LuaWatch(lua_State* L);
/// Charges `units` of work, one per instruction; raises if none is left.
void LuaCharge(lua_State* L, std::int64_t units);
/// Ends the script: raises an error that no pcall catches.
[[noreturn]] void LuaStopScript(lua_State* L);
/// Writes the exceeded limit as one line to guard.why: memory, unless the work is used up.
void LuaDescribeLimit(LuaGuard* guard);
/// Handles the `status` of a protected call inside the script: raises again an error that must not
/// be caught, and charges for one that may.
void LuaCheckStatus(lua_State* L, int status);

/// Raises `what` with the script's line as prefix, unless it already begins with the scene and a
/// line.
[[noreturn]] void LuaRefuse(lua_State* L, const char* what);

/// Runs `f`, which may throw but must not raise; an exception becomes the script's error.
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

/// Sets the field `name` of the table on top to `function`, with Lua's own from `all` as upvalue.
void LuaWrap(lua_State* L, int all, const char* name, lua_CFunction function);
/// Returns the argument, a finite number; else raises.
float LuaNumber(lua_State* L, int argument);
/// Counts a change of the world: each becomes messages to every peer. Raises above the limit.
void LuaCountCommand(lua_State* L);

/// Define the globals of a script. Require that no other library was opened in `L`.
void OpenLuaBase(lua_State* L);   ///< script_lua_base.cpp: basics and coroutines
void OpenLuaText(lua_State* L);   ///< script_lua_text.cpp: string
void OpenLuaTable(lua_State* L);  ///< script_lua_table.cpp: table, and pairs in order
void OpenLuaMath(lua_State* L, std::uint64_t seed);  ///< script_lua_table.cpp: math
void OpenLuaWorld(lua_State* L);                     ///< script_lua_world.cpp: world, print
/// Adds to the table on top the functions that make and remove parts and joints
/// (script_lua_make.cpp).
void AddLuaMaking(lua_State* L);

/// Returns the value on top as a tree with `line` in all nodes, of at most `entries_max` entries
/// (script_lua_make.cpp). Raises nothing, but needs kLuaNodeSlots on the stack; throws
/// ScriptRefusal for a value that a scene cannot hold.
TomlNode LuaNode(lua_State* L, int line, int entries_max);
constexpr int kLuaNodeSlots = 24;

// script_lua_room.cpp: the table `room`, and the state of math.random.
/// Returns the global table `room`; an empty table if there is none. Raises nothing; throws
/// ScriptRefusal, naming the key, for a value that cannot be saved.
ScriptValue ReadLuaRoom(lua_State* L);
/// Pushes the value. May raise an error of memory.
void PushLuaValue(lua_State* L, const ScriptValue& value);
/// Pushes a message as the table {name, text, utime, values}. May raise an error of memory.
void PushLuaMessage(lua_State* L, const LcmMessage& message);
/// Remembers the function math.random, on top, of which the next two get and set the state.
void KeepLuaRandom(lua_State* L);
SavedScript::Random LuaRandom(lua_State* L);
void SetLuaRandom(lua_State* L, const SavedScript::Random& random);

}  // namespace seam
