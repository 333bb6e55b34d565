#pragma once
/// The keys of a scene file that stand above its first table, and its tables.

#include <initializer_list>

namespace seam {

inline constexpr std::initializer_list<const char*> kSceneKeys = {
    "title",       "gravity",  "duration", "buffer",    "speed_limit",   "size_max",  "bounds",
    "solver",      "part",     "bricks",   "character", "joint",         "thrust",    "water",
    "player",      "seat",     "watch",    "camera",    "trigger",       "script",    "grouping",
    "input_delay", "expect",   "follow",   "strand",    "server_follow", "propeller", "charges",
    "planner",     "show_age", "lcm"};

}  // namespace seam
