#include "render/canvas/figure.h"

#include "common/base/geometry.h"
#include "common/scene/character.h"

namespace seam {
namespace {

/// Cuts a polygon's corners twice: Chaikin's curve, which stays inside the polygon.
std::vector<Vec2> Rounded(std::vector<Vec2> points) {
  for (int cut = 0; cut < 2; ++cut) {
    std::vector<Vec2> finer;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
      finer.push_back(a + 0.25f * (b - a));
      finer.push_back(a + 0.75f * (b - a));
    }
    points = finer;
  }
  return points;
}

/// Returns the part of a convex polygon beyond the line normal . p = distance.
std::vector<Vec2> Beyond(const std::vector<Vec2>& points, Vec2 normal, float distance) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
    const float at_a = normal.dot(a) - distance, at_b = normal.dot(b) - distance;
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

}  // namespace

std::map<PartId, FigurePart> FiguresOf(const Scene& scene) {
  std::map<PartId, FigurePart> figures;
  for (std::size_t c = 0; c < scene.characters.size(); ++c) {
    const Character& character = scene.characters[c];
    for (int p = 0; p < kCharacterParts; ++p) {
      FigurePart figure;
      figure.character = static_cast<int>(c);
      figure.part = p;
      figure.far_side = IsLimb(p) && IsLeft(p) == (character.facing > 0);
      figures[character.parts[static_cast<std::size_t>(p)]] = figure;
    }
  }
  return figures;
}

void ShapeFigure(const Scene& scene, const FigurePart& figure, const Pose& root, Outline* outline) {
  const Character& c = scene.characters[static_cast<std::size_t>(figure.character)];
  const PartId id = c.parts[static_cast<std::size_t>(figure.part)];
  const Part& part = scene.parts.at(static_cast<std::size_t>(id));
  const float scale = c.height / 1.8f;
  const std::vector<Vec2> smooth = Rounded(part.points);
  std::vector<Vec2> tone;
  if (figure.part == kHead) tone = Beyond(smooth, Vec2(-0.5f * c.facing, 0.87f), 0.035f * scale);
  if (figure.part == kTorso) tone = Beyond(smooth, Vec2(0, -1), 0.12f * scale);
  const Frame2 to_world(Pose{part.position, part.angle});
  const Rotation<float> back(root.angle);
  const auto into = [&](const Vec2& p) { return Vec2(back.Back(to_world(p) - root.position)); };
  outline->figure = figure;
  outline->points.clear();
  for (const Vec2& p : smooth) outline->points.push_back(into(p));
  for (const Vec2& p : tone) outline->figure.tone.push_back(into(p));
}

int FigureLayer(const FigurePart& figure) {
  if (!IsLimb(figure.part)) return figure.part == kTorso ? 4 : 5;
  const bool arm = figure.part <= kLowerArmRight;
  const int side = figure.far_side ? 0 : 6;
  const bool outer = figure.part == kLowerArmLeft || figure.part == kLowerArmRight;
  if (arm) return side + (figure.far_side ? 0 : 4) + (outer ? 1 : 0);
  const bool thigh = figure.part == kUpperLegLeft || figure.part == kUpperLegRight;
  return side + (figure.far_side ? 2 : 0) + (thigh ? 1 : 0);
}

}  // namespace seam
