#pragma once
/// Whose view glides gently: everybody looks at who is on the way to a seat, or just out of one,
/// and whoever hears of that late has metres to catch up.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"

namespace seam {

class SeatGlide {
 public:
  /// To be called once a tick.
  void Look(const World& world);
  /// Whether a mechanism is one of them.
  bool IsGentle(int mechanism) const;
  /// Those mechanisms.
  const std::vector<int>& gentle() const { return gentle_; }

  /// Poses of a mechanism that are to be shown after those of the last tick, by body: takes all of
  /// them back by one share, until none has moved further than its velocity says and kGentleBeside.
  /// Whether there was anything to take back: then joints are open by a little.
  bool HoldBack(const World& world, const std::vector<int>& bodies,
                std::vector<BodyState>* poses) const;
  /// They are shown.
  void Shown(const World& world, const std::vector<int>& bodies,
             const std::vector<BodyState>& poses);
  /// Bodies have become others.
  void Forget() { shown_.clear(); }

 private:
  struct ShownPose {
    std::int64_t tick = -1;
    BodyState pose;
  };
  std::vector<int> ticks_;        // by player: for how much longer
  std::vector<int> gentle_;       // mechanisms
  std::vector<ShownPose> shown_;  // by body; empty: none
};

}  // namespace seam
