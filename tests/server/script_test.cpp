/// Scripts: callbacks, functions, and errors that name their line of the scene file.

#include "server/script/script.h"

#include <gtest/gtest.h>

#include "common/topology/edit.h"
#include "tests/support/fake_script_host.h"

namespace seam {
namespace script_test {

using Lines = std::vector<std::string>;

TEST(Script, ReceivesCallbacksForEvents) {
  FakeRoom room(R"(
    function on_tick(t) print("tick", t * 60) end
    function on_touch(a, b) world.say(a .. " touches " .. b) end
    function on_trigger(trigger, part, entered) print(trigger, part, entered) end
    function on_join(player) print(player, "joins") end
    function on_leave(player) print(player, "leaves") end
  )");
  room.Step();
  room.script.OnTouch("ball", "crate.0");
  room.script.OnTrigger("goal", "ball", true);
  room.script.OnTrigger("goal", "ball", false);
  room.script.OnJoin("ann");
  room.script.OnLeave("ann");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.said, (Lines{"tick 1.0", "ball touches crate.0", "goal ball true",
                                   "goal ball false", "ann joins", "ann leaves"}));
  EXPECT_TRUE(room.script.Defines("on_touch"));
  EXPECT_FALSE(room.script.Defines("on_rain"));
}

TEST(Script, ReceivesMessagesOfOtherPrograms) {
  FakeRoom room(R"(
    function on_message(channel, m)
      print(channel, m.name, m.text, m.utime, #m.values, m.values[1], m.values[2])
    end
  )");
  room.Step();
  room.script.OnMessage({"A.B", {7, "gate", {0.5, -2}, "it's open"}});
  room.script.OnMessage({"A.B", {8, "none", {}, ""}});
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.said, (Lines{"A.B gate it's open 7 2 0.5 -2.0", "A.B none  8 0 nil nil"}));
}

TEST(Script, ReadsPartsPlayersAndInputs) {
  FakeRoom room(R"(
    local p = world.part("ball")
    print(p.x, p.y, p.angle, p.vx, p.vy, p.spin, world.part("nothing"))
    print(#world.parts(), table.concat(world.parts("crate."), ","))
    print(table.concat(world.players(), ","), world.input("ann"))
    print(world.tick(), world.time())
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.said,
            (Lines{"1.0 2.0 0.5 3.0 4.0 5.0", "3 crate.0,crate.1", "ann 1.0 -1.0 5", "0 0.0"}));
}

TEST(Script, PushesInNewtonSecondsAndForcesForATick) {
  FakeRoom room(R"(
    world.impulse("ball", 3, 4, "kick")
    world.force("ball", 60, -120)
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.asked, (Lines{"push ball 3 4 kick", "push ball 1 -2 force"}));
}

TEST(Script, MakesACharacterLimpForSecondsOrUntilItEndsIt) {
  FakeRoom room(R"(
    world.limp("hero", 2.5)
    world.limp("hero")
    world.limp("hero", true)
    world.limp("hero", false)
    print(pcall(world.limp, "hero", -1))
    print(pcall(world.limp, "hero", 0 / 0))
  )");
  EXPECT_EQ(room.script.error(), "");
  const std::string good = "limp hero " + std::to_string(kLimpUntilReleased);
  EXPECT_EQ(room.host.asked, (Lines{"limp hero 2.500000", good, good, "limp hero -1.000000"}));
  ASSERT_EQ(room.host.said.size(), 2u);
  for (const std::string& said : room.host.said) EXPECT_EQ(said.rfind("false ", 0), 0u) << said;
}

TEST(Script, ABlastPushesOnlyWithAFiniteImpulse) {
  FakeRoom room(R"(
    world.blast(1, 2, 3, 4)
    world.blast(1, 2, 3, 4, 50)
    print(pcall(world.blast, 1, 2, 3, 4, 0 / 0))
    print(pcall(world.blast, 1, 2, 3, 4, math.huge))
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.asked, (Lines{"blast 1 2 3 4 0", "blast 1 2 3 4 50"}));
  ASSERT_EQ(room.host.said.size(), 2u);
  for (const std::string& said : room.host.said) EXPECT_EQ(said.rfind("false ", 0), 0u) << said;
}

TEST(Script, MakesPartsAndJointsAsASceneDoes) {
  FakeRoom room(R"(
    world.add_part{name = "b2", box = {1, 0.5}, position = {2, 3}, bullet = true}
    world.add_joint{name = "j", kind = "wheel", a = "ball", b = "b2", motor = {speed = 3}}
    world.weld("ball", "b2")
    world.unweld("ball", "b2")
    world.hinge("h", "ball", "crate.0", 1, 2)
    world.distance("d", "ball", "crate.0", 2.5)
    world.distance("e", "ball", "crate.1")
    world.remove_joint("d")
    world.remove_part("b2")
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(
      room.host.asked,
      (Lines{"add part {box=[1 0.5 ] bullet=true name=b2 position=[2 3 ] }",
             "add joint {a=ball b=b2 kind=wheel motor={speed=3 } name=j }", "weld ball b2 0",
             "unweld ball b2", "add joint {kind=revolute name=h a=ball b=crate.0 anchor=[1 2 ] }",
             "add joint {kind=distance name=d a=ball b=crate.0 length=2.5 }",
             "add joint {kind=distance name=e a=ball b=crate.1 length=2.23607 }", "remove joint d",
             "remove part b2"}));
}

TEST(Script, KeepsScoresAndHealth) {
  FakeRoom room(R"(
    world.score("ann", 10)
    print(world.score("ann", -3), world.score("bob"))
    print(world.health("ball", 50))
    world.set("ball", "laps", 2)
    print(world.get("ball", "laps"))
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.said, (Lines{"7.0 0.0", "50.0", "2.0"}));
}

/// Returns a script's error; `code` begins on line 10.
std::string ErrorOf(const std::string& code) {
  FakeRoom room(code);
  room.Step();
  EXPECT_TRUE(room.script.stopped()) << code;
  return room.script.error();
}

TEST(Script, AnErrorNamesItsLineOfTheSceneFile) {
  EXPECT_EQ(ErrorOf("\nlocal x = \n"), "s.toml:12: unexpected symbol near <eof>");
  EXPECT_EQ(ErrorOf("\n\nnope()"), "s.toml:12: attempt to call a nil value (global 'nope')");
  EXPECT_EQ(ErrorOf("function on_tick()\n error('so there') end"), "s.toml:11: so there");
  EXPECT_EQ(ErrorOf("function on_tick()\n error('no place', 0) end"), "s.toml:11: no place");
  EXPECT_EQ(ErrorOf("\nerror({})"), "s.toml:11: an error that is no text but a table");
  EXPECT_EQ(ErrorOf("\nworld.impulse('ghost', 1, 1)"), "s.toml:11: there is no part 'ghost'");
  EXPECT_EQ(ErrorOf("world.impulse('ball', 1/0, 1)"),
            "s.toml:10: bad argument #2 to 'impulse' (a finite number expected)");
  EXPECT_EQ(ErrorOf("for i = 1, 65 do world.impulse('ball', 1, 1) end"),
            "s.toml:10: more than 64 changes of the world in a tick");
  EXPECT_EQ(ErrorOf("for i = 1, 9 do print(i) end"), "s.toml:10: says more than 8 lines in a tick");
  EXPECT_EQ(ErrorOf("error('two\\nlines\\27[31m')"), "s.toml:10: two?lines?[31m");
}

TEST(Script, StopsForGoodAtAnError) {
  FakeRoom room("function on_tick() print('again') error('x') end");
  room.Step();
  room.Step();
  room.script.OnJoin("ann");
  EXPECT_TRUE(room.script.stopped());
  EXPECT_EQ(room.host.said, (Lines{"again"}));
  EXPECT_EQ(room.script.memory_bytes(), 0);
}

TEST(Script, CatchesItsOwnErrors) {
  FakeRoom room(R"(
    print(select("#", pcall(function() return 1, 2 end)), pcall(error, "x"))
    print(pcall(world.impulse, "ghost", 1, 1))
    local co = coroutine.create(function(a) local b = coroutine.yield(a + 1) error(b) end)
    print(coroutine.resume(co, 1))
    print(coroutine.resume(co, "late"))
    print(coroutine.resume(co))
    local w = coroutine.wrap(function() pcall(coroutine.yield, 7) coroutine.yield(8) end)
    print(w(), w())
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.said,
            (Lines{"3 false x", "false there is no part 'ghost'", "true 2", "false s.toml:13: late",
                   "false cannot resume dead coroutine", "7 8"}));
}

TEST(Script, AnswersWithTheValuesThatAFunctionReturns) {
  FakeRoom room(R"(
    function twice(t)
      return {ball = {x = 2 * t}}, "m"
    end
    function loop() while true do end end
  )");
  const std::vector<TomlNode> answer = room.script.Ask("twice", 1.5, 3);
  ASSERT_EQ(answer.size(), 3u);
  EXPECT_EQ(FakeHost::Text(answer[0]), "{ball={x=3 } }");
  EXPECT_EQ(answer[1].text, "m");
  EXPECT_EQ(answer[2].kind, TomlNode::Kind::kOther);
  EXPECT_EQ(room.script.LineOf("twice"), 11);
  EXPECT_EQ(room.script.LineOf("thrice"), 0);
  EXPECT_TRUE(room.script.Ask("thrice", 1, 1).empty());
  EXPECT_FALSE(room.script.stopped());
  // Each answer has a tick's work, and no more.
  for (int i = 0; i < 100000 && !room.script.stopped(); ++i) room.script.Ask("twice", i, 1);
  EXPECT_EQ(room.script.error(), "");
  EXPECT_TRUE(room.script.Ask("loop", 1, 1).empty());
  EXPECT_EQ(room.script.error(), "s.toml:14: more than 200000 instructions in a tick");
}

TEST(Script, AnAnswerThatIsNoValueOrTooLargeIsAnErrorAtItsFunction) {
  for (const char* value : {"print", "coroutine.create(print)", "{{{{{{{}}}}}}}", "{[true] = 1}"}) {
    FakeRoom room(std::string("\nfunction f() return ") + value + " end");
    EXPECT_TRUE(room.script.Ask("f", 0, 1).empty()) << value;
    EXPECT_EQ(room.script.error().rfind("s.toml:11: ", 0), 0u) << room.script.error();
  }
  FakeRoom room(
      "\nfunction f()\n  local t = {}\n  for i = 1, 15000 do t[i] = {i} end\n  return t\nend",
      {2000000, 64 << 20});
  EXPECT_TRUE(room.script.Ask("f", 0, 1).empty());
  EXPECT_EQ(room.script.error(), "s.toml:11: a list is too long");
}

TEST(Script, DoesTheSameInEveryRun) {
  // Lua's own pairs follows a hash that is seeded by addresses and the clock.
  const std::string code = R"(
    local t = {}
    for i = 1, 40 do t["k" .. i % 17 .. i] = i; t[i * 7 % 50] = i; t[i + 0.5] = i end
    t[true] = 1
    local all = ""
    for k, v in pairs(t) do all = all .. tostring(k) .. "=" .. v .. ";" t[k] = nil end
    print(#all, all)
    print(math.random(1000000), math.random(), tostring({}), string.format("%s", print))
  )";
  FakeRoom first(code), second(code);
  EXPECT_EQ(first.script.error(), "");
  EXPECT_EQ(first.host.said, second.host.said);
  ASSERT_EQ(first.host.said.size(), 2u);
  EXPECT_NE(first.host.said[0].find("0=50;0.5"), 0u);
  EXPECT_NE(first.host.said[1].find("table function"), std::string::npos);
  FakeHost host;
  Script other({"test", code, 10, {}}, "s.toml", 2, host);
  EXPECT_NE(host.said[1], first.host.said[1]) << "another seed gives other numbers";
}

TEST(Script, HasObjectsWithMetatables) {
  FakeRoom room(R"(
    local C = {}
    C.__index = C
    C.__tostring = function(o) return "C" .. o.x end
    C.__add = function(a, b) return C.new(a.x + b.x) end
    function C.new(x) return setmetatable({x = x}, C) end
    function C:twice() return self.x * 2 end
    local c = C.new(3)
    print(c:twice(), c + c, getmetatable(c) == C)
    local locked = setmetatable({}, {__metatable = "mine"})
    print(getmetatable(locked), pcall(setmetatable, locked, {}))
    print(("ab"):upper(), ("x"):rep(3), #"abc", ("a%d"):format(7), ("abcabc"):find("ca"))
    print(string.char(72, 105), ("hello"):sub(-3), ("abc"):byte(1, -1))
    local list = {3, 1, 2}
    table.insert(list, 5) table.insert(list, 1, 9) table.remove(list) table.sort(list)
    print(table.concat(list, ","), table.unpack(list, 2, 3))
  )");
  EXPECT_EQ(room.script.error(), "");
  EXPECT_EQ(room.host.said, (Lines{"6 C6 true", "mine false cannot change this metatable",
                                   "AB xxx 3 a7 3 4", "Hi llo 97 98 99", "1,2,3,9 2 3"}));
}

}  // namespace script_test
}  // namespace seam
