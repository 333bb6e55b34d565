#pragma once
/// A small room with some of everything that a room's state has.

#include "common/scene/scene.h"

namespace seam {

/// A puck that lies in acid, another that runs into a gate and a wall, a charge, and a script that
/// counts in `room`, draws random numbers and makes parts.
inline constexpr const char* kArena = R"(
title = "Arena"
gravity = [0, -10]
[[player]]
name = "ann"
vehicle = "runner"
[[player]]
name = "bob"
[[part]]
name = "ground"
box = [80, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "runner"
circle = 0.4
position = [-9, 0.4]
velocity = [4, 0]
owner = "ann"
health = 100
[[part]]
name = "lying"
circle = 0.3
position = [3, 0.3]
density = 2
health = 500
[[part]]
name = "crate"
box = [0.6, 0.6]
position = [6, 0.3]
repeat = {count = [1, 4], step = [0, 0.6]}
[[trigger]]
name = "acid"
kind = "hazard"
position = [3, 0.5]
box = [2, 2]
health = 10
[[trigger]]
name = "gate"
kind = "area"
position = [-6, 0.5]
box = [1, 3]
score = 3
once = true
[[script]]
name = "keeper"
code = '''
room.count = room.count or 0
room.made = room.made or {}
if not room.begun then
  room.begun = true
  world.add_part{name = "first", circle = 0.2, position = {-12, 0.2}}
end
local forgotten = 0

function on_tick()
  forgotten = forgotten + 1
  room.count = room.count + 1
  room.half = room.count / 2
  if room.count % 25 == 0 then
    local name = "made" .. room.count
    room.made[#room.made + 1] = {name = name, by = {"keeper", room.count}, good = true}
    world.add_part{name = name, box = {0.3, 0.3}, position = {-3 + 6 * math.random(), 4}}
  end
  if room.count % 10 == 0 then world.impulse("lying", (math.random() - 0.5) / 20, 0.2) end
  if room.count == 40 then world.weld("crate.0.0", "crate.0.1") end
end

function on_trigger(trigger, part, entered)
  room[trigger .. (entered and " in" or " out")] = (room[trigger] or 0) + 1
end
'''
)";

inline Scene Arena() { return ParseScene(kArena, "arena.toml"); }

}  // namespace seam
