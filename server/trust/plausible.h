#pragma once
/// Judges told states of bodies: by the server's own copy of the same tick where there is one, else
/// by the way from the last accepted state.
///
/// A server that simulates a body knows the inputs that move it, so that an honest holder tells the
/// state of the copy, up to the rounding of the wire. Where honest copies part, after late inputs
/// in chaos, the told state is believed against the copy, but only for a bounded sum of distances
/// and velocities. Differences that are too small for that are summed with their directions
/// (Drift).

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/replica.h"
#include "common/sync/table/body_column.h"
#include "server/trust/doubt.h"
#include "server/trust/drift.h"
#include "server/trust/strikers.h"

namespace seam {

class Plausible {
 public:
  /// Both must outlive this object.
  Plausible(const Scene& scene, const Replica& replica);

  /// The newest accepted state of a body.
  struct Accepted {
    std::int64_t tick = -1;  ///< -1: none
    std::int32_t epoch = 0;
    BodyState state;
  };
  const Accepted& accepted(int body) const { return accepted_[body]; }
  void Accept(int body, const Accepted& state) { accepted_[body] = state; }

  /// True if states of this message cannot be compared yet with copies that the server simulates,
  /// as inputs of their tick are missing or not acted on.
  bool Waits(const States& states) const;
  /// True if the state of a body is believed. Notes a doubt if it differs. `whole`: velocity and
  /// spin were told too.
  bool Judge(int body, std::int64_t tick, int revision, const BodyState& state, bool whole = true);
  /// Call before each edit is applied. For kSettlesS, differences of the bodies that it may have
  /// reached say nothing unless they are gross.
  void NoteEdit(const Edit& edit);
  /// True if the place is within reach of the last accepted one at `times` the speed limit.
  bool Reachable(int body, std::int64_t tick, const Vec2& position, float times) const;
  /// True if the told speeds of the bodies about a glued joint explain that it broke: for joints
  /// of which the server's own world feels no load.
  bool MayBreak(const Joint& joint) { return strikers_.LoadOf(joint) >= joint.strength / 2; }
  /// True from a refused state of a body until its next accepted one.
  bool OnProbation(int body) const { return memory_[body].probation != 0; }
  /// Numbers of states since the start.
  struct Counts {
    std::int64_t judged = 0, by_copy = 0, doubted = 0, refused = 0;
  };
  const Counts& counts() const { return counts_; }
  /// See Drift::greatest.
  float greatest_drift() const { return drift_.greatest(); }
  /// Returns the doubts since the last call.
  std::vector<Doubt> TakeDoubts() { return std::exchange(doubts_, {}); }

  /// Differences from the server's copy that are no doubt, m and m/s. Honest ones are at most
  /// .0014 and .003 in 999 of 1000 states; angles count as at .5 m from the centre.
  static constexpr float kAgrees = 0.01f, kAlikeVelocity = 0.1f;
  /// Largest sum of differences that is believed, m and m/s; it falls to 0 in kForgetS. Smaller
  /// refuses honest holders of chaos; larger lets a liar move that far before it is stopped.
  static constexpr float kAllowed = 1, kAllowedVelocity = 5;
  static constexpr float kForgetS = 4;

 private:
  using Box = Eigen::AlignedBox2f;
  /// Of one body.
  struct Memory {
    std::int64_t judged = -1;     // tick of the newest judged state
    float moved = 0, kicked = 0;  // believed against the copy, m and m/s
    std::int64_t forgotten = 0;   // tick up to which they have fallen
    char probation = 0;
    std::int64_t began = 0;  // tick at which the body began: of the edit that made it
    BodyState first;         // its state then
    std::int64_t edited = -1000;  // tick of the last edit that may have reached it
    float pushed = 0;             // m/s that edits after the newest accepted state can have added
    std::int64_t pushed_tick = -1;  // of the last of them
    float fast = 0;          // greatest accepted speed of late, m/s
    std::int64_t fast_tick = 0;
  };

  bool JudgeByCopy(int body, std::int64_t tick, const BodyState& state, BodyState off);
  bool JudgeByWay(int body, std::int64_t tick, int revision, const BodyState& state, bool whole);
  /// Believes a difference of the body, m and m/s, unless the sum of late becomes too large.
  bool Believe(int body, float way, float kick);
  void NoteBlast(const BlastEdit& blast, const Box& hit);
  /// Notes that an edit adds at most so much to the speed of a body of this mechanism, m/s.
  void NotePushed(int body, float speed);
  /// Returns the speed that edits after a tick can have added to the body, m/s.
  float PushedSince(int body, std::int64_t tick) const;
  void NoteDoubt(int body, std::int64_t tick, const BodyState& told, const BodyState& expected,
                 bool refused, bool guessed = false);
  float Seconds(std::int64_t ticks) const;
  bool Settles(int body) const;
  /// Notes that an edit has changed something in the box, which moves at `speed`, m/s, or less.
  void NoteChanged(const Box& box, float speed);
  void AddMechanism(PartId part, Box* box, float* speed) const;
  void NoteBegun(int body);
  void NoteBegun(const BodyRemap& change);
  void NoteSpeed(int body, std::int64_t tick, float speed);
  float SpeedOfLate(int body) const;

  const Scene& scene_;
  const Replica& replica_;
  BodyColumn<Accepted> accepted_;
  BodyColumn<Memory> memory_;
  std::vector<Doubt> doubts_;
  Counts counts_;
  std::size_t parts_ = 0;  // of the scene before the edit
  Strikers strikers_;
  Drift drift_;
  EditHook note_begun_;
};

}  // namespace seam
