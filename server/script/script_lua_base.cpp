/// Basic functions and coroutines of a script: Lua's own where these are harmless, replacements
/// where Lua's could hide an error from the limits, reach outside the sandbox, or differ between
/// runs.

#include <cstring>

#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

/// Metamethods that a script may define. Excluded: `__gc` and `__close`, which run uninterruptible,
/// and `__mode`, which could keep the collector busy.
constexpr const char* kMetamethods[] = {
    "__add",    "__sub",      "__mul",  "__div",      "__mod", "__pow",   "__unm",
    "__idiv",   "__band",     "__bor",  "__bxor",     "__shl", "__shr",   "__bnot",
    "__concat", "__len",      "__eq",   "__lt",       "__le",  "__index", "__newindex",
    "__call",   "__tostring", "__name", "__metatable"};

/// Work of catching an error: the stack shrinks and grows again.
constexpr std::int64_t kCatchUnits = 20;
/// Addresses that serve as registry keys.
const char kCopies = 0;

int FinishCall(lua_State* L, int status, lua_KContext /*context*/) {
  LuaCheckStatus(L, status);
  if (status == LUA_OK || status == LUA_YIELD) return lua_gettop(L);
  lua_pushboolean(L, 0);
  lua_insert(L, -2);
  return 2;
}

int ProtectedCall(lua_State* L) {
  luaL_checkany(L, 1);
  LuaCharge(L, kCatchUnits);
  lua_pushboolean(L, 1);
  lua_insert(L, 1);
  return FinishCall(L, lua_pcallk(L, lua_gettop(L) - 2, LUA_MULTRET, 0, 0, FinishCall), 0);
}

/// Moves `count` arguments to `co`, runs it, and moves its results back. Returns their number, or
/// -1 with the error on the stack.
int Run(lua_State* L, lua_State* co, int count) {
  if (lua_checkstack(co, count) == 0) {
    lua_pushliteral(L, "too many arguments to resume");
    return -1;
  }
  lua_xmove(L, co, count);
  int results = 0;
  const int status = lua_resume(co, L, count, &results);
  LuaCheckStatus(L, status);
  if (status != LUA_OK && status != LUA_YIELD) {
    lua_xmove(co, L, 1);
    return -1;
  }
  if (lua_checkstack(L, results + 1) == 0) {
    lua_pop(co, results);
    lua_pushliteral(L, "too many results to resume");
    return -1;
  }
  lua_xmove(co, L, results);
  return results;
}

int Resume(lua_State* L) {
  lua_State* co = lua_tothread(L, 1);
  luaL_argexpected(L, co != nullptr, 1, "coroutine");
  const int results = Run(L, co, lua_gettop(L) - 1);
  lua_pushboolean(L, results >= 0 ? 1 : 0);
  lua_insert(L, results >= 0 ? -(results + 1) : -2);
  return results >= 0 ? results + 1 : 2;
}

int RunWrapped(lua_State* L) {
  const int results = Run(L, lua_tothread(L, lua_upvalueindex(1)), lua_gettop(L));
  return results >= 0 ? results : lua_error(L);
}

int Wrap(lua_State* L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  lua_State* co = lua_newthread(L);
  lua_pushvalue(L, 1);
  lua_xmove(L, co, 1);
  lua_pushcclosure(L, RunWrapped, 1);
  return 1;
}

/// Like Lua's tostring, but without addresses: these differ between runs.
int ToString(lua_State* L) {
  luaL_checkany(L, 1);
  const int type = lua_type(L, 1);
  const bool addressed = type == LUA_TTABLE || type == LUA_TFUNCTION || type == LUA_TTHREAD ||
                         type == LUA_TUSERDATA || type == LUA_TLIGHTUSERDATA;
  if (addressed && luaL_getmetafield(L, 1, "__tostring") == LUA_TNIL) {
    if (luaL_getmetafield(L, 1, "__name") != LUA_TSTRING) lua_pushstring(L, luaL_typename(L, 1));
    return 1;
  }
  luaL_tolstring(L, 1, nullptr);
  return 1;
}

/// Pushes the copy that objects get instead of the metatable at 2, with allowed metamethods only.
/// Made at its first use.
void PushCopy(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kCopies);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, -2) == LUA_TTABLE) return;
  lua_pop(L, 1);
  lua_newtable(L);
  for (const char* name : kMetamethods) {
    lua_pushstring(L, name);
    lua_pushvalue(L, -1);
    lua_rawget(L, 2);
    lua_rawset(L, -3);
  }
  if (luaL_getmetafield(L, -1, "__metatable") != LUA_TNIL) lua_pop(L, 1);
  lua_pushliteral(L, "__metatable");
  if (lua_rawget(L, -2) == LUA_TNIL) {
    lua_pushvalue(L, 2);
    lua_setfield(L, -3, "__metatable");  // getmetatable returns the original
  } else {
    lua_pushboolean(L, 1);
    lua_rawseti(L, -3, 1);  // protected
  }
  lua_pop(L, 1);
  lua_pushvalue(L, 2);
  lua_pushvalue(L, -2);
  lua_rawset(L, -4);
}

int SetMetatable(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  luaL_argexpected(L, lua_isnil(L, 2) || lua_istable(L, 2), 2, "nil or table");
  if (lua_getmetatable(L, 1) != 0) {
    if (lua_rawgeti(L, -1, 1) != LUA_TNIL) return luaL_error(L, "cannot change this metatable");
  }
  lua_settop(L, 2);
  if (lua_istable(L, 2)) PushCopy(L);
  lua_setmetatable(L, 1);
  lua_settop(L, 1);
  return 1;
}

/// Copies the named fields of the table at `from` to the one on top of the stack.
void Take(lua_State* L, int from, const char* const* names, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    lua_getfield(L, from, names[i]);
    lua_setfield(L, -2, names[i]);
  }
}

void OpenCoroutines(lua_State* L) {
  constexpr const char* kTaken[] = {"create", "isyieldable", "running", "status", "yield"};
  lua_pushcfunction(L, luaopen_coroutine);
  lua_call(L, 0, 1);
  const int all = lua_gettop(L);
  lua_newtable(L);
  Take(L, all, kTaken, std::size(kTaken));
  const luaL_Reg ours[] = {{"resume", Resume}, {"wrap", Wrap}, {nullptr, nullptr}};
  luaL_setfuncs(L, ours, 0);
  lua_setglobal(L, "coroutine");
  lua_settop(L, all - 1);
}

}  // namespace

void OpenLuaBase(lua_State* L) {
  constexpr const char* kTaken[] = {"assert",   "error",    "getmetatable", "ipairs",
                                    "rawequal", "rawget",   "rawlen",       "rawset",
                                    "select",   "tonumber", "type",         "_VERSION"};
  // Lua's library goes into a table hidden from scripts.
  lua_pushcfunction(L, luaopen_base);
  lua_call(L, 0, 1);
  const int all = lua_gettop(L);
  lua_newtable(L);
  Take(L, all, kTaken, std::size(kTaken));
  const luaL_Reg ours[] = {{"pcall", ProtectedCall},
                           {"setmetatable", SetMetatable},
                           {"tostring", ToString},
                           {nullptr, nullptr}};
  luaL_setfuncs(L, ours, 0);
  lua_pushvalue(L, -1);
  lua_setfield(L, -2, "_G");
  lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  lua_settop(L, all - 1);
  lua_newtable(L);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &kCopies);
  OpenCoroutines(L);
}

}  // namespace seam
