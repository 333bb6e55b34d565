/// How characters look: inside the colliding shapes, near and far limbs distinct.

#include <gtest/gtest.h>

#include "common/base/geometry.h"
#include "common/scene/assembly.h"
#include "common/scene/character.h"
#include "render/canvas/figure.h"
#include "tests/support/character_world.h"

namespace seam {
namespace render_figure_test {

std::vector<BodyShapes> Bodies(const Scene& scene) {
  return ShapesOf(scene, Compose(scene), false);
}

/// m by which a point is outside of a part's counter-clockwise outline; negative inside.
float Outside(const Part& part, const Vec2& p) {
  float beyond = -1000;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const Vec2& a = part.points[i];
    const Vec2 edge = (part.points[(i + 1) % part.points.size()] - a).normalized();
    beyond = std::max(beyond, -Cross(edge, Vec2(p - a)));
  }
  return beyond;
}

TEST(Figure, IsDrawnWithinTheShapesThatCollideAndNearlyFillsThem) {
  const Scene scene = CharacterScene("position = [0, 0]\nfacing = \"left\"\n");
  const std::vector<BodyShapes> bodies = Bodies(scene);
  ASSERT_EQ(bodies.size(), static_cast<std::size_t>(kCharacterParts));
  for (const BodyShapes& body : bodies) {
    const Part& part = scene.parts[static_cast<std::size_t>(body.id)];
    const Outline& outline = body.outlines[0];
    EXPECT_GT(outline.points.size(), 24u) << "round";
    float furthest = 0;
    for (const Vec2& p : outline.points) {
      EXPECT_LT(Outside(part, p), 1e-5f) << part.name;
      furthest = std::max(furthest, p.norm());
    }
    for (const Vec2& p : outline.figure.tone) EXPECT_LT(Outside(part, p), 1e-5f) << part.name;
    EXPECT_GT(furthest, 0.9f * part.points[0].norm()) << part.name;
  }
}

TEST(Figure, ItsLeftLimbsAreFarWhenItFacesRightAndItsRightOnesWhenItFacesLeft) {
  for (const char* facing : {"right", "left"}) {
    const Scene scene =
        CharacterScene(std::string("position = [0, 0]\nfacing = \"") + facing + "\"\n");
    int far_limbs = 0;
    for (const BodyShapes& body : Bodies(scene)) {
      const std::string& name = scene.parts[static_cast<std::size_t>(body.id)].name;
      const FigurePart& figure = body.outlines[0].figure;
      ASSERT_EQ(figure.character, 0);
      if (!figure.far_side) continue;
      ++far_limbs;
      EXPECT_EQ(name.substr(name.size() - 2), facing[0] == 'r' ? "-l" : "-r");
    }
    EXPECT_EQ(far_limbs, 5);
  }
}

TEST(Figure, FarLimbsArePaintedBeforeTheTorsoAndNearOnesAfterIt) {
  const Scene scene = CharacterScene("position = [0, 0]\n");
  for (const BodyShapes& body : Bodies(scene)) {
    const FigurePart& figure = body.outlines[0].figure;
    FigurePart torso = figure;
    torso.part = kTorso;
    torso.far_side = false;
    if (!IsLimb(figure.part)) continue;
    if (figure.far_side) {
      EXPECT_LT(FigureLayer(figure), FigureLayer(torso));
    } else {
      EXPECT_GT(FigureLayer(figure), FigureLayer(torso));
    }
  }
}

}  // namespace render_figure_test
}  // namespace seam
