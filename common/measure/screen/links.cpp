/// Finds links of mechanisms that are stretched on a screen.

#include <algorithm>

#include "common/measure/joint_drift.h"
#include "common/measure/screen/noticed.h"
#include "common/measure/screen/screen.h"
#include "common/measure/screen/thresholds.h"

namespace seam {
namespace {

using Bodies = std::vector<BodyState>;

/// The joints of a revision, each with its link's length: from the joint to the farthest point of
/// the joined body, of the shorter one of two.
struct Links {
  explicit Links(const SceneRevision& revision)
      : ids(revision.ids), joints(revision.scene(), revision.composition()) {
    const std::vector<JointEnds> ends = FindJointEnds(revision.scene(), revision.composition());
    for (const JointEnds& joint : ends) {
      double length = 0;
      std::vector<PartId> held;
      for (const JointEnd& end : {joint.a, joint.b}) {
        if (end.moving < 0 || end.moving >= static_cast<int>(ids.size())) continue;
        const Assembly& body =
            revision.composition().assemblies[static_cast<std::size_t>(end.assembly)];
        const double reach = Extent(revision.scene(), body).ReachFrom(end.point);
        length = length > 0 ? std::min(length, reach) : reach;
        held.push_back(body.id);
      }
      lengths.push_back(length);
      bodies.push_back(std::move(held));
    }
  }
  std::vector<PartId> ids;
  JointMeter joints;
  std::vector<double> lengths;              // m, by joint
  std::vector<std::vector<PartId>> bodies;  // by joint: its moving bodies
};

std::optional<Bodies> Shown(const View& view, const std::vector<PartId>& ids) {
  if (view.id.size() != ids.size() || !std::equal(ids.begin(), ids.end(), view.id.begin())) {
    return std::nullopt;
  }
  Bodies states;
  for (std::size_t i = 0; i < ids.size(); ++i) states.push_back(StateIn(view, i));
  return states;
}

/// Returns the drift of the oracle's joints; zeros if the oracle lacks any of the bodies.
std::vector<double> Due(const Oracle& oracle, const Links& links, std::int64_t tick) {
  Bodies states;
  for (const PartId id : links.ids) {
    const std::optional<BodyState> state = oracle.At(tick, id);
    if (!state) return std::vector<double>(links.lengths.size(), 0);
    states.push_back(*state);
  }
  return links.joints.Drifts(states, tick);
}

void Look(const View& view, const Oracle& oracle, const Links& links, BodySeconds* seconds) {
  const std::optional<Bodies> states = Shown(view, links.ids);
  if (!states) return;
  const std::vector<double> drifts = links.joints.Drifts(*states, view.tick);
  std::vector<double> due;
  for (std::size_t j = 0; j < drifts.size(); ++j) {
    const double allowed = std::max(kWayFloor, kStretch * links.lengths[j]);
    if (links.bodies[j].empty() || !(drifts[j] > allowed)) continue;
    if (due.empty()) due = Due(oracle, links, view.tick);
    if (!(drifts[j] - due[j] > allowed)) continue;
    for (const PartId id : links.bodies[j]) seconds->Notice(view.peer, id, view.tick);
  }
}

}  // namespace

void NoticeLinks(const Recording& recording, const Oracle& oracle, const RevisionHistory& revisions,
                 BodySeconds* seconds) {
  std::map<int, std::vector<const View*>> by_revision;
  for (const auto& [peer, views] : recording.views) {
    if (peer < 1) continue;
    for (const auto& [tick, view] : views) {
      by_revision[revisions.Key(view.revision)].push_back(&view);
    }
  }
  for (const auto& [key, views] : by_revision) {
    const Links links(*revisions.At(key));
    if (links.lengths.empty()) continue;
    for (const View* view : views) Look(*view, oracle, links, seconds);
  }
}

}  // namespace seam
