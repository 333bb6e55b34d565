/// The table `room` of a script: what is kept, and what is refused by name.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "server/script/script.h"
#include "tests/support/fake_script_host.h"

namespace seam {
namespace script_room_table_test {

Script Make(const std::string& code, FakeHost* host, const SavedScript* saved = nullptr) {
  ScriptSource source;
  source.name = "keeper";
  source.code = code;
  source.line = 1;
  return Script(source, "test.toml", 1, *host, saved);
}

TEST(ScriptRoomTable, KeepsPlainValuesAndForgetsTheRest) {
  const std::string code = R"(
room.count = (room.count or 0) + 1
if room.count == 1 then
  room.list = {1, 2.5, "three", true, false}
  room.deep = {a = {b = {c = "d"}}}
  room.big, room.none, room.inf = math.maxinteger, nil, math.huge
  room[-7] = "minus"
  room["with\0zero"] = "x\0y"
  other = 5
end
local l, d = room.list, room.deep
print(room.count, #l, l[1], l[2], l[3], l[4], l[5], d.a.b.c)
print(room.big == math.maxinteger, math.type(room.big), room.none, room.inf, room[-7])
print(#room["with\0zero"], math.type(l[1]), math.type(l[2]), other)
)";
  FakeHost host;
  Script first = Make(code, &host);
  ASSERT_EQ(first.error(), "");
  const SavedScript saved = first.Save();
  ASSERT_FALSE(saved.stopped) << saved.error;
  // What the code says while it runs again is not said a second time: look at the next tick.
  const std::string again = code.substr(0, code.find("local l")) + "function on_tick()\n" +
                            code.substr(code.find("local l")) + "end\n";
  Script second = Make(again, &host, &saved);
  ASSERT_EQ(second.error(), "");
  host.said.clear();
  second.BeginTick();
  second.OnTick(0);
  EXPECT_EQ(second.error(), "");
  ASSERT_EQ(host.said.size(), 3u);
  EXPECT_EQ(host.said[0], "2 5 1 2.5 three true false d");
  EXPECT_EQ(host.said[1], "true integer nil inf minus");
  EXPECT_EQ(host.said[2], "3 integer float nil");
}

TEST(ScriptRoomTable, RandomNumbersGoOn) {
  const std::string code = "function on_tick() print(math.random(1000000)) end";
  FakeHost host;
  Script first = Make(code, &host);
  for (int i = 0; i < 10; ++i) first.BeginTick(), first.OnTick(0);
  const SavedScript saved = first.Save();
  Script second = Make(code, &host, &saved);
  host.said.clear();
  for (Script* script : {&first, &second}) script->BeginTick(), script->OnTick(0);
  ASSERT_EQ(host.said.size(), 2u);
  EXPECT_EQ(host.said[0], host.said[1]);
}

TEST(ScriptRoomTable, RequestsOfTheCodeThatRunsAgainHaveNoEffect) {
  const std::string code = "world.remove_part('ball') world.set('ann', 'score', 3)";
  FakeHost host;
  Script first = Make(code, &host);
  ASSERT_EQ(first.error(), "");
  const SavedScript saved = first.Save();
  host.asked.clear();
  host.values.clear();
  Script second = Make(code, &host, &saved);
  EXPECT_EQ(second.error(), "");
  EXPECT_TRUE(host.asked.empty());
  EXPECT_TRUE(host.values.empty());
}

TEST(ScriptRoomTable, AValueThatCannotBeKeptStopsTheScriptAndIsNamed) {
  const std::pair<std::string, std::string> cases[] = {
      {"room.call = print",
       "room.call is a function; room keeps booleans, numbers, strings and "
       "tables of these"},
      {"room.a = {b = {coroutine.create(print)}}",
       "room.a.b[1] is a thread; room keeps booleans, numbers, strings and tables of these"},
      {"room.me = room", "room.me leads back to a table that it is in"},
      {"room.a = {} room.a.b = {up = room.a}", "room.a.b.up leads back to a table that it is in"},
      {"room.t = setmetatable({}, {})", "room.t has a metatable; room keeps plain tables"},
      {"room[{}] = 1",
       "room has a key that is a table; room keeps strings and whole numbers as "
       "keys"},
      {"room[1.5] = 1",
       "room has a key that is a number; room keeps strings and whole numbers as "
       "keys"},
      {"room['a\\1\\255b'] = print", "room.a??b is a function"},
      {"room = 5", "room is no table any more"},
      {"for i = 1, 8 do room[i] = ('x'):rep(10000) end",
       "room is too large at room[7]: more than 64 kB"},
      {"local t = room for i = 1, 40 do t.t = {} t = t.t end", "room keeps 16 tables"}};
  for (const auto& [code, says] : cases) {
    FakeHost host;
    Script script = Make(code, &host);
    ASSERT_EQ(script.error(), "") << code;
    const SavedScript saved = script.Save();
    EXPECT_TRUE(saved.stopped) << code;
    EXPECT_TRUE(script.stopped()) << code;
    EXPECT_NE(saved.error.find(says), std::string::npos) << code << ": " << saved.error;
    EXPECT_EQ(saved.error.find("test.toml:1: "), 0u) << saved.error;
    Script again = Make(code, &host, &saved);
    EXPECT_EQ(again.error(), saved.error) << "stopped is stopped";
  }
}

TEST(ScriptRoomTable, ASharedTableIsNoCycle) {
  FakeHost host;
  Script script = Make("local t = {1} room.a, room.b = t, t", &host);
  EXPECT_FALSE(script.Save().stopped);
  Script none = Make("room = nil", &host);
  EXPECT_FALSE(none.Save().stopped);
}

}  // namespace script_room_table_test
}  // namespace seam
