/// The `table` and `math` libraries of a script, and a `pairs` with the same order in every run:
/// Lua's own order depends on addresses and a hash seeded by the clock.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

/// Sort key of a table entry. Its text belongs to Lua and does not move.
struct SortedKey {
  int place = 0;  ///< in the list of keys
  int kind = 0;   ///< 0 number, 1 text, 2 boolean
  double number = 0;
  lua_Integer integer = 0;  ///< exact; doubles beyond 2^53 are not
  const char* text = nullptr;
  std::size_t bytes = 0;
};

bool Before(const SortedKey& a, const SortedKey& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.kind != 1) return a.number != b.number ? a.number < b.number : a.integer < b.integer;
  const int order = std::memcmp(a.text, b.text, std::min(a.bytes, b.bytes));
  return order != 0 ? order < 0 : a.bytes < b.bytes;
}

SortedKey ReadKey(lua_State* L, int place) {
  SortedKey key;
  key.place = place;
  switch (lua_type(L, -1)) {
    case LUA_TNUMBER:
      key.number = lua_tonumber(L, -1);
      if (lua_isinteger(L, -1) != 0) key.integer = lua_tointeger(L, -1);
      return key;
    case LUA_TSTRING:
      key.kind = 1;
      key.text = lua_tolstring(L, -1, &key.bytes);
      return key;
    case LUA_TBOOLEAN:
      key.kind = 2;
      key.number = lua_toboolean(L, -1);
      return key;
    default:
      luaL_error(L, "pairs: a key is a %s, which has no order: use numbers, strings or booleans",
                 luaL_typename(L, -1));
      return key;
  }
}

/// Iterator of pairs. Upvalues: the table, its keys in order, the number of keys returned.
int NextInOrder(lua_State* L) {
  auto given = lua_tointeger(L, lua_upvalueindex(3));
  for (;;) {
    LuaCharge(L, 1);
    ++given;
    if (lua_rawgeti(L, lua_upvalueindex(2), given) == LUA_TNIL) return 1;
    lua_pushvalue(L, -1);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL) break;  // skips removed keys
    lua_pop(L, 2);
  }
  lua_pushinteger(L, given);
  lua_replace(L, lua_upvalueindex(3));
  return 2;
}

int Pairs(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 1);
  lua_newtable(L);  // 2: keys in Lua's order
  int count = 0;
  // A walk through an emptied table costs its former size, which Lua does not reveal.
  LuaCharge(L, 100);
  for (lua_pushnil(L); lua_next(L, 1) != 0;) {
    lua_pop(L, 1);
    lua_pushvalue(L, -1);
    lua_rawseti(L, 2, ++count);
    LuaCharge(L, 4);
  }
  const auto size = static_cast<std::size_t>(count);
  auto* keys = static_cast<SortedKey*>(lua_newuserdatauv(L, sizeof(SortedKey) * (size + 1), 0));
  for (int i = 0; i < count; ++i) {
    lua_rawgeti(L, 2, i + 1);
    keys[i] = ReadKey(L, i + 1);
    lua_pop(L, 1);
  }
  std::sort(keys, keys + size, Before);
  lua_pushvalue(L, 1);
  lua_createtable(L, count, 0);
  for (int i = 0; i < count; ++i) {
    lua_rawgeti(L, 2, keys[i].place);
    lua_rawseti(L, -2, i + 1);
  }
  lua_pushinteger(L, 0);
  lua_pushcclosure(L, NextInOrder, 3);
  return 1;
}

/// Returns the length of the list at 1. Refuses a `__len`: it could return another length when
/// Lua's own function calls it again.
std::int64_t PlainLength(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  if (luaL_getmetafield(L, 1, "__len") != LUA_TNIL) {
    luaL_error(L, "the functions of table want lists without __len");
  }
  return static_cast<std::int64_t>(lua_rawlen(L, 1));
}

int CallUpvalue(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

/// Charges insert and remove for moving the entries behind. A list with holes may have any length,
/// so the length measured here is charged.
int ChargedByLength(lua_State* L) {
  LuaCharge(L, PlainLength(L) / 2);
  return CallUpvalue(L);
}

/// Turns the optional range at `first` and `first` + 1 into numbers. Returns its length.
std::int64_t FixRange(lua_State* L, int first) {
  const std::int64_t length = PlainLength(L);
  lua_settop(L, first + 1);
  const lua_Integer from = luaL_optinteger(L, first, 1);
  const lua_Integer to = luaL_optinteger(L, first + 1, static_cast<lua_Integer>(length));
  constexpr lua_Integer kMax = 1 << 24;
  if (from < -kMax || from > kMax || to < -kMax || to > kMax) {
    luaL_error(L, "a list from %I to %I is out of bounds", from, to);
  }
  lua_pushinteger(L, from);
  lua_replace(L, first);
  lua_pushinteger(L, to);
  lua_replace(L, first + 1);
  return std::max<std::int64_t>(to - from + 1, 0);
}

int Concat(lua_State* L) {
  luaL_optstring(L, 2, "");
  LuaCharge(L, FixRange(L, 3));
  return CallUpvalue(L);
}

int Unpack(lua_State* L) {
  if (FixRange(L, 2) > kScriptValuesMax) {
    luaL_error(L, "more than %d values at once", kScriptValuesMax);
  }
  return CallUpvalue(L);
}

/// Comparisons written in Lua are counted while running; Lua's own are charged here: n log n.
int Sort(lua_State* L) {
  const auto length = static_cast<double>(PlainLength(L));
  LuaCharge(L, static_cast<std::int64_t>(std::min(2 * length * std::log2(length + 2), 1e12)));
  return CallUpvalue(L);
}

}  // namespace

void OpenLuaTable(lua_State* L) {
  lua_pushcfunction(L, luaopen_table);
  lua_call(L, 0, 1);
  const int all = lua_gettop(L);
  lua_newtable(L);
  LuaWrap(L, all, "insert", ChargedByLength);
  LuaWrap(L, all, "remove", ChargedByLength);
  LuaWrap(L, all, "concat", Concat);
  LuaWrap(L, all, "unpack", Unpack);
  LuaWrap(L, all, "sort", Sort);
  lua_getfield(L, all, "pack");
  lua_setfield(L, -2, "pack");
  lua_setglobal(L, "table");
  lua_pushcfunction(L, Pairs);
  lua_setglobal(L, "pairs");
  lua_settop(L, all - 1);
}

void OpenLuaMath(lua_State* L, std::uint64_t seed) {
  lua_pushcfunction(L, luaopen_math);
  lua_call(L, 0, 1);
  // Seeds math.random: equal numbers in every run with the same seed; no reseeding by the clock.
  lua_getfield(L, -1, "randomseed");
  lua_pushinteger(L, static_cast<lua_Integer>(seed));
  lua_pushinteger(L, 0x5ea3);
  lua_call(L, 2, 0);
  lua_pushnil(L);
  lua_setfield(L, -2, "randomseed");
  lua_setglobal(L, "math");
}

}  // namespace seam
