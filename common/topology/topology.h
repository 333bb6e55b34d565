#pragma once
/// A scene as it has become by edits: its parts and joints, and who is one body with whom. The same
/// scene and edits give the same topology, bit for bit, on every peer and in every program.

#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

/// Parts and joints are never renumbered: what leaves keeps its index with `gone` set, what
/// comes is appended. Where the scene puts a part (position, angle) is its pose within its
/// assembly: a bond moves the poses of all parts of one side, so that the assembly fits together.
class Topology {
 public:
  /// Requires a scene that ParseScene accepted, or one as good.
  explicit Topology(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const Composition& composition() const { return composition_; }
  /// Edits applied so far, whether or not they could do anything.
  int revision() const { return revision_; }

  /// Applies edits in their order. An edit that cannot be (its part has left, its text is wrong)
  /// counts but does nothing: the same on every peer. Returns what became of each.
  std::vector<Status> Apply(const std::vector<Edit>& edits);

  /// Whether the edit could be applied now. Does not look at distances.
  Status Validate(const Edit& edit) const;

  /// Parts that an edit is about, as far as they exist; none for kInsert's own.
  std::vector<PartId> PartsOf(const Edit& edit) const;

 private:
  Status ValidateBond(const BondEdit& bond) const;
  Status ValidateInsert(const InsertEdit& insert) const;
  Status ApplyOne(const Edit& edit);
  void Bond(const BondEdit& edit);
  Status Insert(const InsertEdit& edit);
  void Remove(PartId part);
  void FreeBricks(const BlastEdit& blast);
  bool Has(PartId part) const;
  bool HasJoint(std::int32_t joint) const;
  void UpdateComposition();

  Scene scene_;
  Composition composition_;
  bool stale_ = false;  // composition_ is older than scene_
  int revision_ = 0;
};

/// Parts that may come to be while a room runs, gone ones included: ids on the wire are int16.
constexpr std::size_t kPartsEver = 30000;

/// Adds the [[part]]s and [[joint]]s of `text` to a scene. Throws OperatorError, with the scene
/// unchanged, "insert:LINE: what". Joints may name parts of the scene.
void AddToScene(const std::string& text, Scene* scene);

}  // namespace seam
