/// The camera shows the action: measured on sessions of the scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "render/frame.h"
#include "tests/lab/session.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_camera_test {

std::vector<Playback> PlaybacksOf(const std::string& scene, const std::string& reconcile) {
  SessionSettings settings;
  settings.scene = "scenes/" + scene + ".toml";
  settings.impair = "4g";
  settings.reconcile = reconcile;
  Recording recording;
  RunSession(Configure(settings), &recording);
  Oracle oracle = ComputeOracle(recording);
  std::vector<Playback> playbacks;
  playbacks.emplace_back(std::move(recording), std::move(oracle));
  return playbacks;
}

/// px^2 of a box on a panel.
struct Seen {
  Vec2 min{0, 0}, max{0, 0};
};
Seen OnPanel(const Viewport& viewport, const WorldBox& box) {
  const Vec2 a = viewport.ToPx({box.min.x(), box.max.y()});
  const Vec2 b = viewport.ToPx({box.max.x(), box.min.y()});
  return {a, b};
}

/// Share of the panel filled by moving bodies, each by its own outlines.
double FilledShare(const Playback& playback, int peer, const Viewport& viewport,
                   const std::set<PartId>& moving, double s) {
  const Moment moment = playback.MomentAt(peer, playback.TickAt(s));
  double m2 = 0;
  for (const BodyShapes& body : playback.RevisionOf(moment)->moving) {
    const auto shown = playback.Find(moment, body.id);
    if (moving.count(body.id) == 0 || !shown || !viewport.Sees(shown->pose.position, 0)) continue;
    for (const Outline& outline : body.outlines) {
      if (outline.kind == ShapeKind::kCircle) {
        m2 += kPi * outline.radius * outline.radius;
        continue;
      }
      double twice = 0;
      for (std::size_t i = 0; i < outline.points.size(); ++i) {
        const Vec2 &p = outline.points[i], &q = outline.points[(i + 1) % outline.points.size()];
        twice += p.x() * q.y() - q.x() * p.y();
      }
      m2 += std::abs(twice) / 2;
    }
  }
  return m2 * viewport.px_per_m * viewport.px_per_m /
         (viewport.panel.width * viewport.panel.height);
}

class CameraOnScene : public ::testing::TestWithParam<const char*> {};

TEST_P(CameraOnScene, ShowsTheWholeContactAndMovingBodiesLarge) {
  const std::vector<Playback> playbacks = PlaybacksOf(GetParam(), "rollback");
  const auto contact = ContactMoment(playbacks);
  ASSERT_TRUE(contact.has_value());
  Page page = MakePage(playbacks.front(), 1);
  SetCamera({}, playbacks, &page);
  ASSERT_TRUE(page.inset.has_value());
  const std::vector<CameraView> views = {{&playbacks.front(), 1}};
  const std::set<PartId> moving = MovingBodies(views, page.from_s, page.to_s);
  ASSERT_FALSE(moving.empty());
  const Rect area{18, 58, 1244, 490};
  for (double s = std::max(page.from_s, contact->s - 0.5); s <= std::min(page.to_s, contact->s + 1);
       s += 1.0 / 30) {
    const Viewport viewport = ViewportOf(page, page.panels[0], area, s);
    const Seen hit = OnPanel(viewport, BoxOf(views, contact->bodies, s));
    EXPECT_GE(hit.min.x(), area.x) << s;
    EXPECT_GE(hit.min.y(), area.y) << s;
    EXPECT_LE(hit.max.x(), area.right()) << s;
    EXPECT_LE(hit.max.y(), area.bottom()) << s;
    const double filled = FilledShare(playbacks.front(), 1, viewport, moving, s);
    const Seen all = OnPanel(viewport, BoxOf(views, moving, s));
    const double span = std::max((all.max.x() - all.min.x()) / area.width,
                                 (all.max.y() - all.min.y()) / area.height);
    EXPECT_TRUE((filled >= 0.15 && moving.size() <= 40) || span >= 0.8)
        << s << " s: filled " << filled << ", span " << span;
  }
}

TEST_P(CameraOnScene, HasNoJitterOfItsOwn) {
  const std::vector<Playback> playbacks = PlaybacksOf(GetParam(), "snap");
  Page page = MakePage(playbacks.front(), 1);
  SetCamera({}, playbacks, &page);
  // Speed of the picture's middle, in picture widths a second, and how fast that changes.
  Vec2 before(0, 0), speed_before(0, 0);
  for (int i = 0; i * 1.0 / 60 <= page.to_s; ++i) {
    const WorldBox box = page.camera->At(i / 60.0);
    const Vec2 now = box.centre() / box.size().x();
    const Vec2 speed = 60 * (now - before);
    if (i > 1) {
      EXPECT_LT((speed - speed_before).norm(), 1.0f) << i / 60.0;
    }
    before = now;
    speed_before = speed;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CameraOnScene,
                         ::testing::Values("crossing", "wall", "headon", "rally", "gluehouse",
                                           "harbour"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(CameraWishes, AFixedPlaceAFollowedPartAndAZoomAreObeyed) {
  std::vector<Playback> playbacks;
  playbacks.push_back(MakePlayback(0));
  Page page = MakePage(playbacks.front(), 1);
  CameraWish fixed;
  fixed.kind = CameraWish::Kind::kFixed;
  fixed.centre = {3, 4};
  fixed.height = 5;
  SetCamera(fixed, playbacks, &page);
  EXPECT_NEAR(page.camera->At(1).size().y(), 5, 1e-3f);
  EXPECT_NEAR((page.camera->At(1).centre() - Vec2(3, 4)).norm(), 0, 1e-3f);
  fixed.zoom = 2;
  SetCamera(fixed, playbacks, &page);
  EXPECT_NEAR(page.camera->At(1).size().y(), 2.5f, 1e-3f);
  CameraWish follow;
  follow.kind = CameraWish::Kind::kFollow;
  follow.part = "cart_a";
  SetCamera(follow, playbacks, &page);
  const Vec2 cart = synthetic::Truth(1, 30).position;
  EXPECT_NEAR((page.camera->At(0.5).centre() - cart).norm(), 0, 0.1f);
  follow.part = "ann";  // whose vehicle it is
  SetCamera(follow, playbacks, &page);
  EXPECT_NEAR((page.camera->At(0.5).centre() - cart).norm(), 0, 0.1f);
  follow.part = "nobody";
  EXPECT_THROW(SetCamera(follow, playbacks, &page), OperatorError);
}

TEST(CameraWishes, ABodyIsShownWithAllThatIsJointedToIt) {
  const std::vector<Playback> playbacks = PlaybacksOf("crossing", "fade");
  const Composition& made =
      playbacks.front().WorldOf(playbacks.front().MomentAt(1, 60))->composition();
  for (const Mechanism& mechanism : made.mechanisms) {
    std::set<PartId> whole;
    for (const int i : mechanism.assemblies)
      whole.insert(made.assemblies[static_cast<std::size_t>(i)].id);
    for (const PartId body : whole) {
      Page page = MakePage(playbacks.front(), 1);
      CameraWish wish;
      wish.bodies = {body};
      SetCamera(wish, playbacks, &page);
      for (double s = 1; s < 4; s += 0.5) {
        const WorldBox all = BoxOf({{&playbacks.front(), 1}}, whole, s), shown = page.camera->At(s);
        EXPECT_TRUE((shown.min.array() <= all.min.array()).all()) << body << " at " << s;
        EXPECT_TRUE((shown.max.array() >= all.max.array()).all()) << body << " at " << s;
      }
    }
  }
}

TEST(CameraWishes, AHandOverAndTheWorstMomentAreFound) {
  const std::vector<Playback> playbacks = PlaybacksOf("relay", "snap");
  const auto change = HandOverMoment(playbacks);
  ASSERT_TRUE(change.has_value());
  ASSERT_EQ(change->bodies.size(), 1u);
  const auto worst = WorstMoment(playbacks);
  ASSERT_TRUE(worst.has_value());
  const auto& errors = playbacks.front().ErrorByTick(-1);
  double most = 0;
  for (const double error : errors) most = std::max(most, std::isnan(error) ? 0 : error);
  EXPECT_DOUBLE_EQ(*playbacks.front().ErrorAt(-1, worst->s * 60), most);
}

TEST(Sheet, HasAPanelForEachMomentEachAtItsOwn) {
  std::vector<Playback> playbacks;
  playbacks.push_back(MakePlayback(6));
  Page page = MakePage(playbacks.front(), 1);
  DrawList list(TestFont());
  DrawSheet(list, page, 6);
  const Image six = Rendered(list);
  page.to_s /= 2;
  DrawSheet(list, page, 6);
  const Image half = Rendered(list);
  EXPECT_GT(Differences(six, half, 0, 60, 1280, 720), 1000);
}

}  // namespace render_camera_test
}  // namespace seam
