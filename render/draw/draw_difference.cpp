#include "render/draw/draw_difference.h"

#include <cmath>

#include "render/canvas/palette.h"
#include "render/draw/draw_body.h"

namespace seam {
namespace {

/// Calls visit(body, its pose, its pose in the first run or null) for each body of the second run.
template <typename Visit>
void VisitBoth(const Playback& first, const Playback& second, int peer, double now_s,
               const Visit& visit) {
  const Moment before = first.MomentAt(peer, first.TickAt(now_s));
  const Moment after = second.MomentAt(peer, second.TickAt(now_s));
  const auto revision = second.RevisionOf(after);
  for (const BodyShapes& body : revision->moving) {
    const auto shown = second.Find(after, body.id);
    if (!shown) continue;
    const auto other = first.Find(before, body.id);
    visit(body, shown->pose, other ? &other->pose : nullptr);
  }
}

}  // namespace

void DrawDifference(DrawList& list, const Viewport& viewport, const Playback& first,
                    const Playback& second, int peer, double now_s) {
  const float scale = list.font().scale();
  list.Clip(viewport.panel);
  VisitBoth(first, second, peer, now_s,
            [&](const BodyShapes& body, const Pose& pose, const Pose* other) {
              if (!viewport.Sees(pose.position, body.reach)) return;
              if (other == nullptr) return DrawGhost(list, viewport, body, pose, 1);
              const float apart = (pose.position - other->position).norm();
              const BodyLook look{HeatColour(apart), kInk, false, 1};
              DrawBody(list, viewport, body, pose, look);
              const Vec2 from = viewport.ToPx(other->position), to = viewport.ToPx(pose.position);
              if ((to - from).norm() < 3 * scale) return;
              list.Stroke({from, to}, false, {1.6f * scale, kSpark, 0});
              list.Disc(from, 2.2f * scale, kSpark);
            });
  list.NoClip();
}

double ApartOf(const Playback& first, const Playback& second, int peer, double now_s) {
  double sum = 0;
  int count = 0;
  VisitBoth(first, second, peer, now_s,
            [&](const BodyShapes&, const Pose& pose, const Pose* other) {
              if (other == nullptr) return;
              sum += static_cast<double>((pose.position - other->position).squaredNorm());
              ++count;
            });
  return count > 0 ? std::sqrt(sum / count) : -1;
}

}  // namespace seam
