#pragma once
/// Closes the joints of poses that the engine did not make: of bodies that are displayed, and of
/// views with offsets. They are moved by as little as is needed, the light more than the heavy.

#include <vector>

#include "common/physics/world.h"
#include "common/sync/show/pinned.h"

namespace seam {

class JointCloser {
 public:
  /// The world must outlive this.
  explicit JointCloser(const World& world) : world_(world) { Rebuild(); }
  /// To be called when World::Apply has returned a change.
  void Rebuild();

  /// The bodies of a mechanism, ascending.
  const std::vector<int>& bodies(int mechanism) const { return At(mechanism).bodies; }
  /// Whether there is anything to close.
  bool jointed(int mechanism) const { return !At(mechanism).pins.empty(); }
  /// Whether one of its joints holds it to something anchored.
  bool anchored(int mechanism) const { return At(mechanism).anchored; }

  /// Takes whole turns off the angles of this mechanism's bodies until each is within the limits
  /// that its hinges allow it, of what has been told without its turns. The first body keeps its.
  void Unwind(int mechanism, std::vector<BodyState>* poses) const;

  /// Moves poses of this mechanism's bodies (`poses` is by body) until its joints and their limits
  /// are within 0.1 mm and 0.1 mrad, or kRoundsMax sweeps are over. Mass times displacement sums up
  /// to 0 where nothing is anchored. Velocities stay. If `simulated`, joints may stay as far open
  /// as they are in the world: a load opens them there and in the truth alike. A mechanism whose
  /// joints are closed is left alone bit for bit.
  void Close(int mechanism, bool simulated, std::vector<BodyState>* poses) const;
  /// The same of poses that were moved on from these states (by body) as if there were no springs:
  /// what a spring holds swings about its rest and travels no further.
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
  std::vector<Jointed> mechanisms_;
};

}  // namespace seam
