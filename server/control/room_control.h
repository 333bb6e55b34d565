#pragma once
/// The commands of an operator to a room that runs: its network, the settings of its clients,
/// edits, and hands that drag bodies. Each is checked, done at once, and an event of the room.

#include <cstdint>
#include <map>
#include <string>

#include "common/base/status.h"
#include "common/net/impair.h"
#include "common/topology/edit.h"
#include "server/control/drag.h"
#include "server/server.h"

namespace seam {

class RoomControl {
 public:
  /// Both must outlive it. `impair`: the profile by which the network is impaired at first.
  RoomControl(Server& server, ImpairedNet& net, std::string impair);

  /// Returns the forms of a command, for people.
  static std::string Help();
  /// Does a command. Returns one line if it is none, or is not possible.
  Status Do(std::int64_t now_us, const std::string& line);
  /// Call before Server::Tick: lets go of hands that nobody has moved for kHandHeldUs, and orders
  /// the pushes of the others.
  void BeforeTick(std::int64_t now_us);
  /// Returns the present values, and those that are possible, as a JSON object on one line.
  std::string Json() const;

  /// A hand that is held is moved, or told again, each quarter of a second.
  static constexpr std::int64_t kHandHeldUs = 1000000;
  static constexpr std::size_t kHandsMax = 8;

 private:
  struct Hand {
    Grip grip;
    std::string name;  // of the part
    std::int64_t moved_us = 0;
  };
  Status Impair(std::int64_t now_us, const std::string& profile);
  Status Set(std::int64_t now_us, const LiveSetting& setting, int ticks);
  Status Drag(std::int64_t now_us, const std::string& words);
  Status Release(std::int64_t now_us, const std::string& name);
  Status OrderEdit(std::int64_t now_us, const std::string& line);
  void Say(std::int64_t now_us, const std::string& text, PartId part = -1);
  int PushEvery() const;       // ticks
  float PushInterval() const;  // s

  Server& server_;
  ImpairedNet& net_;
  std::string impair_;
  std::map<PartId, Hand> hands_;
  std::int64_t pushed_tick_ = -1;
};

}  // namespace seam
