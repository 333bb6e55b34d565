/// The `world` library of a script, see docs/scripts.md: thin wrappers of ScriptHost.

#include <string>
#include <utility>

#include "common/topology/edit.h"
#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

int Tick(lua_State* L) {
  lua_pushinteger(L, HostOf(L).Tick());
  return 1;
}

int Time(lua_State* L) {
  const ScriptHost& host = HostOf(L);
  lua_pushnumber(L, static_cast<double>(host.Tick()) * static_cast<double>(host.dt()));
  return 1;
}

int ReadPart(lua_State* L) {
  const char* part = luaL_checkstring(L, 1);
  LuaCharge(L, 10);
  BodyState state;
  bool found = false;
  Attempt(L, [&] { found = HostOf(L).ReadPart(part, &state); });
  if (!found) return 0;
  lua_createtable(L, 0, 6);
  const std::pair<const char*, float> fields[] = {
      {"x", state.position.x()},  {"y", state.position.y()},  {"angle", state.angle},
      {"vx", state.velocity.x()}, {"vy", state.velocity.y()}, {"spin", state.spin}};
  for (const auto& [name, value] : fields) {
    lua_pushnumber(L, static_cast<double>(value));
    lua_setfield(L, -2, name);
  }
  return 1;
}

/// Pushes `text` if it begins with `prefix`; an empty prefix matches everything.
bool PushIfWanted(lua_State* L, const std::string& text, const char* prefix, std::size_t bytes) {
  LuaCharge(L, 2);
  if (text.compare(0, bytes, prefix, bytes) != 0) return false;
  lua_pushlstring(L, text.data(), text.size());
  return true;
}

int ListParts(lua_State* L) {
  std::size_t bytes = 0;
  const char* prefix = luaL_optlstring(L, 1, "", &bytes);
  const ScriptHost& host = HostOf(L);
  lua_settop(L, 1);
  lua_newtable(L);
  lua_Integer count = 0;
  for (std::size_t i = 0; i < host.PartCount(); ++i) {
    BodyState state;
    bool found = false;
    Attempt(L, [&] { found = host.ReadPart(host.PartName(i), &state); });
    if (found && PushIfWanted(L, host.PartName(i), prefix, bytes)) lua_rawseti(L, 2, ++count);
  }
  return 1;
}

int ListPlayers(lua_State* L) {
  const ScriptHost& host = HostOf(L);
  lua_settop(L, 0);
  lua_newtable(L);
  lua_Integer count = 0;
  for (std::size_t i = 0; i < host.PlayerCount(); ++i) {
    bool here = false;
    Attempt(L, [&] { here = host.Present(host.PlayerName(i)); });
    if (here && PushIfWanted(L, host.PlayerName(i), "", 0)) lua_rawseti(L, 1, ++count);
  }
  return 1;
}

int ReadInput(lua_State* L) {
  const char* player = luaL_checkstring(L, 1);
  LuaCharge(L, 10);
  Input input;
  Attempt(L, [&] { input = HostOf(L).ReadInput(player); });
  lua_pushnumber(L, static_cast<double>(input.drive) / 127);
  lua_pushnumber(L, static_cast<double>(input.lift) / 127);
  lua_pushinteger(L, input.buttons);
  return 3;
}

int SeatOf(lua_State* L) {
  const char* player = luaL_checkstring(L, 1);
  LuaCharge(L, 10);
  const std::string* seat = nullptr;
  Attempt(L, [&] { seat = &HostOf(L).SeatOf(player); });
  if (seat->empty()) return 0;
  lua_pushlstring(L, seat->data(), seat->size());
  return 1;
}

int Unseat(lua_State* L) {
  const char* player = luaL_checkstring(L, 1);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Unseat(player); });
  return 0;
}

int Push(lua_State* L, float scale, const char* why) {
  const char* part = luaL_checkstring(L, 1);
  const float x = LuaNumber(L, 2), y = LuaNumber(L, 3);
  why = luaL_optstring(L, 4, why);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Push(part, Vec2(x * scale, y * scale), why); });
  return 0;
}

/// limp(character [, seconds | true | false])
int Limp(lua_State* L) {
  const char* character = luaL_checkstring(L, 1);
  float seconds = kLimpUntilReleased;
  if (lua_isboolean(L, 2)) {
    seconds = lua_toboolean(L, 2) != 0 ? kLimpUntilReleased : -1;
  } else if (!lua_isnoneornil(L, 2)) {
    seconds = LuaNumber(L, 2);
    luaL_argcheck(L, seconds > 0, 2, "seconds above 0, true or false");
  }
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Limp(character, seconds); });
  return 0;
}

int Blast(lua_State* L) {
  const Vec2 centre(LuaNumber(L, 1), LuaNumber(L, 2));
  const float radius = LuaNumber(L, 3), speed = LuaNumber(L, 4);
  const float impulse = lua_isnoneornil(L, 5) ? 0.0f : LuaNumber(L, 5);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Blast(centre, radius, speed, impulse); });
  return 0;
}

int Impulse(lua_State* L) { return Push(L, 1, "impulse"); }
int Force(lua_State* L) { return Push(L, HostOf(L).dt(), "force"); }

int Get(lua_State* L) {
  const char* subject = luaL_checkstring(L, 1);
  const char* key = luaL_checkstring(L, 2);
  LuaCharge(L, 10);
  float value = 0;
  Attempt(L, [&] { value = HostOf(L).Get(subject, key); });
  lua_pushnumber(L, static_cast<double>(value));
  return 1;
}

int Set(lua_State* L) {
  const char* subject = luaL_checkstring(L, 1);
  const char* key = luaL_checkstring(L, 2);
  const float value = LuaNumber(L, 3);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Set(subject, key, value); });
  return 0;
}

/// score(player, more) and health(part, more): adds `more`, if given, and returns the new value.
int Change(lua_State* L, const char* key) {
  const char* subject = luaL_checkstring(L, 1);
  const bool changes = !lua_isnoneornil(L, 2);
  const float more = changes ? LuaNumber(L, 2) : 0;
  LuaCharge(L, 10);
  if (changes) LuaCountCommand(L);
  float value = 0;
  Attempt(L, [&] {
    value = HostOf(L).Get(subject, key);
    if (!changes) return;
    value += more;
    HostOf(L).Set(subject, key, value);
  });
  lua_pushnumber(L, static_cast<double>(value));
  return 1;
}

int Score(lua_State* L) { return Change(L, "score"); }
int Health(lua_State* L) { return Change(L, "health"); }

void SayLine(lua_State* L, const char* text) {
  LuaCharge(L, 100);
  if (++GuardOf(L).says > kScriptSaysMax) {
    luaL_error(L, "says more than %d lines in a tick", kScriptSaysMax);
  }
  Attempt(L, [&] { HostOf(L).Say(text); });
}

int Say(lua_State* L) {
  SayLine(L, luaL_checkstring(L, 1));
  return 0;
}

int Print(lua_State* L) {
  const int count = lua_gettop(L);
  luaL_checkstack(L, 4, nullptr);
  lua_pushliteral(L, "");
  for (int i = 1; i <= count; ++i) {
    if (i > 1) lua_pushliteral(L, " ");
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushvalue(L, i);
    lua_call(L, 1, 1);
    lua_concat(L, i > 1 ? 3 : 2);
  }
  SayLine(L, luaL_checkstring(L, -1));
  return 0;
}

}  // namespace

void OpenLuaWorld(lua_State* L) {
  const luaL_Reg functions[] = {{"tick", Tick},
                                {"time", Time},
                                {"part", ReadPart},
                                {"parts", ListParts},
                                {"players", ListPlayers},
                                {"input", ReadInput},
                                {"impulse", Impulse},
                                {"force", Force},
                                {"seat", SeatOf},
                                {"unseat", Unseat},
                                {"blast", Blast},
                                {"limp", Limp},
                                {"get", Get},
                                {"set", Set},
                                {"score", Score},
                                {"health", Health},
                                {"say", Say},
                                {nullptr, nullptr}};
  lua_newtable(L);
  luaL_setfuncs(L, functions, 0);
  AddLuaMaking(L);
  lua_setglobal(L, "world");
  lua_getglobal(L, "tostring");
  lua_pushcclosure(L, Print, 1);
  lua_setglobal(L, "print");
}

}  // namespace seam
