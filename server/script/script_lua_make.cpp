/// Script functions that add and remove parts and joints.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

/// Most nested tables, and most entries in all, of a part or joint that a script makes.
constexpr int kNestingMax = 4, kEntriesMax = 200;

int LineOf(lua_State* L) {
  lua_Debug where;
  if (lua_getstack(L, 1, &where) == 0) return 1;
  lua_getinfo(L, "l", &where);
  return where.currentline;
}

/// Converts the value on top to a scene node of at most `left` entries. Raises nothing; throws
/// ScriptRefusal.
TomlNode NodeAt(lua_State* L, int line, int depth, int* left) {
  TomlNode node;
  node.line = line;
  if (--*left < 0 || depth > kNestingMax || lua_checkstack(L, 4) == 0) {
    throw ScriptRefusal("the table is too large");
  }
  switch (lua_type(L, -1)) {
    case LUA_TBOOLEAN:
      node.kind = TomlNode::Kind::kBoolean;
      node.boolean = lua_toboolean(L, -1) != 0;
      return node;
    case LUA_TNUMBER:
      node.number = lua_tonumber(L, -1);
      node.kind = TomlNode::Kind::kNumber;
      if (lua_isinteger(L, -1) == 0) return node;
      node.kind = TomlNode::Kind::kInteger;
      node.integer = lua_tointeger(L, -1);
      return node;
    case LUA_TSTRING: {
      std::size_t bytes = 0;
      const char* text = lua_tolstring(L, -1, &bytes);
      node.kind = TomlNode::Kind::kText;
      node.text.assign(text, bytes);
      return node;
    }
    case LUA_TTABLE: break;
    default: throw ScriptRefusal(std::string("a ") + luaL_typename(L, -1) + " is no value here");
  }
  const auto length = lua_rawlen(L, -1);
  if (length > 0) {
    node.kind = TomlNode::Kind::kArray;
    if (length > static_cast<std::size_t>(*left)) throw ScriptRefusal("a list is too long");
    for (std::size_t i = 1; i <= length; ++i) {
      lua_rawgeti(L, -1, static_cast<lua_Integer>(i));
      node.items.push_back(NodeAt(L, line, depth + 1, left));
      lua_pop(L, 1);
    }
    return node;
  }
  node.kind = TomlNode::Kind::kTable;
  for (lua_pushnil(L); lua_next(L, -2) != 0;) {
    if (lua_type(L, -2) != LUA_TSTRING) throw ScriptRefusal("a key is no text");
    std::size_t bytes = 0;
    const char* key = lua_tolstring(L, -2, &bytes);
    std::string name(key, bytes);
    node.members.emplace_back(std::move(name), NodeAt(L, line, depth + 1, left));
    lua_pop(L, 1);
  }
  // Lua's own order depends on its hashes.
  std::sort(node.members.begin(), node.members.end(),
            [](const auto& x, const auto& y) { return x.first < y.first; });
  return node;
}

int Add(lua_State* L, void (ScriptHost::*add)(const TomlNode&)) {
  luaL_checktype(L, 1, LUA_TTABLE);
  LuaCountCommand(L);
  const int line = LineOf(L);
  lua_settop(L, 1);
  luaL_checkstack(L, kLuaNodeSlots, nullptr);
  Attempt(L, [&] { (HostOf(L).*add)(LuaNode(L, line, kEntriesMax)); });
  return 0;
}

int AddPart(lua_State* L) { return Add(L, &ScriptHost::AddPart); }
int AddJoint(lua_State* L) { return Add(L, &ScriptHost::AddJoint); }

/// hinge(name, a, b, x, y) and distance(name, a, b, length): short forms of the usual joints.
template <bool kAnchored>
int Join(lua_State* L, const char* kind) {
  const char* texts[] = {luaL_checkstring(L, 1), luaL_checkstring(L, 2), luaL_checkstring(L, 3)};
  const char* keys[] = {"name", "a", "b"};
  bool placed = !lua_isnoneornil(L, 4);
  float x = placed ? LuaNumber(L, 4) : 0;
  const float y = placed && kAnchored ? LuaNumber(L, 5) : 0;
  LuaCountCommand(L);
  const int line = LineOf(L);
  Attempt(L, [&] {
    const auto number = [line](float value) {
      TomlNode node;
      node.line = line;
      node.kind = TomlNode::Kind::kNumber;
      node.number = static_cast<double>(value);
      return node;
    };
    const auto text = [line](const char* value) {
      TomlNode node;
      node.line = line;
      node.kind = TomlNode::Kind::kText;
      node.text = value;
      return node;
    };
    BodyState from, to;
    if (!placed && !kAnchored && HostOf(L).ReadPart(texts[1], &from) &&
        HostOf(L).ReadPart(texts[2], &to)) {
      x = (to.position - from.position).norm();  // current distance, not the scene's
      placed = true;
    }
    TomlNode joint;
    joint.line = line;
    joint.kind = TomlNode::Kind::kTable;
    joint.members.emplace_back("kind", text(kind));
    for (int i = 0; i < 3; ++i) joint.members.emplace_back(keys[i], text(texts[i]));
    if (placed && kAnchored) {
      TomlNode anchor;
      anchor.line = line;
      anchor.kind = TomlNode::Kind::kArray;
      anchor.items = {number(x), number(y)};
      joint.members.emplace_back("anchor", anchor);
    } else if (placed) {
      joint.members.emplace_back("length", number(x));
    }
    HostOf(L).AddJoint(joint);
  });
  return 0;
}

int Weld(lua_State* L) {
  const char* a = luaL_checkstring(L, 1);
  const char* b = luaL_checkstring(L, 2);
  const float strength = lua_isnoneornil(L, 3) ? 0 : LuaNumber(L, 3);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Weld(a, b, strength); });
  return 0;
}
int Unweld(lua_State* L) {
  const char* a = luaL_checkstring(L, 1);
  const char* b = luaL_checkstring(L, 2);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).Unweld(a, b); });
  return 0;
}
int Hinge(lua_State* L) { return Join<true>(L, "revolute"); }
int Distance(lua_State* L) { return Join<false>(L, "distance"); }

int RemovePart(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).RemovePart(name); });
  return 0;
}

int RemoveJoint(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  LuaCountCommand(L);
  Attempt(L, [&] { HostOf(L).RemoveJoint(name); });
  return 0;
}

}  // namespace

TomlNode LuaNode(lua_State* L, int line, int entries_max) {
  static_assert(kLuaNodeSlots >= 4 * (kNestingMax + 2));
  return NodeAt(L, line, 0, &entries_max);
}

float LuaNumber(lua_State* L, int argument) {
  const auto number = static_cast<float>(luaL_checknumber(L, argument));
  luaL_argcheck(L, std::isfinite(number), argument, "a finite number expected");
  return number;
}

void LuaCountCommand(lua_State* L) {
  LuaCharge(L, 100);
  if (++GuardOf(L).commands <= kScriptCommandsMax) return;
  luaL_error(L, "more than %d changes of the world in a tick", kScriptCommandsMax);
}

void AddLuaMaking(lua_State* L) {
  const luaL_Reg functions[] = {{"add_part", AddPart},
                                {"add_joint", AddJoint},
                                {"weld", Weld},
                                {"unweld", Unweld},
                                {"hinge", Hinge},
                                {"distance", Distance},
                                {"remove_part", RemovePart},
                                {"remove_joint", RemoveJoint},
                                {nullptr, nullptr}};
  luaL_setfuncs(L, functions, 0);
}

}  // namespace seam
