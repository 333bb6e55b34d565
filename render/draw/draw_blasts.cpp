#include "render/draw/draw_blasts.h"

#include <algorithm>
#include <cmath>

#include "common/scene/charges/charge.h"
#include "common/sync/edits/edit_order.h"
#include "render/canvas/palette.h"

namespace seam {
namespace {

constexpr double kFlashSeconds = 0.1, kRingSeconds = 0.5;

/// True if a blast is visible; one without speed and impulse only frees hanging parts.
bool IsSeen(const BlastEdit& blast) { return blast.speed > 0 || blast.impulse > 0; }

bool IsOf(const Charge& charge, const BlastEdit& blast) {
  const bool there = charge.part >= 0 || charge.position == blast.centre;
  return there && charge.radius == blast.radius && charge.speed == blast.speed &&
         charge.impulse == blast.impulse;
}

}  // namespace

void DrawCharges(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment, double tick) {
  const float scale = list.font().scale();
  for (const Charge& charge : playback.scene().charges) {
    bool over = false;
    for (const auto& [number, order] : playback.recording().edits) {
      const Edit edit = ToEdit(order);
      const BlastEdit* blast = edit.As<BlastEdit>();
      over = over ||
             (blast != nullptr && static_cast<double>(order.tick) <= tick && IsOf(charge, *blast));
    }
    if (over) continue;
    Vec2 centre = charge.position;
    if (charge.part >= 0) {
      const auto part = playback.FindPart(moment, charge.part);
      if (!part) continue;
      centre += part->position;
    }
    if (!viewport.Sees(centre, charge.radius)) continue;
    const Vec2 at = viewport.ToPx(centre);
    list.Disc(at, 4 * scale, kSpark);
    list.Ring(at, charge.radius * viewport.px_per_m,
              {1.2f * scale, Faded(kSpark, 0.35f), 8 * scale});
  }
}

void DrawBlasts(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick) {
  if (moment.before == nullptr) return;
  const float scale = list.font().scale();
  for (const auto& [number, order] : playback.recording().edits) {
    if (number >= moment.before->revision) break;
    const double age = (tick - static_cast<double>(order.tick)) / playback.tick_hz();
    if (age < 0 || age > kRingSeconds) continue;
    const Edit edit = ToEdit(order);
    const BlastEdit* blast = edit.As<BlastEdit>();
    if (blast == nullptr || !IsSeen(*blast) || !viewport.Sees(blast->centre, blast->radius)) {
      continue;
    }
    const Vec2 at = viewport.ToPx(blast->centre);
    const float radius = blast->radius * viewport.px_per_m;
    const auto fresh = static_cast<float>(1 - age / kRingSeconds);
    if (age < kFlashSeconds) {
      const auto flash = static_cast<float>(1 - age / kFlashSeconds);
      list.Disc(at, 0.3f * radius, Faded(kSpark, 0.5f * flash));
    }
    const float grown = std::sqrt(1 - fresh * fresh);  // quickly at first
    list.Ring(at, std::max(0.1f, grown) * radius,
              {std::max(1.0f, 5 * fresh) * scale, Faded(kSpark, fresh), 0});
  }
}

}  // namespace seam
