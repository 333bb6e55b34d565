/// TopologyFold: made from the entries that another one gave.

#include "common/topology/topology_builder.h"
#include "common/topology/topology_fold.h"

namespace seam {

Status TopologyFold::FromEntries(const Scene& scene, const std::vector<TopologyEntry>& entries,
                                 int revision, TopologyFold* fold, Topology* topology) {
  TopologyBuilder builder(scene);
  *fold = TopologyFold(builder.topology());
  for (const TopologyEntry& entry : entries) {
    const Status status = builder.Add(entry);
    if (!status.ok()) return status;
    fold->NoteEntry(entry, builder.topology());
  }
  const Status status = builder.Finish(revision);
  if (status.ok()) *topology = builder.topology();
  return status;
}

void TopologyFold::NoteEntry(const TopologyEntry& entry, const Topology& now) {
  switch (entry.kind) {
    case TopologyEntry::Kind::kParts:
    case TopologyEntry::Kind::kJoints:
      steps_.push_back({std::monostate{},
                        first_poses_.size(),
                        now.scene().parts.size(),
                        first_joint_data_.size(),
                        now.scene().joints.size(),
                        {}});
      return RecordGrowth(now);
    case TopologyEntry::Kind::kInsert: return Note(Edit(InsertEdit{entry.text}), now);
    case TopologyEntry::Kind::kBlast:
      return Note(
          Edit(BlastEdit{{entry.value[0], entry.value[1]}, entry.value[2], entry.value[3], 0}),
          now);
    case TopologyEntry::Kind::kRemove: return Note(Edit(RemoveEdit{entry.a}), now);
    case TopologyEntry::Kind::kFree: return Note(Edit(FreeEdit{entry.a}), now);
    case TopologyEntry::Kind::kBreak: return Note(Edit(BreakEdit{entry.joint}), now);
    case TopologyEntry::Kind::kMeasured: measured_ = static_cast<std::size_t>(entry.joint); return;
    // The rest is in the topology, and compared with what RecordGrowth has seen first.
    case TopologyEntry::Kind::kBonds: return RecordGrowth(now);
    case TopologyEntry::Kind::kPlace:
    case TopologyEntry::Kind::kBond:
    case TopologyEntry::Kind::kEnds:
    case TopologyEntry::Kind::kSeat: return;
  }
}

}  // namespace seam
