#pragma once
/// Replicas of one scene, connected with a fixed delay, tick by tick: authority is set once, and
/// the test gives the players' inputs.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/physics/part_places.h"
#include "common/sync/replica.h"

namespace seam {

/// Peer 0 has no player; peers 1, 2, ... drive the scene's players in their order.
class WiredReplicas {
 public:
  /// Returns the input of the peer's player for the tick.
  using Play = std::function<Input(int peer, std::int64_t tick)>;

  /// Messages arrive `late` ticks after the step in which they were sent; at 0 before the next
  /// step, inputs even before their own. In mode buffer owners have authority over their
  /// mechanisms, peer 0 over the rest, and every peer simulates everything; else peer 0 has all.
  WiredReplicas(const Scene& scene, const SyncConfig& config, std::int64_t late, Play play)
      : late_(late), play_(std::move(play)) {
    const int peers = 1 + static_cast<int>(scene.players.size());
    for (int peer = 0; peer < peers; ++peer) {
      all_.push_back(std::make_unique<Replica>(scene, config, peer, peer - 1));
      const bool buffer = config.policy->PlansFollowers();
      const std::vector<Mechanism>& mechanisms = at(peer).world().composition().mechanisms;
      for (std::size_t m = 0; m < mechanisms.size(); ++m) {
        Give(peer, static_cast<int>(m), buffer ? 1 + mechanisms[m].owner : 0, buffer);
      }
    }
    wires_.resize(all_.size());
  }

  Replica& at(int peer) { return *all_[static_cast<std::size_t>(peer)]; }
  int count() const { return static_cast<int>(all_.size()); }

  /// Steps all replicas by one tick.
  void Step() {
    const std::int64_t next = at(0).tick() + 1;
    for (int peer = 1; peer < count(); ++peer) {
      at(peer).RecordInput(peer - 1, next, play_(peer, next));
      const Inputs told = at(peer).inputs(peer - 1).Export(peer - 1, kTold);
      Send(peer, [told](Replica* to) { to->RecordInputs(told); });
    }
    for (int peer = 0; peer < count(); ++peer) Deliver(peer, next);
    for (int peer = 0; peer < count(); ++peer) {
      at(peer).Step();
      for (const States& states : at(peer).TakeStates()) {
        if (each_states) each_states(peer, states);
        if (states_flow) Send(peer, [states](Replica* to) { to->Receive(states); });
      }
    }
  }
  void StepTo(std::int64_t tick) {
    while (at(0).tick() < tick) Step();
  }

  /// Sets the authority over a mechanism in one peer's table; all other peers follow it, or none.
  void Give(int peer, int mechanism, int authority, bool followed) {
    AuthorityRecord record;
    record.epoch = 1;
    record.authority = authority;
    const auto players = static_cast<int>(at(peer).world().scene().players.size());
    for (int other = 0; followed && other <= players; ++other) {
      if (other != authority) record.secondaries.Add(other);
    }
    at(peer).authority().Set(mechanism, record);
    at(peer).RolesChanged();
  }

  /// Returns the peer's body of a named part; -1: none.
  int Body(int peer, const std::string& part) {
    const World& world = at(peer).world();
    for (const Part& p : world.scene().parts) {
      const int assembly = world.composition().assembly_of_part[static_cast<std::size_t>(p.id)];
      if (p.name != part || assembly < 0) continue;
      return world.BodyOfId(world.composition().assemblies[static_cast<std::size_t>(assembly)].id);
    }
    return -1;
  }
  BodyState Read(int peer, const std::string& part) {
    return at(peer).world().Read(Body(peer, part));
  }

  std::function<void(int peer, const States& told)> each_states;
  /// Messages are held back while this returns true; none is lost.
  std::function<bool(int from, int to)> held_up = [](int, int) { return false; };
  bool states_flow = true;  ///< false: States are lost

 private:
  static constexpr int kTold = 64;
  struct Letter {
    int from = 0;
    std::int64_t due = 0;
    std::function<void(Replica*)> open;
  };

  void Send(int from, const std::function<void(Replica*)>& open) {
    for (int to = 0; to < count(); ++to) {
      if (to == from) continue;
      wires_[static_cast<std::size_t>(to)].push_back({from, at(from).tick() + 1 + late_, open});
    }
  }
  void Deliver(int to, std::int64_t next) {
    std::deque<Letter>& wire = wires_[static_cast<std::size_t>(to)];
    std::deque<Letter> later;
    for (Letter& letter : wire) {
      if (letter.due > next || held_up(letter.from, to)) {
        later.push_back(std::move(letter));
      } else {
        letter.open(&at(to));
      }
    }
    wire = std::move(later);
  }

  std::int64_t late_;
  Play play_;
  std::vector<std::unique_ptr<Replica>> all_;
  std::vector<std::deque<Letter>> wires_;  // by receiver
};

}  // namespace seam
