#pragma once
/// What a world that changes at run time is made of after each number of edits: the bodies of a
/// view are those of the revision of View::revision.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "common/record/recording.h"
#include "common/scene/types.h"
#include "common/topology/topology.h"

namespace seam {

/// A topology and what is looked up in it again and again.
struct SceneRevision {
  explicit SceneRevision(Topology made);
  const Scene& scene() const { return topology.scene(); }
  const Composition& composition() const { return topology.composition(); }
  /// Index into the composition's assemblies; -1: there is no such part.
  int AssemblyOf(PartId part) const;

  Topology topology;
  std::vector<int> moving;  ///< by assembly: index among the moving ones, -1: anchored
  std::vector<PartId> ids;  ///< of the moving assemblies, ascending
};

/// Where a part is when the body that it belongs to is at `body`, in double precision; its
/// velocity is the body's. Requires a part of that assembly.
BodyState StateOfPart(const Scene& scene, const Assembly& assembly, PartId part,
                      const BodyState& body);

/// Keeps a few revisions; safe to use from several threads.
class RevisionHistory {
 public:
  /// Requires a scene that ParseScene accepted. Edits in their order.
  explicit RevisionHistory(const Scene& scene, std::vector<Edit> edits = {});
  RevisionHistory(const Scene& scene, const Recording& recording);
  ~RevisionHistory();

  /// After so many edits, or after all there are.
  std::shared_ptr<const SceneRevision> At(int edits) const;
  /// The least number of edits after which all bodies and joints are as after `edits`.
  int Key(int edits) const;
  bool change() const { return !edits_.empty(); }
  /// Whether the assembly of that id has the same parts after both numbers of edits.
  bool SameBody(int edits_a, int edits_b, PartId id) const;
  /// A part in a view, whichever body it is in; nullopt: it is anchored or has left, or its body is
  /// not shown. `index`: of that body in the view.
  std::optional<BodyState> InView(const View& view, PartId part, std::size_t* index) const;

 private:
  std::vector<Edit> edits_;
  std::vector<int> keys_;                                                  // by number of edits
  mutable std::mutex mutex_;                                               // guards revisions_
  mutable std::map<int, std::shared_ptr<const SceneRevision>> revisions_;  // by key
};

/// The edits of a recording in their order; those that the log lacks do nothing.
std::vector<Edit> EditsOf(const Recording& recording);

/// The index of a body in a view, -1 if it is not shown.
int IndexOf(const View& view, PartId id);
/// nullptr when there is none of the tick.
const View* FindView(const std::map<std::int64_t, View>& views, std::int64_t tick);
/// Body i of a view.
BodyState StateIn(const View& view, std::size_t i);

}  // namespace seam
