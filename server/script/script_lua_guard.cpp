#include "server/script/script_lua_guard.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace seam {
namespace {

/// Instructions between two looks at what is left.
constexpr int kLookEvery = 200;
/// A string's header is at most this, bytes.
constexpr std::size_t kStringHeader = 64;
/// A unit of work for so many bytes that are asked for, and for so many that a full collection,
/// which follows each refusal, looks at.
constexpr std::size_t kBytesPerUnit = 64;
/// Units of work for an error that is kept: its message is made, and Lua looks through all calls
/// that are under way in order to shrink the stack.
constexpr std::int64_t kErrorUnits = 200;

void Look(lua_State* L, lua_Debug* /*where*/) {
  LuaGuard& guard = GuardOf(L);
  guard.work -= guard.spent ? 1 : kLookEvery;
  if (guard.work < 0 || guard.spent) LuaSpend(L);
}

/// No block is larger than this, so that no single instruction (a call with a long list of values,
/// a step through an emptied table) takes long.
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
  // For a new block Lua says in `old_bytes` what it is for.
  const std::size_t had = block != nullptr ? old_bytes : 0;
  if (new_bytes == 0) {
    std::free(block);
    guard.memory -= static_cast<std::int64_t>(had);
    return nullptr;
  }
  if (new_bytes > had && guard.charging) {
    guard.work -= static_cast<std::int64_t>(new_bytes / kBytesPerUnit);
    const bool is_string = block == nullptr && old_bytes == LUA_TSTRING;
    if (TooMuch(guard, is_string, new_bytes - had, new_bytes)) {
      guard.work -= guard.memory / static_cast<std::int64_t>(kBytesPerUnit);
      return nullptr;
    }
  }
  void* made = std::realloc(block, new_bytes);
  if (made == nullptr) return new_bytes <= had ? block : nullptr;  // Lua counts on shrinking
  guard.memory += static_cast<std::int64_t>(new_bytes) - static_cast<std::int64_t>(had);
  return made;
}

void LuaWatch(lua_State* L) { lua_sethook(L, Look, LUA_MASKCOUNT, kLookEvery); }

void LuaCharge(lua_State* L, std::int64_t units) {
  LuaGuard& guard = GuardOf(L);
  guard.work -= units;
  if (guard.work < 0 || guard.spent) LuaSpend(L);
}

void LuaSpend(lua_State* L) {
  LuaGuard& guard = GuardOf(L);
  if (!guard.spent) {
    guard.spent = true;
    LuaExplain(&guard);
    // The line: of the function that runs, or, from a C function, of the one that called it.
    lua_Debug where;
    for (int level = 0; level < 4 && lua_getstack(L, level, &where) != 0; ++level) {
      lua_getinfo(L, "l", &where);
      if (where.currentline <= 0) continue;
      guard.line = where.currentline;
      break;
    }
  }
  // What still runs on the way out (variables to be closed) is stopped at its first instruction.
  lua_sethook(L, Look, LUA_MASKCOUNT, 1);
  lua_pushnil(L);  // the message is in the guard: to make one could fail
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

void LuaAfter(lua_State* L, int status) {
  LuaGuard& guard = GuardOf(L);
  if (guard.spent || status == LUA_ERRMEM) LuaSpend(L);
  if (status != LUA_OK && status != LUA_YIELD) LuaCharge(L, kErrorUnits);
}

void LuaExplain(LuaGuard* guard) {
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

}  // namespace seam
