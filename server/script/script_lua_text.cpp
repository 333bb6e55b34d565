/// The `string` library of a script: without patterns, dumps and binary formats. Charged by length,
/// because the instruction count does not cover time spent in C functions.

#include <algorithm>
#include <cstring>

#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

/// Bytes per unit of work.
constexpr std::size_t kTextBytesPerUnit = 16;
/// Units per conversion of string.format: "%99.99f" of the largest number takes some microseconds.
constexpr std::int64_t kConversionUnits = 100;

void ChargeBytes(lua_State* L, std::size_t bytes) {
  LuaCharge(L, static_cast<std::int64_t>(bytes / kTextBytesPerUnit));
}

/// Charges for the text at 1, then calls Lua's own function, the upvalue.
int Charged(lua_State* L) {
  std::size_t bytes = 0;
  luaL_checklstring(L, 1, &bytes);
  ChargeBytes(L, bytes);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

/// string.byte(s, i, j): limits the range, because all values go on the stack.
int ByteAt(lua_State* L) {
  std::size_t bytes = 0;
  const char* text = luaL_checklstring(L, 1, &bytes);
  const auto size = static_cast<lua_Integer>(bytes);
  lua_Integer from = luaL_optinteger(L, 2, 1);
  if (from < 0) from = std::max<lua_Integer>(size + from + 1, 1);
  lua_Integer to = luaL_optinteger(L, 3, from);
  if (to < 0) to = size + to + 1;
  from = std::max<lua_Integer>(from, 1);
  to = std::min(to, size);
  if (from > to) return 0;
  if (to - from >= kScriptValuesMax) return luaL_error(L, "more than 200 bytes at once");
  const int count = static_cast<int>(to - from + 1);
  luaL_checkstack(L, count, nullptr);
  for (lua_Integer i = from; i <= to; ++i) {
    lua_pushinteger(L, static_cast<unsigned char>(text[i - 1]));
  }
  return count;
}

int CharOf(lua_State* L) {
  const int count = lua_gettop(L);
  if (count > kScriptValuesMax) return luaL_error(L, "more than 200 bytes at once");
  char text[kScriptValuesMax];
  for (int i = 1; i <= count; ++i) {
    const lua_Integer c = luaL_checkinteger(L, i);
    luaL_argcheck(L, c >= 0 && c <= 255, i, "not a byte");
    text[i - 1] = static_cast<char>(c);
  }
  lua_pushlstring(L, text, static_cast<std::size_t>(count));
  return 1;
}

int Repeat(lua_State* L) {
  std::size_t bytes = 0, between = 0;
  luaL_checklstring(L, 1, &bytes);
  const lua_Integer count = luaL_checkinteger(L, 2);
  luaL_optlstring(L, 3, "", &between);
  // Both are at most kScriptStringMax: neither the sum nor the product below overflows.
  const std::size_t each = std::max<std::size_t>(bytes + between, 1);
  if (count > 0 && static_cast<std::size_t>(count) > kScriptStringMax / each) {
    return luaL_error(L, "a string of more than %d bytes", static_cast<int>(kScriptStringMax));
  }
  ChargeBytes(L, count > 0 ? each * static_cast<std::size_t>(count) : 0);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, 1);
  return 1;
}

/// string.find(s, text, init): finds plain text only; `plain` is always true here.
int Find(lua_State* L) {
  std::size_t bytes = 0, wanted = 0;
  const char* text = luaL_checklstring(L, 1, &bytes);
  const char* what = luaL_checklstring(L, 2, &wanted);
  const auto size = static_cast<lua_Integer>(bytes);
  lua_Integer from = luaL_optinteger(L, 3, 1);
  if (from < 0) from = size + from + 1;
  from = std::max<lua_Integer>(from, 1);
  // In the worst case the whole text is compared at every position.
  ChargeBytes(L, bytes * std::max<std::size_t>(wanted, 1));
  if (from > size + 1) return 0;
  const char* at = std::search(text + from - 1, text + bytes, what, what + wanted);
  if (at == text + bytes && wanted > 0) return 0;
  const lua_Integer begin = at - text + 1;
  lua_pushinteger(L, begin);
  lua_pushinteger(L, begin + static_cast<lua_Integer>(wanted) - 1);
  return 2;
}

/// Calls Lua's string.format, with tables and functions as text without addresses, and no "%p".
int Format(lua_State* L) {
  std::size_t bytes = 0;
  const char* format = luaL_checklstring(L, 1, &bytes);
  ChargeBytes(L, bytes);
  for (std::size_t i = 0; i + 1 < bytes; ++i) {
    if (format[i] != '%') continue;
    ++i;
    LuaCharge(L, kConversionUnits);
    while (i < bytes && std::strchr("-+ #0123456789.", format[i]) != nullptr && format[i] != 0) ++i;
    if (i < bytes && format[i] == 'p') return luaL_error(L, "there are no addresses here");
  }
  const int count = lua_gettop(L);
  for (int i = 2; i <= count; ++i) {
    const int type = lua_type(L, i);
    if (type == LUA_TSTRING) ChargeBytes(L, lua_rawlen(L, i));
    if (type != LUA_TTABLE && type != LUA_TFUNCTION && type != LUA_TTHREAD) continue;
    lua_pushvalue(L, lua_upvalueindex(2));
    lua_pushvalue(L, i);
    lua_call(L, 1, 1);
    lua_replace(L, i);
  }
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, count, 1);
  return 1;
}

}  // namespace

void OpenLuaText(lua_State* L) {
  lua_pushcfunction(L, luaopen_string);
  lua_call(L, 0, 1);
  const int all = lua_gettop(L);
  lua_newtable(L);
  for (const char* name : {"len", "lower", "reverse", "sub", "upper"}) {
    LuaWrap(L, all, name, Charged);
  }
  LuaWrap(L, all, "rep", Repeat);
  lua_getfield(L, all, "format");
  lua_getglobal(L, "tostring");
  lua_pushcclosure(L, Format, 2);
  lua_setfield(L, -2, "format");
  const luaL_Reg ours[] = {{"byte", ByteAt}, {"char", CharOf}, {"find", Find}, {nullptr, nullptr}};
  luaL_setfuncs(L, ours, 0);
  // Methods such as ("x"):rep(3) use the same functions: Lua's own stay unreachable through the
  // metatable of strings.
  lua_pushliteral(L, "");
  lua_newtable(L);
  lua_pushvalue(L, -3);
  lua_setfield(L, -2, "__index");
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
  lua_setglobal(L, "string");
  lua_settop(L, all - 1);
}

}  // namespace seam
