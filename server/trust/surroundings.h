#pragma once
/// Remembers for two seconds where mechanisms were, for an audit of that time, and tells what one
/// of them may have touched in the world of its holder. A client hears of others' bodies late and
/// moves them on by itself, so that there one of them may be anywhere on its way since then:
///
///   where the server had it, where it was told to be
///        |------------------ velocity x lag ------------------>|
///   lag: how old the newest states of its holder were, here, and as long again down to the client

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "common/sync/replica.h"

namespace seam {

class Surroundings {
 public:
  /// `replica` must outlive this.
  explicit Surroundings(const Replica& replica);

  /// Takes accepted states of a client, before they move the replica's bodies.
  void NoteTold(const States& states);
  /// Call after each tick. In each kEvery-th, notes where these mechanisms are, and what may meet
  /// them within kLagMostS.
  void AfterTick(const std::vector<int>& mechanisms);
  /// Calls `visit(other)` for each mechanism that may have touched this one between the ticks in
  /// the world of its holder. Returns false if that is not known.
  template <class Visit>
  bool EachNear(int mechanism, std::int64_t from, std::int64_t to, const Visit& visit) const {
    const Box own = PlacesOf(mechanism, from, to);
    if (own.isEmpty() || newest_ < to || first_ > from) return false;
    for (const int other : seen_) {
      if (other != mechanism && MayTouch(own, mechanism, other, from, to)) visit(other);
    }
    return true;
  }

  /// Ticks between two looks.
  static constexpr std::int64_t kEvery = 6;

 private:
  using Box = Eigen::AlignedBox2f;
  /// Places and velocities of a mechanism's bodies in kEvery ticks.
  struct Look {
    std::int64_t number = -1;  // tick / kEvery
    Box place, velocity;
  };
  static constexpr std::size_t kLooks = 20;
  struct Trail {
    std::array<Look, kLooks> told, had;  // by number modulo kLooks
    std::int64_t newest = -1;            // number of the newest look
  };

  void Forget();
  void Widen(std::size_t mechanism, const Box& places);
  void DropOldLooks();
  void Note(std::array<Look, kLooks> Trail::*looks, std::int64_t tick, int body,
            const BodyState& state);
  Box PlacesOf(int mechanism, std::int64_t from, std::int64_t to) const;
  bool MayTouch(const Box& own, int mechanism, int other, std::int64_t from, std::int64_t to) const;
  std::int64_t LagOf(int mechanism) const;
  std::int64_t LagMost() const;

  const Replica& replica_;
  std::vector<Trail> trails_;              // rebuilt at edits, by mechanism
  std::vector<Box> reach_;  // rebuilt at edits, by mechanism: everything that it may have been in
  std::vector<int> seen_;   // mechanisms with looks: those with a reach
  std::vector<char> large_;                // rebuilt at edits, by body: looked at wherever it is
  std::vector<std::int64_t> heard_, lag_;  // by peer: newest tick told of; greatest lag of late
  std::int64_t first_ = -1, newest_ = -1;  // ticks of the looks
  EditHook forget_;
};

}  // namespace seam
