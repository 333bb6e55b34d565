/// seam-lab check: mistakes in scripts are found at their line, with the name that was meant.

#include <gtest/gtest.h>

#include "tests/lab/check/scene_check.h"

namespace seam {
namespace lab_check_script_test {

/// The code begins on line kBegin.
constexpr int kBegin = 47;

std::string Yard(const std::string& code) {
  return R"([[player]]
name = "ann"
vehicle = "cart"
[[player]]
name = "bob"
region = [[100, 0], [101, 1]]
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
[[part]]
name = "cart"
box = [1, 1]
position = [0, 0.52]
owner = "ann"
[[part]]
name = "gate"
box = [0.3, 3]
position = [12, 1.5]
anchored = true
[[part]]
name = "crate"
box = [1, 1]
position = [4, 0.52]
repeat = {count = 2, step = [3, 0]}
[[trigger]]
name = "plate"
box = [2, 2]
position = [-9, 1]
[[seat]]
name = "cab"
part = "cart"
button = 3
[[thrust]]
name = "engine"
part = "cart"
force = [1, 0]
player = "cab"
[[joint]]
name = "rope"
kind = "rope"
a = "crate.0"
b = "crate.1"
length = 5
[[script]]
name = "s"
code = '''
)" + code +
         "'''\n";
}

std::vector<std::string> Found(const std::string& code) {
  std::vector<std::string> lines;
  for (const Finding& finding : CheckMeaning(ParseScene(Yard(code), "yard.toml"))) {
    lines.push_back(std::to_string(finding.line) + ": " + finding.text);
  }
  return lines;
}

struct Mistake {
  const char* code;
  int line;  // of the code, from 1
  const char* says;
};

/// Most are in callbacks that nothing calls within a second, behind conditions that do not hold.
const Mistake kMistakes[] = {
    {"function on_tick(t)\n  if t > 5 adn true then end\nend\n", 2, "'then' expected near 'adn'"},
    {"function on_tick(t)\n  room.hits += 1\nend\n", 2,
     "(Lua has no +=: write room.hits = room.hits + ...)"},
    {"function on_join(p)\n  if p != 'ann' then world.say(p) end\nend\n", 2,
     "(not equal is ~= in Lua)"},
    {"function on_join(p)\n  if p = 'ann' then world.say(p) end\nend\n", 2,
     "(equal is == in a condition)"},
    {"function on_join(p)\n  if p == 'ann' && p then world.say(p) end\nend\n", 2,
     "(and is a word in Lua)"},
    {"function on_join(p)\n  world.say('a += 1' + p)\nend\n", 2, "(texts are joined by ..)"},
    {"function on_join(p)\n  if p == 'ann' then world.say(p)\n  else if p == 'bob' then "
     "world.say(p)\n  end\nend\n",
     6, "(line 49: \"else if\" begins another if with an end of its own, elseif does not)"},
    {"function on_join(p)\n  prnt(p)\nend\n", 2,
     "'prnt' is defined nowhere (did you mean 'print'?)"},
    {"function on_trigger(t, p, e)\n  if world.tick() > 999 then world.remove_prat('gate') "
     "end\nend\n",
     2, "world has no 'remove_prat' (did you mean 'remove_part'?)"},
    {"function on_tick(t)\n  if t > 30 then world.remove_part('gaet') end\nend\n", 2,
     "there is no part 'gaet' (did you mean 'gate'?)"},
    {"function onTrigger(t, p, e)\n  world.say(p)\nend\n", 1,
     "nothing calls 'onTrigger' (did you mean 'on_trigger'?)"},
    {"function on_tuch(a, b)\n  world.say(a)\nend\n", 1,
     "nothing calls 'on_tuch' (did you mean 'on_touch'?)"},
    {"local function on_tick(t)\n  world.say('x')\nend\n", 1,
     "nothing calls 'on_tick': it is local"},
    {"on_leve = function(p) world.say(p) end\n", 1,
     "nothing calls 'on_leve' (did you mean 'on_leave'?)"},
    {"function on_trigger(t, p, e)\n  if t == 'plte' then world.say(p) end\nend\n", 2,
     "there is no trigger 'plte' (did you mean 'plate'?)"},
    {"function on_touch(a, b)\n  if a == 'cart' and b == 'crate' then world.say(a) end\nend\n", 2,
     "there is no part 'crate'"},
    {"function on_join(p)\n  if p == 'bop' then world.say(p) end\nend\n", 2,
     "there is no player 'bop' (did you mean 'bob'?)"},
    {"function on_leave(p)\n  world.impulse('cart', 'fast', 0)\nend\n", 2,
     "argument 2 of world.impulse is 'fast', not a number"},
    {"function on_tick(t)\n  if t > 9 then world.impulse('cart', 3) end\nend\n", 2,
     "world.impulse takes 3 arguments, not 2"},
    {"function on_tick(t)\n  if t > 9 then world.say(nil) end\nend\n", 2,
     "argument 1 of world.say is nil, not a name or text"},
    {"function on_tick(t)\n  if t > 9 then world.set('ann', 'scor', 1) end\nend\n", 2,
     "there is no value 'scor' (did you mean 'score'?)"},
    {"function on_tick(t)\n  if t > 9 then world.remove_joint('roep') end\nend\n", 2,
     "there is no joint 'roep' (did you mean 'rope'?)"},
    {"function on_tick(t)\n  if t > 9 then world.limp('hero') end\nend\n", 2,
     "there is no active character 'hero'"},
    {"function on_tick(t)\n  if t > 9 then world:say('x') end\nend\n", 2,
     "write world.say, with a point"},
    {"function on_tick(t)\n  if t > 9 then world.say(string.gsub('a', 'b', 'c')) end\nend\n", 2,
     "string has no 'gsub'"},
    {"function on_tick(t)\n  if t > 9 then os.exit() end\nend\n", 2, "'os' is defined nowhere"},
    {"function on_tick(t)\n  if t > 9 then while true do t = t + 1 end end\nend\n", 2,
     "this loop never ends"},
    {"function on_tick(t)\n  if t > 9 then\n    repeat local x = 1 until false\n  end\nend\n", 3,
     "this loop never ends"},
    {"local w = world\nfunction on_tick(t)\n  if t > 9 then w.remove_prat('gate') end\nend\n", 3,
     "world has no 'remove_prat' (did you mean 'remove_part'?)"},
    {"function on_tick(t)\n  if t > 9 then world[\"remove_prat\"]('gate') end\nend\n", 2,
     "world has no 'remove_prat' (did you mean 'remove_part'?)"},
    {"local G <const> = 'gaet'\nfunction on_tick(t)\n  if t > 9 then world.remove_part(G) end\n"
     "end\n",
     3, "there is no part 'gaet' (did you mean 'gate'?)"},
    {"function on_trigger(t, p, e)\n  local i = 0\n  while i < 1 do i = i * 2 end\nend\n", 3,
     "more than 200000 instructions in a tick"},
    {"function on_leave(p)\n  local all = {}\n  for i = 1, 90000 do all[i] = {i} end\nend\n", 1,
     "is stopped: on_leave('ann'): out of memory"},
    {"local t = nil\nfunction on_join(p)\n  world.say(t.x)\nend\n", 3,
     "attempt to index a nil value"},
    {"error('no')\n", 1, "no"},
    {"function on_seat(p, s, n)\n  if n == 'inside' then world.say(p) end\nend\n", 2,
     "there is no news of a seat 'inside'"},
    {"function on_tick(t)\n  if t > 9 then world.part('box.' .. t) end\nend\n", 2,
     "no part begins with 'box.'"},
    {"function on_tick(t)\n  if t > 9 then world.add_part('x') end\nend\n", 2,
     "argument 1 of world.add_part is 'x', not a table"},
    {"function on_message(channel, m)\n  world.say(m.name)\nend\n", 1,
     "nothing calls on_message: the scene has no [[lcm.message]]"},
    {"function on_message(channel, m)\n  world.say('at ' .. m.values[1])\nend\n"
     "'''\n[[lcm.message]]\nchannel = 'M'\n#",
     2, "is stopped: on_message('M', {name = 'test', text = '', values = {}}): attempt to"},
    {"world.add_part{name = 'b', bx = {1, 1}, position = {0, 5}}\n", 1, "bx"},
};

TEST(LabCheckScript, FindsEachMistakeAtItsLineInOneLine) {
  for (const Mistake& mistake : kMistakes) {
    SCOPED_TRACE(mistake.code);
    const std::vector<std::string> found = Found(mistake.code);
    ASSERT_EQ(found.size(), 1u) << ::testing::PrintToString(found);
    EXPECT_EQ(found[0].rfind(std::to_string(kBegin - 1 + mistake.line) + ": script 's'", 0), 0u)
        << found[0];
    EXPECT_NE(found[0].find(mistake.says), std::string::npos) << found[0];
    EXPECT_EQ(found[0].find('\n'), std::string::npos);
  }
}

TEST(LabCheckScript, FindsNothingInGoodScripts) {
  const char* const good[] = {
      "local count, seen = 0, {}\n"
      "function on_trigger(trigger, part, entered)\n"
      "  if not entered or room.open then return end\n"
      "  if trigger == 'plate' then world.remove_part('gate') end\n"
      "  room.open = true\nend\n"
      "function on_touch(a, b)\n  count = count + 1\n  seen[a] = b\n"
      "  if count == 2 and b ~= 'crate.1' then world.say(a .. ' ' .. b) end\nend\n",
      // Parts that scripts make, by their names and by what these begin with.
      "local n = 0\nfunction on_tick(t)\n  n = n + 1\n"
      "  if n == 3 then world.add_part{name = 'new', box = {1, 1}, position = {0, 9}} end\n"
      "  if n == 9 then\n    world.add_part{name = 'shot-' .. n, circle = 0.2, position = {0, 7}}\n"
      "  end\n  if n == 30 and world.part('shot-9') then world.remove_part('shot-9') end\n"
      "  if n > 40 and world.part('new') then world.impulse('new', 0, 1) end\nend\n",
      // Each trigger is tried, while parts come.
      "room.n = 0\nfunction on_trigger(trigger, part, entered)\n  room.n = room.n + 1\n"
      "  for i = 1, 40 do\n    world.add_part{name = 'gift' .. room.n .. '-' .. i, box = {1, 1}, "
      "position = {0, 9}}\n  end\nend\n",
      // Helpers, a coroutine with a loop that yields, a goto, long texts and comments.
      "local Door = {}\nDoor.__index = Door\n"
      "function Door.new(name) return setmetatable({name = name, left = 3}, Door) end\n"
      "function Door:open() self.left = self.left - 1 return self.left == 0 end\n"
      "local door = Door.new('gate') --[[ world.nothing() ]]\n"
      "local co = coroutine.wrap(function() while true do coroutine.yield(door:open()) end end)\n"
      "helper = function(...) local a, b = ... return a, b end\n"
      "function on_tick(t)\n  co()\n  for i, name in ipairs(world.parts('crate.')) do\n"
      "    local p = world.part(name)\n    if p.y < -5 then goto done end\n"
      "    local x, y = helper(p.x, math.max(p.y, 0))\n  end\n  ::done::\n"
      "  if world.seat('ann') == nil then on_idle() end\nend\n"
      "function on_idle() end\n",
      // Locals that are several things, and a loop that something ends.
      "local w, n = world, 'gaet'\nlocal part = 'gaet'\nlocal G = 'gaet'\n"
      "function on_tick(t)\n  part = 'gate'\n  if t > 9 then w.remove_part(part) end\n"
      "  for _, G in ipairs({'gate'}) do if t > 9 then world.remove_part(G) end end\n"
      "  repeat n = n .. 'x' if #n > 9 then break end until false\n"
      "  repeat n = n .. 'x' until false or #n > 9\nend\n"};
  for (const char* code : good) EXPECT_EQ(Found(code), std::vector<std::string>{}) << code;
}

}  // namespace lab_check_script_test
}  // namespace seam
