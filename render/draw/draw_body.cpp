#include "render/draw/draw_body.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "render/canvas/palette.h"

namespace seam {
namespace {

/// Shares of the edge's colour in a far limb, and in a figure's hair and pelvis.
constexpr float kFarTone = 0.55f, kFigureTone = 0.3f;

std::vector<Vec2> OnPanel(const Viewport& viewport, const std::vector<Vec2>& local,
                          const Frame2& frame) {
  std::vector<Vec2> px;
  px.reserve(local.size());
  for (const Vec2& p : local) px.push_back(viewport.ToPx(frame(p)));
  return px;
}

/// Shades the ground below a chain, if the chain runs sideways only.
void ShadeBelow(DrawList& list, const Viewport& viewport, const std::vector<Vec2>& px,
                const BodyLook& look) {
  for (std::size_t i = 2; i < px.size(); ++i)
    if ((px[i].x() - px[i - 1].x()) * (px[1].x() - px[0].x()) <= 0) return;
  const float depth = std::min(2.0f * viewport.px_per_m, 40 * list.font().scale());
  for (std::size_t i = 1; i < px.size(); ++i) {
    const Vec2 quad[4] = {px[i - 1], px[i], px[i] + Vec2(0, depth), px[i - 1] + Vec2(0, depth)};
    list.FillShaded(quad, Faded(look.fill, look.opacity), Faded(look.fill, 0));
  }
}

float EdgeWidth(const DrawList& list, float size_px) {
  return std::clamp(size_px / 10, 0.7f, 1.5f) * list.font().scale();
}

void DrawOutline(DrawList& list, const Viewport& viewport, const Outline& outline,
                 const Frame2& frame, BodyLook look) {
  if (outline.figure.far_side) look.fill = Mix(look.fill, look.edge, kFarTone);
  const Colour fill = Faded(look.fill, look.opacity);
  const Colour edge = Faded(look.edge, look.opacity);
  std::vector<Vec2> px = OnPanel(viewport, outline.points, frame);
  if (IsLine(outline.kind)) {
    if (outline.kind == ShapeKind::kChain) ShadeBelow(list, viewport, px, look);
    list.Stroke(px, false, {2 * list.font().scale(), edge, 0});
    return;
  }
  const bool circle = outline.kind == ShapeKind::kCircle;
  const Vec2 centre = px[0], rim = px[circle ? 1 : 0];
  float size = 2 * outline.radius * viewport.px_per_m;
  if (circle) {
    px = CirclePoints(centre, size / 2);
  } else {
    size = (px[0] - px[px.size() / 2]).norm();
  }
  if (size < 1.5f) {  // too small for an edge: a dot
    list.Disc(centre, 0.75f, edge);
    return;
  }
  list.Fill(px, fill);
  if (!outline.figure.tone.empty()) {
    list.Fill(OnPanel(viewport, outline.figure.tone, frame),
              Faded(Mix(look.fill, look.edge, kFigureTone), look.opacity));
  }
  if (look.hatched && size > 5) {
    const float s = 0.70710678f;
    const Vec2 normal(s * (frame.cosine + frame.sine), s * (frame.cosine - frame.sine));
    const Vec2 origin = viewport.ToPx(frame.position);
    list.Hatch(px, origin, normal, 6 * list.font().scale(), Faded(edge, 0.55f));
  }
  const float width = EdgeWidth(list, size);
  list.Stroke(px, true, {width, edge, 0});
  if (circle && size > 8)
    list.Stroke({centre, centre + 0.8f * (rim - centre)}, false, {width, edge, 0});
}

/// Draws the parts without edges, and the outer edge of the whole body.
void DrawRimmed(DrawList& list, const Viewport& viewport, const BodyShapes& body,
                const Frame2& frame, const BodyLook& look) {
  const float scale = list.font().scale();
  const float s = 0.70710678f;
  const Vec2 normal(s * (frame.cosine + frame.sine), s * (frame.cosine - frame.sine));
  const Vec2 origin = viewport.ToPx(frame.position);
  for (const Outline& outline : body.outlines) {
    std::vector<Vec2> px = OnPanel(viewport, outline.points, frame);
    if (outline.kind == ShapeKind::kCircle)
      px = CirclePoints(px[0], outline.radius * viewport.px_per_m);
    list.Fill(px, Faded(look.fill, look.opacity));
    if (look.hatched)
      list.Hatch(px, origin, normal, 6 * scale, Faded(look.edge, 0.55f * look.opacity));
  }
  for (const auto& edge : body.rim)
    list.Stroke(OnPanel(viewport, {edge[0], edge[1]}, frame), false,
                {1.1f * scale, Faded(look.edge, look.opacity), 0});
}

}  // namespace

BodyLook LookOf(Colour base, int role) {
  constexpr Colour kWhite{255, 255, 255, 255};
  BodyLook look;
  look.edge = Darker(base);
  switch (role) {
    case kRoleAuthority: look.fill = base; break;
    case kRoleSecondary: look.fill = Mix(base, kWhite, 0.5f); break;
    default:
      look.fill = Mix(base, kWhite, 0.86f);
      look.edge = Mix(look.edge, base, 0.5f);
      look.hatched = true;
  }
  return look;
}

BodyLook GroundLook() { return {kGround, kGroundEdge, false, 1}; }

void DrawBody(DrawList& list, const Viewport& viewport, const BodyShapes& body, const Pose& pose,
              const BodyLook& look) {
  const Frame2 frame(pose);
  if (!body.rim.empty()) return DrawRimmed(list, viewport, body, frame, look);
  for (const Outline& outline : body.outlines) DrawOutline(list, viewport, outline, frame, look);
}

void DrawGhost(DrawList& list, const Viewport& viewport, const BodyShapes& body, const Pose& pose,
               float opacity, float width) {
  const float scale = list.font().scale();
  const Frame2 frame(pose);
  const bool small = body.reach * viewport.px_per_m < 10 * scale;  // dashes would be too small
  const Line rim{(width + 1.7f) * scale, Faded({255, 255, 255, 255}, 0.6f * opacity), 0};
  const Line line{small ? 0.8f * scale : width * scale, Faded(kInk, (small ? 0.7f : 1) * opacity),
                  small ? 0 : 5 * scale};
  for (const auto& edge : body.rim) {  // dashes as long as the edges: each edge is one line
    const std::vector<Vec2> px = OnPanel(viewport, {edge[0], edge[1]}, frame);
    if ((px[0] - px[1]).norm() > 4 * scale) {
      list.Stroke(px, false, line);
    } else {
      list.Stroke({px[0], px[0] + 0.55f * (px[1] - px[0])}, false, {line.width, line.colour, 0});
    }
  }
  if (!body.rim.empty()) return;
  for (const Outline& outline : body.outlines) {
    std::vector<Vec2> px = OnPanel(viewport, outline.points, frame);
    if (outline.kind == ShapeKind::kCircle)
      px = CirclePoints(px[0], outline.radius * viewport.px_per_m);
    const bool closed = !IsLine(outline.kind);
    if (!small) list.Stroke(px, closed, rim);
    list.Stroke(px, closed, line);
  }
}

void DrawSpark(DrawList& list, const Vec2& at, float radius, float reach, const Line& line) {
  list.Ring(at, radius, line);
  for (int ray = 0; ray < 8; ++ray) {
    const float a = kPiFloat / 4 * static_cast<float>(ray) + kPiFloat / 8;
    const Vec2 way(std::cos(a), std::sin(a));
    list.Stroke({at + way * (radius + 0.3f * reach), at + way * (radius + reach)}, false, line);
  }
}

float PixelsApart(const Viewport& viewport, const BodyShapes& body, const Pose& a, const Pose& b) {
  const float turn = body.round ? 0 : std::abs(WrapAngle(a.angle - b.angle));
  return ((a.position - b.position).norm() + turn * body.reach) * viewport.px_per_m;
}

}  // namespace seam
