#pragma once
/// The members of a swarm that one thread runs: it sleeps until a datagram comes or a tick is due.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/scene_shelf.h"
#include "client/swarm/held.h"
#include "client/swarm/member.h"

namespace seam {

class Group {
 public:
  Group();
  ~Group();
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  /// One more member; of `first_of_room` Moving asks what the server has. Throws OperatorError when
  /// there are no more sockets to be had.
  void Add(ClientConfig config, bool first_of_room);
  const std::vector<std::unique_ptr<Member>>& members() const { return members_; }

  /// Runs until `until_us` (SteadyClockUs), or for at most 100 ms: the caller looks in between.
  void Run(std::int64_t until_us);
  /// All say goodbye.
  void Leave(std::int64_t now_us);

  /// Members that simulate.
  int running() const;
  /// Name and reason of the first that was refused or was sent something it cannot use; "": none.
  std::string Fatal() const;
  /// Whether the server has closed the room of one of them.
  bool Closed() const;
  /// What moves now: of each member's bodies by its own copy, of the server's by the copy of the
  /// first of each room. Of the members whose number is `part` of `parts` only.
  MovingBodies Moving(std::size_t part, std::size_t parts) const;
  MemberFigures Figures() const;
  void Forget();

 private:
  void Sleep(std::int64_t us) const;
  void TickOne(std::size_t member, std::int64_t now_us, std::int64_t* cpu_us);
  /// Steps whoever is due; says when the next one will be.
  std::int64_t TickDue(std::int64_t* cpu_us);

  SceneShelf scenes_;  // outlives the members
  std::vector<std::unique_ptr<Member>> members_;
  std::vector<bool> first_of_room_;   // by member
  std::vector<std::int64_t> due_us_;  // the same: when it is due
  int epoll_ = -1;
};

}  // namespace seam
