#pragma once
/// A peer that follows an authority's world over a wire with a fixed delay, tick by tick.

#include <deque>
#include <string>
#include <vector>

#include "common/sync/replica.h"
#include "tests/support/replica_test_access.h"

namespace seam {

/// Peer 0 is the authority: a world without a replica. Peer 1 follows all mechanisms except `own`
/// (mechanism indices): over these it has authority itself, and receives no states.
class FollowedCopy {
 public:
  FollowedCopy(const std::string& scene, const std::string& rule, std::int64_t late,
               const std::vector<int>& own = {})
      : truth(ParseScene(scene, "s.toml")),
        copy(truth.scene(), MakeSyncConfig("buffer", rule), 1, -1),
        late_(late) {
    for (int m = 0; m < copy.authority().count(); ++m) {
      AuthorityRecord record;
      record.epoch = 1;
      for (const int mine : own) record.authority = mine == m ? 1 : record.authority;
      record.secondaries.Add(1);
      copy.authority().Set(m, record);
    }
    copy.RolesChanged();
    copy.StartAt(0);
  }

  /// Steps both by one tick; sends a message every other tick.
  void Step() {
    truth.Step();
    copy.Step();
    if (truth.tick() % 2 == 0) wire_.push_back(Message());
    while (talking && !wire_.empty() && wire_.front().tick + late_ <= truth.tick()) {
      copy.Receive(wire_.front());
      wire_.pop_front();
    }
  }
  void Steps(int ticks) {
    for (int i = 0; i < ticks; ++i) Step();
  }
  /// Returns the position error of the copy's body now, with the received states applied.
  Vec2 Apart(int body) const {
    return copy_world().Read(body).position - truth.Read(body).position;
  }
  /// Returns a body's displayed position at the copy.
  Vec2 Shown(int body) const {
    const View view = copy.MakeView();
    return {view.x[static_cast<std::size_t>(body)], view.y[static_cast<std::size_t>(body)]};
  }
  const World& copy_world() const { return copy.world(); }
  /// Overwrites the state of the copy's body without the replica's knowledge.
  void PutCopy(int body, const BodyState& state) {
    ReplicaTestAccess::world(copy).Write(body, state);
  }

  World truth;
  Replica copy;
  bool talking = true;  ///< false: messages are held back

 private:
  States Message() const {
    States header;
    header.tick = truth.tick();
    header.composition = static_cast<std::int64_t>(truth.composition().hash);
    std::vector<PackedBody> bodies;
    for (int body = 0; body < truth.body_count(); ++body) {
      PackedBody packed;
      packed.id = truth.id(body);
      packed.epoch = 1;
      if (!truth.awake(body)) packed.flags = kStateAsleep;
      packed.state = Quantised(truth.Read(body));
      bodies.push_back(packed);
    }
    return Pack(header, bodies).front();
  }

  std::int64_t late_;
  std::deque<States> wire_;
};

}  // namespace seam
