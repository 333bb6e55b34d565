/// Life of a script: loading, calls, stopping.

#include <algorithm>
#include <cstring>
#include <utility>

#include "server/script/lua_hint.h"
#include "server/script/quiet_host.h"
#include "server/script/script.h"
#include "server/script/script_lua_guard.h"

namespace seam {
namespace {

/// Compiling the code and running it once may take the work of so many ticks.
constexpr std::int64_t kLoadTicks = 10;
/// Most entries of an answer's tables: poses of some thousand parts.
constexpr int kAnswerEntriesMax = 20000;

/// Message handler: records the line of an error and returns the error unchanged.
int NoteLine(lua_State* L) {
  LuaGuard& guard = GuardOf(L);
  if (guard.spent) return 1;
  guard.line = 0;
  lua_Debug where;
  for (int level = 0; level < 16 && lua_getstack(L, level, &where) != 0; ++level) {
    lua_getinfo(L, "l", &where);
    if (where.currentline <= 0) continue;
    guard.line = where.currentline;
    break;
  }
  return 1;
}

/// Returns the line on which the function on top begins; 1 for a C function.
int BeginOf(lua_State* L) {
  lua_Debug about;
  lua_pushvalue(L, -1);
  lua_getinfo(L, ">S", &about);
  return std::max(about.linedefined, 1);
}

int OpenAll(lua_State* L) {
  OpenLuaBase(L);
  OpenLuaText(L);
  OpenLuaTable(L);
  OpenLuaMath(L, static_cast<std::uint64_t>(lua_tointeger(L, 1)));
  OpenLuaWorld(L);
  lua_newtable(L);
  lua_setglobal(L, "room");
  return 0;
}

/// Returns a script's text as one printable line, safe to print and publish.
std::string Plain(const char* text, std::size_t bytes) {
  std::string out(text, std::min<std::size_t>(bytes, 200));
  for (char& c : out) {
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

/// Feeds the code to Lua after as many newlines as the scene file has lines before it.
struct Source {
  const std::string& code;
  std::string before;
  int given = 0;
};
const char* NextPiece(lua_State* /*L*/, void* user, std::size_t* bytes) {
  auto& source = *static_cast<Source*>(user);
  const std::string& piece = source.given == 0 ? source.before : source.code;
  *bytes = source.given < 2 ? piece.size() : 0;
  ++source.given;
  return *bytes > 0 ? piece.c_str() : nullptr;
}

}  // namespace

struct Script::Impl {
  Impl(const ScriptSource& s, const std::string& file, ScriptHost& host)
      : source(s), scene_file(file), guard(host, s.limits) {
    guard.scene_file = scene_file.c_str();
  }
  ~Impl() { Close(); }

  void Close() {
    if (state != nullptr) lua_close(std::exchange(state, nullptr));
  }

  void Open(std::uint64_t seed) {
    state = lua_newstate(LuaAllocate, &guard);
    if (state == nullptr) return Stop(source.line, "out of memory");
    *static_cast<LuaGuard**>(lua_getextraspace(state)) = &guard;
    lua_pushcfunction(state, OpenAll);
    lua_pushinteger(state, static_cast<lua_Integer>(seed));
    if (lua_pcall(state, 1, 0, 0) != LUA_OK) return Stop(source.line, "out of memory");
    LuaWatch(state);
    guard.charging = true;
  }

  void Load() {
    guard.work = kLoadTicks * guard.limits.instructions;
    // The first character must precede the code: at the very start, Lua would skip a '#' line or
    // accept binary code. Mode "t" allows text only.
    const auto lines = static_cast<std::size_t>(std::max(source.line - 1, 0));
    Source reader{source.code, lines > 0 ? std::string(lines, '\n') : " "};
    const std::string chunk = "=" + scene_file;
    lua_settop(state, 0);
    lua_pushcfunction(state, NoteLine);
    const int status = lua_load(state, NextPiece, &reader, chunk.c_str(), "t");
    if (status != LUA_OK) return Fail(status, source.line);
    compiled = true;
    Call(0, source.line);
  }

  void Resume(std::uint64_t seed, const SavedScript& saved) {
    if (saved.stopped) {
      error = saved.error;
      return;
    }
    QuietHost quiet(*guard.host);
    ScriptHost* const host = std::exchange(guard.host, &quiet);
    Open(seed);
    if (state != nullptr) SetRoom(saved.room);
    if (state != nullptr) Load();
    if (state != nullptr) SetLuaRandom(state, saved.random);
    guard.host = host;
  }

  void SetRoom(const ScriptValue& room) {
    guard.work = kLoadTicks * guard.limits.instructions;
    lua_settop(state, 0);
    lua_pushcfunction(state, NoteLine);
    lua_pushcfunction(state, [](lua_State* L) {
      PushLuaValue(L, *static_cast<const ScriptValue*>(lua_touserdata(L, 1)));
      lua_setglobal(L, "room");
      return 0;
    });
    lua_pushlightuserdata(state, const_cast<ScriptValue*>(&room));
    Call(1, source.line);
  }

  SavedScript Save() {
    SavedScript saved;
    if (state != nullptr) {
      lua_settop(state, 0);
      try {
        saved.room = ReadLuaRoom(state);
        saved.random = LuaRandom(state);
      } catch (const ScriptRefusal& refusal) {
        // It names keys, which may be any bytes.
        Stop(source.line, Plain(refusal.what(), std::strlen(refusal.what())));
      }
    }
    saved.stopped = state == nullptr;
    saved.error = error;
    return saved;
  }

  /// Calls the function below the `count` arguments on the stack, above NoteLine at index 1.
  void Call(int count, int line) {
    guard.line = 0;
    const int status = lua_pcall(state, count, 0, 1);
    if (status != LUA_OK) return Fail(status, line);
    lua_settop(state, 0);
  }

  /// Returns 0 if there is no such global, -1 if it is not a function, 1 for a C function.
  int LineOf(const char* function) {
    if (state == nullptr || guard.spent) return 0;
    lua_settop(state, 0);
    lua_pushcfunction(state, [](lua_State* L) {
      lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
      lua_pushstring(L, static_cast<const char*>(lua_touserdata(L, 1)));
      const int type = lua_rawget(L, -2);
      lua_pushinteger(L, type == LUA_TFUNCTION ? BeginOf(L) : type == LUA_TNIL ? 0 : -1);
      return 1;
    });
    lua_pushlightuserdata(state, const_cast<char*>(function));
    const bool good = lua_pcall(state, 1, 1, 0) == LUA_OK;
    const int line = good ? static_cast<int>(lua_tointeger(state, -1)) : 0;
    lua_settop(state, 0);
    return line;
  }

  struct Question {
    const char* function;
    double argument;
    int results;
    std::vector<TomlNode> answer;
  };

  std::vector<TomlNode> Ask(const char* function, double argument, int results) {
    const int line = LineOf(function);
    if (line <= 0) return {};
    guard.work = guard.limits.instructions;
    Question question{function, argument, results, {}};
    lua_pushcfunction(state, NoteLine);
    lua_pushcfunction(state, [](lua_State* L) {
      auto& q = *static_cast<Question*>(lua_touserdata(L, 1));
      lua_settop(L, 0);
      luaL_checkstack(L, q.results + kLuaNodeSlots, nullptr);
      lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
      lua_pushstring(L, q.function);
      if (lua_rawget(L, 1) != LUA_TFUNCTION) return 0;
      const int first = BeginOf(L);
      GuardOf(L).line = first;
      lua_pushnumber(L, q.argument);
      lua_call(L, 1, q.results);
      Attempt(L, [&] {
        for (int i = 2; i < 2 + q.results; ++i) {
          lua_pushvalue(L, i);
          q.answer.push_back(lua_isnil(L, -1) ? TomlNode{} : LuaNode(L, first, kAnswerEntriesMax));
          lua_pop(L, 1);
        }
      });
      return 0;
    });
    lua_pushlightuserdata(state, &question);
    Call(1, line);
    return state == nullptr ? std::vector<TomlNode>{} : std::move(question.answer);
  }

  struct Callback {
    const char* name;
    const char* text[3];
    int flag;  // -1: none
    const double* number;
    const LcmMessage* message = nullptr;
  };

  void Run(const Callback& callback) {
    if (state == nullptr || guard.spent) return;
    lua_settop(state, 0);
    lua_pushcfunction(state, NoteLine);
    lua_pushcfunction(state, [](lua_State* L) {
      const auto& c = *static_cast<const Callback*>(lua_touserdata(L, 1));
      lua_settop(L, 0);
      lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
      lua_pushstring(L, c.name);
      if (lua_rawget(L, 1) != LUA_TFUNCTION) return 0;
      GuardOf(L).line = BeginOf(L);  // for out-of-memory errors, which have no line
      for (const char* text : c.text) {
        if (text != nullptr) lua_pushstring(L, text);
      }
      if (c.number != nullptr) lua_pushnumber(L, *c.number);
      if (c.flag >= 0) lua_pushboolean(L, c.flag);
      if (c.message != nullptr) PushLuaMessage(L, *c.message);
      lua_call(L, lua_gettop(L) - 2, 0);
      return 0;
    });
    lua_pushlightuserdata(state, const_cast<Callback*>(&callback));
    Call(1, source.line);
  }

  void Fail(int status, int line) {
    if (guard.line > 0) line = guard.line;
    if (guard.spent) return Stop(line, guard.why);
    if (status == LUA_ERRMEM) {
      LuaDescribeLimit(&guard);
      return Stop(line, guard.why);
    }
    // Nothing here may run the script's code or raise: only an error that is a string is read.
    if (lua_type(state, -1) != LUA_TSTRING) {
      return Stop(line, std::string("an error that is no text but a ") + luaL_typename(state, -1));
    }
    std::size_t bytes = 0;
    const char* text = lua_tolstring(state, -1, &bytes);
    // The message may have its line already, from Lua or the scene's reader.
    const bool placed = std::string(text).rfind(scene_file + ":", 0) == 0;
    error = (placed ? "" : scene_file + ":" + std::to_string(line) + ": ") + Plain(text, bytes);
    error += LuaHint(source, error);
    Close();
  }

  void Stop(int line, const std::string& what) {
    error = scene_file + ":" + std::to_string(line) + ": " + what;
    Close();
  }

  const ScriptSource source;
  const std::string scene_file;
  LuaGuard guard;
  lua_State* state = nullptr;  // null once stopped
  bool compiled = false;
  std::string error;
};

Script::Script(const ScriptSource& source, const std::string& scene_file, std::uint64_t seed,
               ScriptHost& host, const SavedScript* saved)
    : impl_(std::make_unique<Impl>(source, scene_file, host)) {
  if (saved != nullptr) {
    impl_->Resume(seed, *saved);
    return;
  }
  impl_->Open(seed);
  if (impl_->state != nullptr) impl_->Load();
}

SavedScript Script::Save() { return impl_->Save(); }

Script::~Script() = default;

void Script::BeginTick() {
  impl_->guard.work = impl_->guard.limits.instructions;
  impl_->guard.says = impl_->guard.commands = 0;
}

void Script::OnTick(double t) { impl_->Run({"on_tick", {nullptr, nullptr, nullptr}, -1, &t}); }

void Script::OnTouch(const std::string& a, const std::string& b) {
  impl_->Run({"on_touch", {a.c_str(), b.c_str(), nullptr}, -1, nullptr});
}

void Script::OnTrigger(const std::string& trigger, const std::string& part, bool entered) {
  impl_->Run({"on_trigger", {trigger.c_str(), part.c_str(), nullptr}, entered ? 1 : 0, nullptr});
}

void Script::OnJoin(const std::string& player) {
  impl_->Run({"on_join", {player.c_str(), nullptr, nullptr}, -1, nullptr});
}

void Script::OnLeave(const std::string& player) {
  impl_->Run({"on_leave", {player.c_str(), nullptr, nullptr}, -1, nullptr});
}

void Script::OnMessage(const LcmHeard& m) {
  impl_->Run({"on_message", {m.channel.c_str(), nullptr, nullptr}, -1, nullptr, &m.message});
}

void Script::OnSeat(const std::string& player, const std::string& seat, const char* news) {
  impl_->Run({"on_seat", {player.c_str(), seat.c_str(), news}, -1, nullptr});
}

bool Script::Defines(const char* callback) const { return impl_->LineOf(callback) > 0; }
int Script::LineOf(const char* function) const { return impl_->LineOf(function); }

std::vector<TomlNode> Script::Ask(const char* function, double argument, int results) {
  return impl_->Ask(function, argument, results);
}

bool Script::compiled() const { return impl_->compiled; }
bool Script::stopped() const { return impl_->state == nullptr; }
const std::string& Script::error() const { return impl_->error; }
const std::string& Script::name() const { return impl_->source.name; }
std::int64_t Script::work() const { return impl_->guard.limits.instructions - impl_->guard.work; }
std::int64_t Script::memory_bytes() const { return impl_->guard.memory; }

}  // namespace seam
