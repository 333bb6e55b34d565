#pragma once
/// What a world's edits leave behind: of all that was ever edited, as much as it takes to make the
/// world of its scene. What is pushed, and glue that formed and broke, leaves nothing.
///
///   steps    inserts and blasts in their order (they give parts and joints their numbers), with
///            removals, releases and breaks between them: an insert is read as it was read then
///   table    where bonds have moved parts and ends of joints; the bonds that are there; seats

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "common/topology/topology.h"
#include "common/topology/topology_entry.h"

namespace seam {

class TopologyFold {
 public:
  /// Begins with a topology that has had no edits.
  explicit TopologyFold(const Topology& begin);

  /// To be called after each edit, with the topology that it was applied to.
  void Note(const Edit& edit, const Topology& now);

  /// What makes `now` of its scene; requires the topology of the last Note. Costs a look at all
  /// parts, joints and steps.
  std::vector<TopologyEntry> Entries(const Topology& now) const;

  /// Steps that are kept: at most a few for each part and joint there ever was.
  std::size_t steps() const { return steps_.size(); }

 private:
  struct Place {
    Vec2 position{0, 0};
    float angle = 0;
  };
  struct Step {
    AnyEdit what;  // monostate: what it made has left, and nothing needs it
    std::size_t parts_before = 0, parts_after = 0;
    std::size_t joints_before = 0, joints_after = 0;
    std::vector<TopologyEntry> named;  // places of parts that an insert's joints name, then
  };

  /// A gear goes with either of its joints.
  void NoteGearsOf(std::int32_t joint, const Scene& scene);
  void NoteInsert(const InsertEdit& insert, const Topology& now);
  void NoteGrowth(const Topology& now);
  /// By step: what it made has left, and no step that is kept names it.
  std::vector<bool> Dropped(const Topology& now) const;
  void Prune(const Topology& now);
  void AddSteps(const Topology& now, std::vector<TopologyEntry>* entries) const;
  void AddPlaces(const Topology& now, std::vector<TopologyEntry>* entries) const;
  void AddJoints(const Topology& now, std::vector<TopologyEntry>* entries) const;

  std::size_t first_joints_ = 0;  // of the scene
  std::vector<Step> steps_;
  std::vector<Place> born_;         // by part: where it was when it came
  std::vector<Joint> born_joints_;  // by joint, as it came; of a bond's place nothing
  std::vector<bool> left_, freed_;  // by part: there is a step that says so
  std::vector<bool> broken_;        // by joint: likewise; of a bond's place nothing
  std::vector<int> first_players_;  // by seat: as the scene has it
  std::size_t measured_ = 0;        // joints there were at the last bond
  std::size_t pruned_ = 0;          // steps there were after the last pruning
};

}  // namespace seam
