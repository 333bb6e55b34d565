/// The table `room` of a script, and the state of its random numbers, as plain data.

#include <algorithm>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

/// The address is a key of the registry.
const char kRandom = 0;

/// Bytes that a key or a value counts beside its text.
constexpr std::size_t kEntryBytes = 16;

using Kind = ScriptValue::Kind;

bool IsBefore(const std::pair<ScriptValue, ScriptValue>& x,
              const std::pair<ScriptValue, ScriptValue>& y) {
  return std::tie(x.first.kind, x.first.integer, x.first.text) <
         std::tie(y.first.kind, y.first.integer, y.first.text);
}

/// Reads a table of Lua, keeping the way to it for errors. Raises nothing.
class RoomReader {
 public:
  explicit RoomReader(lua_State* L) : L_(L) {}

  /// Returns the value on top.
  ScriptValue Read(const std::string& name) {
    ScriptValue value;
    Charge(name, kEntryBytes);
    switch (lua_type(L_, -1)) {
      case LUA_TBOOLEAN:
        value.kind = Kind::kBoolean;
        value.boolean = lua_toboolean(L_, -1) != 0;
        return value;
      case LUA_TNUMBER:
        value.kind = lua_isinteger(L_, -1) != 0 ? Kind::kInteger : Kind::kNumber;
        value.integer = lua_isinteger(L_, -1) != 0 ? lua_tointeger(L_, -1) : 0;
        value.number = value.kind == Kind::kNumber ? lua_tonumber(L_, -1) : 0;
        return value;
      case LUA_TSTRING: {
        value.kind = Kind::kText;
        std::size_t bytes = 0;
        const char* text = lua_tolstring(L_, -1, &bytes);
        Charge(name, bytes);
        value.text.assign(text, bytes);
        return value;
      }
      case LUA_TTABLE: ReadTable(name, &value); return value;
      default:
        throw ScriptRefusal(name + " is a " + luaL_typename(L_, -1) +
                            "; room keeps booleans, numbers, strings and tables of these");
    }
  }

 private:
  void ReadTable(const std::string& name, ScriptValue* value) {
    const void* const self = lua_topointer(L_, -1);
    if (std::find(path_.begin(), path_.end(), self) != path_.end()) {
      throw ScriptRefusal(name + " leads back to a table that it is in");
    }
    if (path_.size() >= kScriptRoomDepthMax || lua_checkstack(L_, 4) == 0) {
      throw ScriptRefusal(name + " is nested too deeply: room keeps " +
                          std::to_string(kScriptRoomDepthMax) + " tables within each other");
    }
    if (lua_getmetatable(L_, -1) != 0) {
      lua_pop(L_, 1);
      throw ScriptRefusal(name + " has a metatable; room keeps plain tables");
    }
    path_.push_back(self);
    for (lua_pushnil(L_); lua_next(L_, -2) != 0;) {
      ScriptValue key;
      const std::string entry = ReadKey(name, &key);
      value->entries.emplace_back(std::move(key), Read(entry));
      lua_pop(L_, 1);
    }
    path_.pop_back();
    // Lua's own order depends on its hashes.
    std::sort(value->entries.begin(), value->entries.end(), IsBefore);
  }

  /// Reads the key below the top. Returns the name of its entry.
  std::string ReadKey(const std::string& name, ScriptValue* key) {
    if (lua_isinteger(L_, -2) != 0) {
      key->kind = Kind::kInteger;
      key->integer = lua_tointeger(L_, -2);
      Charge(name, kEntryBytes);
      return name + "[" + std::to_string(key->integer) + "]";
    }
    if (lua_type(L_, -2) != LUA_TSTRING) {
      throw ScriptRefusal(name + " has a key that is a " + luaL_typename(L_, -2) +
                          "; room keeps strings and whole numbers as keys");
    }
    std::size_t bytes = 0;
    const char* text = lua_tolstring(L_, -2, &bytes);
    Charge(name, kEntryBytes + bytes);
    key->kind = Kind::kText;
    key->text.assign(text, bytes);
    return name + "." + key->text.substr(0, 40);
  }

  void Charge(const std::string& name, std::size_t bytes) {
    used_ += bytes;
    if (used_ <= kScriptRoomBytesMax) return;
    throw ScriptRefusal("room is too large at " + name + ": more than " +
                        std::to_string(kScriptRoomBytesMax / 1024) + " kB");
  }

  lua_State* L_;
  std::size_t used_ = 0;
  std::vector<const void*> path_;  // tables around the one that is read
};

/// Pushes the random state's address as a userdata of its four words.
std::uint64_t* RandomState(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kRandom);
  SEAM_ASSERT(lua_getupvalue(L, -1, 1) != nullptr);
  SEAM_ASSERT(lua_rawlen(L, -1) == sizeof(SavedScript::Random));
  return static_cast<std::uint64_t*>(lua_touserdata(L, -1));
}

}  // namespace

ScriptValue ReadLuaRoom(lua_State* L) {
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  // Looks for the name without making a string, which could fail.
  for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
    std::size_t bytes = 0;
    if (lua_type(L, -2) != LUA_TSTRING) continue;
    const char* name = lua_tolstring(L, -2, &bytes);
    if (bytes != 4 || std::memcmp(name, "room", 4) != 0) continue;
    ScriptValue room = RoomReader(L).Read("room");
    if (room.kind != Kind::kTable) throw ScriptRefusal("room is no table any more");
    lua_settop(L, 0);
    return room;
  }
  lua_settop(L, 0);
  return {};
}

void PushLuaValue(lua_State* L, const ScriptValue& value) {
  luaL_checkstack(L, 4, nullptr);
  switch (value.kind) {
    case Kind::kBoolean: return lua_pushboolean(L, value.boolean ? 1 : 0);
    case Kind::kInteger: return lua_pushinteger(L, value.integer);
    case Kind::kNumber: return lua_pushnumber(L, value.number);
    case Kind::kText: lua_pushlstring(L, value.text.data(), value.text.size()); return;
    case Kind::kTable: break;
  }
  lua_newtable(L);
  for (const auto& [key, entry] : value.entries) {
    PushLuaValue(L, key);
    PushLuaValue(L, entry);
    lua_rawset(L, -3);
  }
}

void PushLuaMessage(lua_State* L, const LcmMessage& message) {
  luaL_checkstack(L, 4, nullptr);
  lua_newtable(L);
  lua_pushlstring(L, message.name.data(), message.name.size());
  lua_setfield(L, -2, "name");
  lua_pushlstring(L, message.text.data(), message.text.size());
  lua_setfield(L, -2, "text");
  lua_pushinteger(L, message.utime);
  lua_setfield(L, -2, "utime");
  lua_newtable(L);
  for (std::size_t i = 0; i < message.value.size(); ++i) {
    lua_pushnumber(L, message.value[i]);
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setfield(L, -2, "values");
}

void KeepLuaRandom(lua_State* L) { lua_rawsetp(L, LUA_REGISTRYINDEX, &kRandom); }

SavedScript::Random LuaRandom(lua_State* L) {
  SavedScript::Random random{};
  std::memcpy(random.data(), RandomState(L), sizeof random);
  lua_settop(L, 0);
  return random;
}

void SetLuaRandom(lua_State* L, const SavedScript::Random& random) {
  std::memcpy(RandomState(L), random.data(), sizeof random);
  lua_settop(L, 0);
}

}  // namespace seam
