#pragma once
/// A scene as edits have changed it: its parts, its joints and its composition. The same scene and
/// edits give the same topology, bit for bit, on every peer and in every program.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

class FeatherStore;
class Foundations;
struct Brick;

/// Parts and joints are never renumbered: a removed one keeps its index with `gone` set, a new one
/// is appended; but a bond reuses the lowest index of a former bond. The position and angle of a
/// part in the scene are its place within its assembly: a bond moves the places of all parts of one
/// side, so that the assembly fits together.
class Topology {
 public:
  /// Requires a scene that ParseScene accepted, or an equally valid one.
  explicit Topology(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const Composition& composition() const { return composition_; }
  /// Number of edits applied, including edits without effect.
  int revision() const { return revision_; }

  /// Returns the bricks that no blast has freed. The first call builds the store (0.1 s for a
  /// million bricks); later calls only remove the bricks freed since. Not thread-safe.
  const FeatherStore& BricksLeft() const;

  /// Position of bricks that nothing supports, m: remains of the last blast, since one edit frees
  /// only a limited number, or bricks above a part that has left or was freed. A blast there, of
  /// any speed, lets them fall.
  const std::optional<Vec2>& hanging() const { return hanging_; }

  /// Applies edits in order. An impossible edit (its part has left, its text is wrong) counts but
  /// has no effect: the same on every peer. Returns the result of each.
  std::vector<Status> Apply(const std::vector<Edit>& edits);

  /// Sets a seat's player without counting an edit. Has no effect if impossible.
  void Sit(const SeatEdit& seat);

  /// Returns whether the edit could be applied now. Does not check distances.
  Status Validate(const Edit& edit) const;

  /// Returns the existing parts that an edit refers to; for an insert, none of its own.
  std::vector<PartId> PartsOf(const Edit& edit) const;

  /// Returns true if a joint of this number exists or has existed.
  bool HasJoint(std::int32_t joint) const;
  /// True if the joint's index is one that bonds reuse. Requires HasJoint.
  bool IsBond(std::int32_t joint) const { return slots_[static_cast<std::size_t>(joint)].bond; }
  /// Revision at which the joint of this number was made; 0: it is the scene's. A message about
  /// this joint from an earlier revision means another joint. Requires HasJoint.
  int JointMadeAt(std::int32_t joint) const {
    return slots_[static_cast<std::size_t>(joint)].made_at;
  }

 private:
  friend class TopologyBuilder;

  /// Data about a joint's index besides the joint.
  struct Slot {
    int made_at = 0;    // revision
    bool bond = false;  // made by a bond: once the joint is gone, the next bond takes its index
  };

  Status ValidateBond(const BondEdit& bond) const;
  Status ValidateInsert(const InsertEdit& insert) const;
  Status ApplyOne(const Edit& edit);
  void Bond(const BondEdit& edit);
  /// Puts glue or a grip at an index for bonds.
  void PutBond(std::int32_t slot, const BondEdit& edit);
  /// Moves the places of one side as the bond requires.
  void MoveSide(const BondEdit& edit);
  Status Insert(const InsertEdit& edit);
  void Break(std::int32_t joint);
  void Free(PartId part);
  void Remove(PartId part);
  void FreeBricks(const BlastEdit& blast);
  /// Stores the parts that bricks may lie on at the start of the scene.
  void KeepGround();
  /// Records the bricks that lay on a part and now hang, after it has left or is no longer
  /// anchored.
  void RecordHanging(PartId part);
  void SetHanging(std::vector<Brick> hanging);
  bool Has(PartId part) const;
  bool RoomFor(std::size_t more) const;
  void UpdateComposition();

  Scene scene_;
  Composition composition_;
  std::vector<Slot> slots_;            // by joint
  std::set<std::int32_t> free_bonds_;  // indices of bonds that are gone
  bool stale_ = false;                 // composition_ is older than scene_
  int revision_ = 0;
  mutable std::shared_ptr<FeatherStore> left_;  // shared by copies until one of them changes it
  mutable std::size_t left_parts_ = 0;          // number of parts already applied to it
  std::shared_ptr<const std::vector<Part>> ground_;  // parts that bricks may lie on, at the start
  mutable std::shared_ptr<const Foundations> foundations_;  // made with left_
  std::optional<Vec2> hanging_;
};

/// Most parts during the life of a room, removed ones included.
constexpr std::size_t kPartsEver = 250000;
/// Most joints likewise; bonds make fewer than there are parts.
constexpr std::size_t kJointsEver = 250000;

/// Largest distance of welded parts from their root, m, reached by bonds and inserts in turn.
constexpr float kReachEver = 4000;
/// Bound on part positions and joint anchors, m and rad, however often bonds move them.
constexpr float kPlaceMax = 1e5f, kTurnMax = 1e6f;

/// Adds the [[part]]s and [[joint]]s of `text` to a scene. Throws OperatorError "insert:LINE: what"
/// and leaves the scene unchanged. Joints may name parts of the scene. The added parts are subject
/// to crowding.h's limits, among themselves and with parts that never move. With `whole` false,
/// skips that check and those of the composition.
void AddToScene(const std::string& text, Scene* scene, bool whole = true);

}  // namespace seam
