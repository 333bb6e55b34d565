#pragma once
/// The topology of a world after each number of edits. The bodies of a view are those after
/// View::revision edits.

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

/// Returns the scene of a recording, before its edits. Each thread keeps the last one, as a long
/// scene takes seconds to parse. Throws OperatorError if the text is no scene.
Scene RecordedScene(const Room& room);

/// A topology with indices for frequent lookups.
struct SceneRevision {
  explicit SceneRevision(Topology made);
  const Scene& scene() const { return topology.scene(); }
  const Composition& composition() const { return topology.composition(); }
  /// Returns the index of a part's assembly in the composition; -1: there is no such part.
  int AssemblyOf(PartId part) const;

  Topology topology;
  std::vector<int> moving;  ///< by assembly: index among the moving ones, -1: anchored
  std::vector<PartId> ids;  ///< moving assemblies, ascending
};

/// Returns the pose of a part whose body has the state `body`, computed in double precision, and
/// the body's velocity. Requires a part of that assembly.
BodyState StateOfPart(const Scene& scene, const Assembly& assembly, PartId part,
                      const BodyState& body);

/// The revisions of a scene. Caches a bounded number of them; safe to use from several threads.
class RevisionHistory {
 public:
  /// Requires a scene that ParseScene accepted, and edits in their order.
  explicit RevisionHistory(const Scene& scene, std::vector<Edit> edits = {});
  RevisionHistory(const Scene& scene, const Recording& recording);
  ~RevisionHistory();

  /// Returns the revision after `edits` edits, or after all if there are fewer.
  std::shared_ptr<const SceneRevision> At(int edits) const;
  /// Returns the least number of edits after which all bodies and joints are as after `edits`.
  int Key(int edits) const;
  bool change() const { return !edits_.empty(); }
  /// True if the assembly of `id` has the same parts after both numbers of edits.
  bool SameBody(int edits_a, int edits_b, PartId id) const;
  /// Returns the state of a part in a view, whatever its body; nullopt: the part is anchored or was
  /// removed, or its body is not shown. Sets `index` to that body's index in the view.
  std::optional<BodyState> InView(const View& view, PartId part, std::size_t* index) const;

 private:
  std::vector<Edit> edits_;
  std::vector<int> keys_;                                                  // by number of edits
  mutable std::mutex mutex_;                                               // guards revisions_
  mutable std::map<int, std::shared_ptr<const SceneRevision>> revisions_;  // by key
};

/// Returns the edits of a recording in their order, with an empty edit for each missing number.
std::vector<Edit> EditsOf(const Recording& recording);

/// Returns the index of a body in a view, -1 if it is not shown.
int IndexOf(const View& view, PartId id);
/// Returns the view of a tick, or nullptr.
const View* FindView(const std::map<std::int64_t, View>& views, std::int64_t tick);
/// Returns the state of body `i` of a view.
BodyState StateIn(const View& view, std::size_t i);
/// Returns the tick whose pose the view shows of body `i`, possibly fractional: by the view's own
/// word, which the peer derives from its display delay.
double MomentShown(const View& view, std::size_t i);
/// Returns the nearest whole tick.
std::int64_t TickShown(const View& view, std::size_t i);

}  // namespace seam
