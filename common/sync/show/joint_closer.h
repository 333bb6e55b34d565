#pragma once
/// Closes the joints of poses that the engine did not compute: displayed bodies, and views with
/// visual offsets. Moves bodies as little as needed, light ones more than heavy ones.

#include <vector>

#include "common/physics/world.h"
#include "common/sync/show/pinned.h"

namespace seam {

class JointCloser {
 public:
  /// The world must outlive this.
  explicit JointCloser(const World& world) : world_(world) { Rebuild(); }
  /// Call when World::Apply has returned a change.
  void Rebuild();

  /// The bodies of a mechanism, ascending.
  const std::vector<int>& bodies(int mechanism) const { return At(mechanism).bodies; }
  /// True if the mechanism has joints.
  bool jointed(int mechanism) const { return !At(mechanism).pins.empty(); }
  /// True if one of its joints holds it to an anchored body.
  bool anchored(int mechanism) const { return At(mechanism).anchored; }

  /// Takes whole turns off the angles of this mechanism's bodies until each is within the limits of
  /// its hinges; the wire carries angles without turns. The first body keeps its angle.
  void Unwind(int mechanism, std::vector<BodyState>* poses) const;

  /// Moves poses of this mechanism's bodies (`poses` is by body) until its joints and their limits
  /// are within 0.1 mm and 0.1 mrad, or kRoundsMax sweeps are done. Mass times displacement sums to
  /// 0 if nothing is anchored. Velocities stay. If `simulated`, joints may stay as far open as in
  /// the world, where a load opens them as it does in the oracle. Closed joints leave the mechanism
  /// bit for bit unchanged.
  void Close(int mechanism, bool simulated, std::vector<BodyState>* poses) const;
  /// Like Close, for poses that were extrapolated from the states `from` (by body) as if there were
  /// no springs: a sprung body swings about its rest and travels no further than that.
  void CloseMovedOn(int mechanism, const std::vector<BodyState>& from,
                    std::vector<BodyState>* poses) const;

 private:
  struct Jointed {
    std::vector<int> bodies;
    std::vector<Pin> pins;
    bool anchored = false;
    bool sprung = false;
  };
  void Close(const std::vector<int>& bodies, const std::vector<Pin>& pins, bool simulated,
             std::vector<BodyState>* poses) const;
  const Jointed& At(int mechanism) const {
    return mechanisms_[static_cast<std::size_t>(mechanism)];
  }

  const World& world_;
  std::vector<Jointed> mechanisms_;  // rebuilt by Rebuild, by mechanism
};

}  // namespace seam
