#include "server/script/script_lua_guard.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace seam {
namespace {

/// Instructions between two checks of the remaining work.
constexpr int kLookEvery = 200;
/// Upper bound of a string's header, bytes.
constexpr std::size_t kStringHeader = 64;
/// Bytes per unit of work: of allocated memory, and of memory scanned by the full collection that
/// follows each refused allocation.
constexpr std::size_t kMemoryBytesPerUnit = 64;
/// Units of work for a caught error: Lua makes its message, and walks all active calls to shrink
/// the stack.
constexpr std::int64_t kErrorUnits = 200;

void Look(lua_State* L, lua_Debug* /*where*/) {
  LuaGuard& guard = GuardOf(L);
  guard.work -= guard.spent ? 1 : kLookEvery;
  if (guard.work < 0 || guard.spent) LuaStopScript(L);
}

/// Returns the largest block of memory, which bounds the time of a single instruction (a call with
/// a long list of values, a step through an emptied table).
std::size_t BlockMax(const ScriptLimits& limits) {
  return std::max<std::size_t>(static_cast<std::size_t>(limits.memory_bytes) / 16, 65536);
}

bool TooMuch(const LuaGuard& guard, bool is_string, std::size_t more, std::size_t bytes) {
  if (guard.spent || guard.work < 0) return true;
  if (is_string && bytes > kScriptStringMax + kStringHeader) return true;
  if (bytes > BlockMax(guard.limits)) return true;
  return guard.memory + static_cast<std::int64_t>(more) > guard.limits.memory_bytes;
}

}  // namespace

void* LuaAllocate(void* user, void* block, std::size_t old_bytes, std::size_t new_bytes) {
  LuaGuard& guard = *static_cast<LuaGuard*>(user);
  // For a new block, `old_bytes` is the kind of its object.
  const std::size_t had = block != nullptr ? old_bytes : 0;
  if (new_bytes == 0) {
    std::free(block);
    guard.memory -= static_cast<std::int64_t>(had);
    return nullptr;
  }
  if (new_bytes > had && guard.charging) {
    guard.work -= static_cast<std::int64_t>(new_bytes / kMemoryBytesPerUnit);
    const bool is_string = block == nullptr && old_bytes == LUA_TSTRING;
    if (TooMuch(guard, is_string, new_bytes - had, new_bytes)) {
      guard.work -= guard.memory / static_cast<std::int64_t>(kMemoryBytesPerUnit);
      return nullptr;
    }
  }
  void* made = std::realloc(block, new_bytes);
  if (made == nullptr) return new_bytes <= had ? block : nullptr;  // shrinking must not fail
  guard.memory += static_cast<std::int64_t>(new_bytes) - static_cast<std::int64_t>(had);
  return made;
}

void LuaWatch(lua_State* L) { lua_sethook(L, Look, LUA_MASKCOUNT, kLookEvery); }

void LuaCharge(lua_State* L, std::int64_t units) {
  LuaGuard& guard = GuardOf(L);
  guard.work -= units;
  if (guard.work < 0 || guard.spent) LuaStopScript(L);
}

void LuaStopScript(lua_State* L) {
  LuaGuard& guard = GuardOf(L);
  if (!guard.spent) {
    guard.spent = true;
    LuaDescribeLimit(&guard);
    // Takes the line of the running function, or of the Lua function that called a C function.
    lua_Debug where;
    for (int level = 0; level < 4 && lua_getstack(L, level, &where) != 0; ++level) {
      lua_getinfo(L, "l", &where);
      if (where.currentline <= 0) continue;
      guard.line = where.currentline;
      break;
    }
  }
  // Code that still runs while unwinding (variables to be closed) stops at its first instruction.
  lua_sethook(L, Look, LUA_MASKCOUNT, 1);
  lua_pushnil(L);  // guard.why has the message: making one here could fail
  lua_error(L);
  std::abort();  // lua_error does not return
}

void LuaRefuse(lua_State* L, const char* what) {
  const char* file = GuardOf(L).scene_file;
  const std::size_t length = std::strlen(file);
  const bool placed = std::strncmp(what, file, length) == 0 && what[length] == ':';
  if (!placed) luaL_error(L, "%s", what);
  lua_pushstring(L, what);
  lua_error(L);
  std::abort();  // lua_error does not return
}

void LuaCheckStatus(lua_State* L, int status) {
  LuaGuard& guard = GuardOf(L);
  if (guard.spent || status == LUA_ERRMEM) LuaStopScript(L);
  if (status != LUA_OK && status != LUA_YIELD) LuaCharge(L, kErrorUnits);
}

void LuaDescribeLimit(LuaGuard* guard) {
  if (guard->work < 0) {
    std::snprintf(guard->why, sizeof guard->why, "more than %lld instructions in a tick",
                  static_cast<long long>(guard->limits.instructions));
    return;
  }
  std::snprintf(guard->why, sizeof guard->why,
                "out of memory: more than %lld kB in all, %lld kB in one table or %d bytes in one "
                "string",
                static_cast<long long>(guard->limits.memory_bytes / 1024),
                static_cast<long long>(BlockMax(guard->limits) / 1024),
                static_cast<int>(kScriptStringMax));
}

void LuaWrap(lua_State* L, int all, const char* name, lua_CFunction function) {
  lua_getfield(L, all, name);
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
}

}  // namespace seam
