#pragma once
/// Compacts the edit history to the minimum that rebuilds the current topology from the scene.
/// Pushes, and glue that formed and broke, leave no entry.
///
///   steps    inserts and blasts in order (they number the parts and joints), interleaved with
///            removals, releases and breaks, so that an insert is read in the same context
///   table    places of parts and joint ends that bonds have moved; current bonds; seats

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "common/base/status.h"
#include "common/topology/topology.h"
#include "common/topology/topology_entry.h"

namespace seam {

class TopologyFold {
 public:
  /// Starts from a topology without edits.
  explicit TopologyFold(const Topology& begin);

  /// Records an edit. Must be called after each edit, with the topology that it was applied to.
  void Note(const Edit& edit, const Topology& now);

  /// Returns the entries that turn the scene into `now`. Requires the topology of the last Note.
  /// Cost: a pass over all parts, joints and steps.
  std::vector<TopologyEntry> Entries(const Topology& now) const;

  /// Makes the fold and the topology that gave these entries, from the scene of both. Trusts none
  /// of them. Requires a scene that ParseScene accepted, and revision >= 0.
  static Status FromEntries(const Scene& scene, const std::vector<TopologyEntry>& entries,
                            int revision, TopologyFold* fold, Topology* topology);

  /// Number of steps kept: at most a few for each part and joint there ever was.
  std::size_t steps() const { return steps_.size(); }

 private:
  struct Place {
    Vec2 position{0, 0};
    float angle = 0;
  };
  struct Step {
    AnyEdit what;  // monostate: its parts and joints have left, and nothing needs them
    std::size_t parts_before = 0, parts_after = 0;
    std::size_t joints_before = 0, joints_after = 0;
    std::vector<TopologyEntry> named;  // places at that time of parts that an insert's joints name
  };

  /// Records the gears that end with a joint.
  void RecordGearsOf(std::int32_t joint, const Scene& scene);
  void RecordInsert(const InsertEdit& insert, const Topology& now);
  void RecordGrowth(const Topology& now);
  /// Records an entry that a topology has just had.
  void NoteEntry(const TopologyEntry& entry, const Topology& now);
  /// Returns by step: its parts and joints have left, and no kept step refers to them.
  std::vector<bool> Dropped(const Topology& now) const;
  void Prune(const Topology& now);
  void AddSteps(const Topology& now, std::vector<TopologyEntry>* entries) const;
  void AddPlaces(const Topology& now, std::vector<TopologyEntry>* entries) const;
  void AddJoints(const Topology& now, std::vector<TopologyEntry>* entries) const;

  std::size_t first_joints_ = 0;  // number of joints of the scene
  std::vector<Step> steps_;
  std::vector<Place> first_poses_;       // by part: pose at its first appearance
  std::vector<Joint> first_joint_data_;  // by joint, as first made; default for bonds
  std::vector<bool> left_, freed_;  // by part: a step records it
  std::vector<bool> broken_;        // by joint, likewise; unused for bonds
  std::vector<int> first_players_;  // by seat: the scene's player
  std::size_t measured_ = 0;        // number of joints at the last bond
  std::size_t pruned_ = 0;          // number of steps after the last pruning
};

}  // namespace seam
