#pragma once
/// Rooms of any size to put a server under load: players in rows on plains, some distance apart,
/// each with a vehicle and things to run into.

#include <string>

namespace seam {

enum class ReliefThings {
  kCrates,  ///< a car of three bodies, and crates in stacks of three: contacts and joints
  kBalls,   ///< a sled, and balls in a row that bounce: next to no contacts
};

struct ReliefRoom {
  int players = 30;
  int each = 30;       ///< bodies for each player, the vehicle's among them
  float spacing = 30;  ///< m between players at the start
  ReliefThings things = ReliefThings::kCrates;
  bool sleep = false;  ///< what lies still may fall asleep
  int plains = 1;      ///< one above another; players of the second one are pb-0, pb-1, ...
};

/// The scene's text. Players are p-0, p-1, ...; they drive by script, or as bots.
std::string ReliefText(const ReliefRoom& room);

}  // namespace seam
