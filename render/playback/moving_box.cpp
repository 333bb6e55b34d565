#include "render/playback/moving_box.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/scene/assembly.h"

namespace seam {
namespace {

constexpr float kMoved_m = 0.1f;  ///< bodies that move less are not fitted
constexpr float kTurned_rad = 0.3f;

/// Returns the body that is farthest from the oracle in the views; -1: none is kMoved_m from it.
PartId WorstBodyOf(const std::vector<CameraView>& views, const std::vector<double>& times) {
  PartId worst = -1;
  float most = kMoved_m;
  for (const CameraView& view : views) {
    const Playback& playback = *view.playback;
    for (const double s : times) {
      const double tick = playback.TickAt(s);
      const Moment moment = playback.MomentAt(playback.PeerOr(view.peer), tick);
      for (const BodyShapes& body : playback.RevisionOf(moment)->moving) {
        const auto shown = playback.Find(moment, body.id);
        const auto truth = shown ? playback.Truth(body.id, shown->tick) : std::nullopt;
        if (!truth) continue;
        const float apart = (shown->pose.position - truth->position).norm();
        if (apart <= most) continue;
        most = apart;
        worst = body.id;
      }
    }
  }
  return worst;
}

}  // namespace

std::vector<double> SampleTimes(double from_s, double to_s) {
  std::vector<double> times;
  const auto count = static_cast<int>(std::ceil((to_s - from_s) * kSamplesPerSecond)) + 1;
  for (int i = 0; i < count; ++i) times.push_back(from_s + i / kSamplesPerSecond);
  return times;
}

void ForEachPose(const CameraView& view, const std::set<PartId>* only, double s,
                 const PoseVisit& visit) {
  const Playback& playback = *view.playback;
  const double tick = playback.TickAt(s);
  const Moment moment = playback.MomentAt(playback.PeerOr(view.peer), tick);
  const auto revision = playback.RevisionOf(moment);
  for (const BodyShapes& body : revision->moving) {
    if (only != nullptr && only->count(body.id) == 0) continue;
    if (const auto truth = playback.Truth(body.id, tick)) visit(body, *truth, 0);
    if (const auto shown = playback.Find(moment, body.id)) visit(body, shown->pose, 1);
  }
}

void WorldBox::Add(const Vec2& p, float radius) {
  min = min.cwiseMin(p - Vec2(radius, radius));
  max = max.cwiseMax(p + Vec2(radius, radius));
}

void WorldBox::Add(const BodyShapes& body, const Pose& pose) {
  const Frame2 frame(pose);
  for (const Outline& outline : body.outlines)
    for (const Vec2& p : outline.points) Add(frame(p), outline.radius);
}

void WorldBox::Add(const WorldBox& other) {
  min = min.cwiseMin(other.min);
  max = max.cwiseMax(other.max);
}

std::set<PartId> MovingBodies(const std::vector<CameraView>& views, double from_s, double to_s) {
  std::set<PartId> moving;
  for (const CameraView& view : views) {
    std::map<std::pair<PartId, int>, Pose> first;
    for (const double s : SampleTimes(from_s, to_s)) {
      ForEachPose(view, nullptr, s, [&](const BodyShapes& body, const Pose& pose, int which) {
        const auto [known, fresh] = first.emplace(std::pair(body.id, which), pose);
        if (fresh) return;
        const Pose& before = known->second;
        const bool turned = !body.round && std::abs(pose.angle - before.angle) > kTurned_rad;
        if (turned || (pose.position - before.position).norm() > kMoved_m) moving.insert(body.id);
      });
    }
  }
  return moving;
}

std::set<PartId> VehicleBodies(const Playback& playback) {
  const auto first = playback.WorldOf(playback.MomentAt(playback.PeerOr(-1), playback.TickAt(0)));
  const Composition& made = first->composition();
  std::set<PartId> bodies;
  for (const Player& player : playback.scene().players) {
    const auto part = static_cast<std::size_t>(player.vehicle);
    if (player.vehicle < 0 || part >= made.assembly_of_part.size()) continue;
    const int assembly = made.assembly_of_part[part];
    if (assembly < 0) continue;
    const int mechanism = made.assemblies[static_cast<std::size_t>(assembly)].mechanism;
    if (mechanism < 0) continue;
    for (const int one : made.mechanisms[static_cast<std::size_t>(mechanism)].assemblies) {
      bodies.insert(made.assemblies[static_cast<std::size_t>(one)].id);
    }
  }
  return bodies;
}

std::set<PartId> LeadingBodies(const std::vector<CameraView>& views, double from_s, double to_s) {
  std::set<PartId> leading = VehicleBodies(*views.front().playback);
  const PartId worst = WorstBodyOf(views, SampleTimes(from_s, to_s));
  if (worst >= 0) leading.insert(worst);
  return leading;
}

WorldBox BoxOf(const std::vector<CameraView>& views, const std::set<PartId>& bodies, double s) {
  WorldBox box;
  for (const CameraView& view : views) {
    ForEachPose(view, &bodies, s,
                [&](const BodyShapes& body, const Pose& pose, int) { box.Add(body, pose); });
  }
  return box;
}

}  // namespace seam
