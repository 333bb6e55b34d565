#pragma once
/// The members of a swarm that one thread runs. The thread sleeps until a datagram arrives or a
/// tick is due.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/scene_cache.h"
#include "client/swarm/held.h"
#include "client/swarm/member.h"

namespace seam {

class Group {
 public:
  Group();
  ~Group();
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  /// Adds a member; if `first_of_room`, Moving counts the server's bodies by its copy. Throws
  /// OperatorError if there are no more sockets.
  void Add(ClientConfig config, bool first_of_room);
  const std::vector<std::unique_ptr<Member>>& members() const { return members_; }

  /// Runs until `until_us` (SteadyClockUs), but at most 100 ms, so that the caller can check for
  /// results.
  void Run(std::int64_t until_us);
  /// Says goodbye for all members.
  void Leave(std::int64_t now_us);

  /// Returns the number of members that simulate.
  int running() const;
  /// Returns name and reason of the first member with a fatal error; "": none.
  std::string Fatal() const;
  /// True if the server has closed the room of a member.
  bool Closed() const;
  /// Counts the moving bodies, only for the members with number `part` modulo `parts`: each
  /// member's bodies by its own copy, the server's by the first member of each room.
  MovingBodies Moving(std::size_t part, std::size_t parts) const;
  MemberFigures Figures() const;
  void Forget();

 private:
  void Sleep(std::int64_t us) const;
  void TickOne(std::size_t member, std::int64_t now_us, std::int64_t* cpu_us);
  /// Steps the members that are due; returns the next due time.
  std::int64_t TickDue(std::int64_t* cpu_us);

  SceneCache scenes_;  // outlives the members
  std::vector<std::unique_ptr<Member>> members_;
  std::vector<bool> first_of_room_;   // by member
  std::vector<std::int64_t> due_us_;  // by member
  int epoll_ = -1;
};

}  // namespace seam
