#include "render/draw/draw_joints.h"

#include "render/canvas/palette.h"

namespace seam {
namespace {

constexpr float kPinsFrom_px_per_m = 12;   ///< smaller bodies would be all pins

std::optional<Vec2> AnchorOn(const Viewport& viewport, const Playback& playback,
                             const DrawnForm& form, const Moment& moment, PartId id,
                             bool anchored, const Vec2& anchor) {
  if (!anchored) {
    const auto shown = playback.Find(moment, id);
    if (!shown) return std::nullopt;
    return viewport.ToPx(Frame2(shown->pose)(anchor));
  }
  for (const BodyShapes& body : form.anchored)
    if (body.id == id) return viewport.ToPx(Frame2(playback.Anchored(body, moment.tick))(anchor));
  return std::nullopt;
}

}  // namespace

void DrawRods(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity) {
  const auto form = playback.FormOf(moment);
  for (const DrawnJoint& joint : form->joints) {
    if (!joint.rod) continue;
    const auto a = AnchorOn(viewport, playback, *form, moment, joint.a, joint.a_anchored,
                            joint.anchor_a);
    const auto b = AnchorOn(viewport, playback, *form, moment, joint.b, joint.b_anchored,
                            joint.anchor_b);
    if (a && b)
      list.Stroke({*a, *b}, false, {1.5f * list.font().scale(), Faded(kFaintInk, opacity), 0});
  }
}

void DrawPins(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity) {
  if (viewport.px_per_m < kPinsFrom_px_per_m) return;
  const auto form = playback.FormOf(moment);
  for (const DrawnJoint& joint : form->joints) {
    if (joint.rod) continue;
    const auto a = AnchorOn(viewport, playback, *form, moment, joint.a, joint.a_anchored,
                            joint.anchor_a);
    if (a) list.Disc(*a, 1.6f * list.font().scale(), Faded(kInk, opacity));
  }
}

}  // namespace seam
