#pragma once
/// A scene as it has become by edits: its parts and joints, and who is one body with whom. The same
/// scene and edits give the same topology, bit for bit, on every peer and in every program.

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

/// Parts and joints are never renumbered: what leaves stays in its place with `gone` set, what
/// comes is appended; but a bond takes the lowest place that a bond before it has left. Where the
/// scene puts a part (position, angle) is its place within its assembly: a bond moves the places of
/// all parts of one side, so that the assembly fits together.
class Topology {
 public:
  /// Requires a scene that ParseScene accepted, or one as good.
  explicit Topology(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const Composition& composition() const { return composition_; }
  /// Edits applied so far, whether or not they could do anything.
  int revision() const { return revision_; }

  /// The bricks that no blast has freed. The first call makes the store (0.1 s for a million
  /// bricks); later ones follow what was freed since. Not for several threads at once.
  const FeatherStore& BricksLeft() const;

  /// m: where there are bricks that nothing holds up: the last blast has left them, since one edit
  /// frees only so many, or what they lay on has left or was freed. A blast there, of any speed,
  /// lets them fall.
  const std::optional<Vec2>& hanging() const { return hanging_; }

  /// Applies edits in their order. An edit that cannot be (its part has left, its text is wrong)
  /// counts but does nothing: the same on every peer. Returns what became of each.
  std::vector<Status> Apply(const std::vector<Edit>& edits);

  /// Who sits where, and nothing else: no edit is counted. Ignored: it is not possible.
  void Sit(const SeatEdit& seat);

  /// Whether the edit could be applied now. Does not look at distances.
  Status Validate(const Edit& edit) const;

  /// Parts that an edit is about, as far as they exist; none for kInsert's own.
  std::vector<PartId> PartsOf(const Edit& edit) const;

  /// Whether there is, or was, a joint of this number.
  bool HasJoint(std::int32_t joint) const;
  /// Whether the joint's place is one that bonds take. Requires HasJoint.
  bool IsBond(std::int32_t joint) const { return slots_[static_cast<std::size_t>(joint)].bond; }
  /// The revision at which the joint of this number was made; 0: the scene has it. What somebody
  /// says of a joint at an earlier revision is about another one. Requires HasJoint.
  int JointMadeAt(std::int32_t joint) const {
    return slots_[static_cast<std::size_t>(joint)].made_at;
  }

 private:
  friend class TopologyBuilder;

  /// What is known of a joint's place besides the joint.
  struct Slot {
    int made_at = 0;    // revision
    bool bond = false;  // a bond made it: once it is gone, the next bond takes its place
  };

  Status ValidateBond(const BondEdit& bond) const;
  Status ValidateInsert(const InsertEdit& insert) const;
  Status ApplyOne(const Edit& edit);
  void Bond(const BondEdit& edit);
  /// Glue or a grip in a place that bonds take.
  void PutBond(std::int32_t slot, const BondEdit& edit);
  /// Moves the places of one side to where the bond wants them.
  void MoveSide(const BondEdit& edit);
  Status Insert(const InsertEdit& edit);
  void Break(std::int32_t joint);
  void Free(PartId part);
  void Remove(PartId part);
  void FreeBricks(const BlastEdit& blast);
  /// Keeps what bricks may lie on, as the scene begins.
  void KeepGround();
  /// After a part has left, or is anchored no more: notes the bricks that lay on it and now hang.
  void NoteHanging(PartId part);
  void SetHanging(std::vector<Brick> hanging);
  bool Has(PartId part) const;
  bool RoomFor(std::size_t more) const;
  void UpdateComposition();

  Scene scene_;
  Composition composition_;
  std::vector<Slot> slots_;            // by joint
  std::set<std::int32_t> free_bonds_;  // places of bonds that are gone
  bool stale_ = false;                 // composition_ is older than scene_
  int revision_ = 0;
  mutable std::shared_ptr<FeatherStore> left_;  // shared by copies until one of them changes it
  mutable std::size_t left_parts_ = 0;          // parts whose bricks are out of it
  std::shared_ptr<const std::vector<Part>> ground_;  // what bricks may lie on, as the scene begins
  mutable std::shared_ptr<const Foundations> foundations_;  // made with left_
  std::optional<Vec2> hanging_;
};

/// Parts that may come to be while a room runs, gone ones included.
constexpr std::size_t kPartsEver = 250000;
/// The same of joints; those that bonds make are fewer than the parts that are there.
constexpr std::size_t kJointsEver = 250000;

/// Welded parts may be this far from their root, m, by bonds and inserts in their turn.
constexpr float kReachEver = 4000;
/// Places of parts and ends of joints stay within this, m and rad, however often bonds move them.
constexpr float kPlaceMax = 1e5f, kTurnMax = 1e6f;

/// Adds the [[part]]s and [[joint]]s of `text` to a scene. Throws OperatorError, with the scene
/// unchanged, "insert:LINE: what". Joints may name parts of the scene. What is added is held to the
/// limits of crowding.h: among itself and with what never moves. `whole` false leaves out that, and
/// what has to do with who is one body with whom.
void AddToScene(const std::string& text, Scene* scene, bool whole = true);

}  // namespace seam
