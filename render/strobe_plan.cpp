// Chooses the moments, the views and the part of the world for a strobe picture.

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/check.h"
#include "render/frame.h"
#include "render/playback/camera.h"
#include "render/playback/moments.h"
#include "render/strobe.h"
#include "render/strobe_layout.h"

namespace seam {
namespace {

constexpr double kBeforeHit_s = 0.2, kAfterHit_s = 0.8;  ///< window around the collision
constexpr int kExposures = 8;                            ///< default number
constexpr double kExposuresMax = 200;
constexpr float kStill_m = 0.3f;  ///< bodies that move less are not fitted

/// Returns the box of all bodies that move in the window, in the oracle and in all displayed views.
WorldBox MovingBox(const std::vector<Playback>& playbacks, const StrobePlan& plan) {
  WorldBox box;
  for (const Playback& playback : playbacks) {
    const std::set<PartId> struck = StruckBodies(playback);
    const Moment middle = playback.MomentAt(playback.PeerOr(plan.peers.front()),
                                            playback.TickAt((plan.from_s + plan.to_s) / 2));
    const auto revision = playback.RevisionOf(middle);
    for (const BodyShapes& body : revision->moving) {
      WorldBox path, extent;
      for (double s = plan.from_s; s <= plan.to_s + 1e-9; s += plan.step_s) {
        const double tick = playback.TickAt(s);
        const auto add = [&](const Pose& pose) {
          path.Add(pose.position, 0);
          extent.Add(body, pose);
        };
        if (const auto truth = playback.Truth(body.id, tick)) add(*truth);
        for (int peer : plan.peers)
          if (const auto shown =
                  playback.Find(playback.MomentAt(playback.PeerOr(peer), tick), body.id))
            add(shown->pose);
      }
      if (path.empty()) continue;
      const bool still = (path.max - path.min).norm() < kStill_m;
      if (still && struck.count(body.id) == 0) continue;
      box.Add(extent);
    }
  }
  return box;
}

void ChooseBox(const std::vector<Playback>& playbacks, StrobePlan* plan) {
  std::vector<CameraView> views;
  for (const Playback& playback : playbacks) {
    for (const int peer : plan->peers) views.push_back({&playback, playback.PeerOr(peer)});
  }
  const PartId followed = playbacks.front().scene().camera.follow;
  const WorldBox camera = ActionArea(views, plan->from_s, plan->to_s);
  WorldBox box = MovingBox(playbacks, *plan);
  if (box.empty()) {
    box.min = camera.min;
    box.max = camera.max;
  }
  // A body flung far away must not make the rest of the picture tiny.
  const Vec2 margin = 0.06f * (box.max - box.min) + Vec2(0.3f, 0.5f);
  Vec2 min = box.min - margin, max = box.max + margin;
  if (followed < 0) {
    min = min.cwiseMax(camera.min);
    max = max.cwiseMin(camera.max);
  }
  if (min.x() >= max.x() || min.y() >= max.y()) {
    min = camera.min;
    max = camera.max;
  }
  // Rows are wide: at most 6 to 1, at least 2.2 to 1.
  const Vec2 size = max - min;
  const float height = std::max(size.y(), size.x() / 6);
  const float width = std::max(size.x(), 2.2f * height);
  max.y() = min.y() + height;
  const float middle = (min.x() + max.x()) / 2;
  plan->min = {middle - width / 2, min.y()};
  plan->max = {middle + width / 2, max.y()};
}

std::vector<int> Columns(const std::vector<Playback>& playbacks, int only) {
  std::set<int> clients;
  for (const Playback& playback : playbacks)
    for (int peer : playback.peers())
      if (peer > 0) clients.insert(peer);
  if (only >= 0) return {only};
  std::vector<int> columns(clients.begin(), clients.end());
  if (columns.size() > 2) columns.resize(2);  // more would be too small to read
  if (columns.empty()) columns.push_back(0);
  return columns;
}

}  // namespace

double CollisionTime(const std::vector<Playback>& playbacks) { return MainMoment(playbacks).s; }

StrobePlan PlanStrobe(const std::vector<Playback>& playbacks, const StrobeOptions& options) {
  SEAM_ASSERT(!playbacks.empty());
  const Playback& first = playbacks.front();
  const double hit_s = CollisionTime(playbacks);
  StrobePlan plan;
  plan.from_s =
      std::isnan(options.from_s) ? std::max(first.first_s(), hit_s - kBeforeHit_s) : options.from_s;
  plan.to_s = std::isnan(options.to_s)
                  ? std::min(first.last_s(), plan.from_s + kBeforeHit_s + kAfterHit_s)
                  : options.to_s;
  if (plan.from_s >= plan.to_s || plan.from_s > first.last_s() || plan.to_s < first.first_s())
    throw OperatorError("--from and --to leave nothing of the recording");
  const double hz = first.tick_hz();
  const double step = std::round((plan.to_s - plan.from_s) * hz / (kExposures - 1));
  plan.step_s = std::max(options.every_ticks > 0 ? options.every_ticks : step, 1.0) / hz;
  if ((plan.to_s - plan.from_s) / plan.step_s > kExposuresMax)
    throw OperatorError("too many exposures: choose a shorter part or a larger --every");
  plan.peers = Columns(playbacks, options.peer);
  ChooseBox(playbacks, &plan);
  if (options.width_px > 0) plan.width_px = options.width_px;
  plan.height_px = options.height_px > 0 ? options.height_px
                                         : StrobeHeight(plan, static_cast<int>(playbacks.size()));
  return plan;
}

}  // namespace seam
