#include "render/draw/draw_joints.h"

#include <algorithm>
#include <vector>

#include "common/sync/edits/edit_order.h"
#include "common/topology/grip.h"
#include "render/canvas/palette.h"

namespace seam {
namespace {

constexpr float kGripRing = 5;            ///< px at scale 1; radius of the ring around a hand's pin
constexpr float kPinsFrom_px_per_m = 12;  ///< least scale; pins would cover smaller bodies

std::optional<Vec2> AnchorOn(const Viewport& viewport, const Playback& playback,
                             const DrawnRevision& revision, const Moment& moment, PartId id,
                             bool anchored, const Vec2& anchor) {
  if (id < 0) return viewport.ToPx(anchor);
  if (!anchored) {
    const auto shown = playback.Find(moment, id);
    if (!shown) return std::nullopt;
    return viewport.ToPx(Frame2(shown->pose)(anchor));
  }
  for (const BodyShapes& body : revision.anchored)
    if (body.id == id) return viewport.ToPx(Frame2(playback.Anchored(body, moment.tick))(anchor));
  return std::nullopt;
}

constexpr double kCrackSeconds = 0.5;
constexpr float kCrack_m = 0.7f;  ///< length

/// A crack: the joint's place in the frame of part a, in the world now, and the direction to b.
struct Crack {
  Vec2 at{0, 0}, along{1, 0};
};

std::optional<Crack> CrackOf(const Playback& playback, const Moment& moment, const Joint& joint,
                             const Scene& scene) {
  const auto a = playback.FindPart(moment, joint.a), b = playback.FindPart(moment, joint.b);
  if (!a || !b) return std::nullopt;
  const Part& part = scene.parts[static_cast<std::size_t>(joint.a)];
  const Vec2 offset = joint.anchor_a - part.position;
  Crack crack;
  crack.at = Frame2({a->position, a->angle - part.angle})(offset);
  const Vec2 apart = b->position - a->position;
  if (apart.norm() > 1e-3f) crack.along = apart.normalized();
  return crack;
}

}  // namespace

void DrawRods(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity) {
  const auto revision = playback.RevisionOf(moment);
  for (const DrawnJoint& joint : revision->joints) {
    if (!joint.rod) continue;
    const auto a =
        AnchorOn(viewport, playback, *revision, moment, joint.a, joint.a_anchored, joint.anchor_a);
    const auto b =
        AnchorOn(viewport, playback, *revision, moment, joint.b, joint.b_anchored, joint.anchor_b);
    if (a && b)
      list.Stroke({*a, *b}, false, {1.5f * list.font().scale(), Faded(kFaintInk, opacity), 0});
  }
}

void DrawPins(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity) {
  if (viewport.px_per_m < kPinsFrom_px_per_m) return;
  const auto revision = playback.RevisionOf(moment);
  for (const DrawnJoint& joint : revision->joints) {
    if (joint.rod) continue;
    const auto a =
        AnchorOn(viewport, playback, *revision, moment, joint.a, joint.a_anchored, joint.anchor_a);
    const float scale = list.font().scale();
    if (a) list.Disc(*a, 1.6f * scale, Faded(kInk, opacity));
    if (a && joint.grip) list.Ring(*a, kGripRing * scale, {1.5f * scale, Faded(kInk, opacity), 0});
  }
}

void DrawBreaks(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick) {
  const auto& edits = playback.recording().edits;
  if (moment.before == nullptr || edits.empty()) return;
  const double span = kCrackSeconds * playback.tick_hz();
  const float scale = list.font().scale();
  for (const auto& [number, edit] : edits) {
    if (number >= moment.before->revision) break;
    const double age = tick - static_cast<double>(edit.tick);
    const bool recent = age >= 0 && age < span;
    const Edit decoded = ToEdit(edit);
    const BreakEdit* broken = decoded.As<BreakEdit>();
    if (!recent || broken == nullptr || broken->joint < 0) continue;
    const auto world = playback.WorldOf(moment);
    const auto& joints = world->scene().joints;
    const auto index = static_cast<std::size_t>(broken->joint);
    if (index >= joints.size()) continue;
    const Joint& joint = joints[index];
    if (IsGrip(joint)) continue;  // a hand that lets go breaks nothing
    const auto crack = CrackOf(playback, moment, joint, world->scene());
    if (!crack || !viewport.Sees(crack->at, kCrack_m)) continue;
    const Vec2 middle = viewport.ToPx(crack->at);
    const Vec2 along(crack->along.x(), -crack->along.y()), across(along.y(), -along.x());
    const float half = std::clamp(kCrack_m / 2 * viewport.px_per_m, 5 * scale, 20 * scale);
    std::vector<Vec2> zigzag;
    for (int i = -3; i <= 3; ++i) {
      const float side = i % 2 == 0 ? -0.22f : 0.22f;
      zigzag.push_back(middle + across * (half * static_cast<float>(i) / 3) + along * half * side);
    }
    const auto fresh = static_cast<float>(1 - age / span);
    list.Stroke(zigzag, false, {4 * scale, Faded(kPanel, 0.8f * fresh), 0});
    list.Stroke(zigzag, false, {2 * scale, Faded(kSpark, fresh), 0});
  }
}

}  // namespace seam
