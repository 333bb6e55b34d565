#include "common/physics/hanging_rope.h"

#include <box2d/b2_draw.h>
#include <box2d/b2_rope.h>

#include <cmath>

#include "common/physics/world_build.h"

namespace seam {
namespace {

constexpr int kSweeps = 8;  // over all links, a step

/// The engine gives out a rope's points only by drawing.
class PointCollector : public b2Draw {
 public:
  std::vector<Vec2> points;

  void DrawSegment(const b2Vec2& a, const b2Vec2& b, const b2Color&) override {
    if (points.empty()) points.emplace_back(a.x, a.y);
    points.emplace_back(b.x, b.y);
  }
  void DrawPoint(const b2Vec2&, float, const b2Color&) override {}
  void DrawPolygon(const b2Vec2*, int32, const b2Color&) override {}
  void DrawSolidPolygon(const b2Vec2*, int32, const b2Color&) override {}
  void DrawCircle(const b2Vec2&, float, const b2Color&) override {}
  void DrawSolidCircle(const b2Vec2&, float, const b2Vec2&, const b2Color&) override {}
  void DrawTransform(const b2Transform&) override {}
};

b2RopeTuning TuningOf(const Strand& strand) {
  b2RopeTuning tuning;  // the engine leaves some of these uninitialised
  tuning.stretchHertz = 0;
  tuning.stretchDamping = 0;
  tuning.damping = strand.damping;
  tuning.stretchStiffness = 1;
  tuning.bendStiffness = strand.stiffness;
  tuning.bendingModel = b2_pbdAngleBendingModel;
  return tuning;
}

}  // namespace

struct HangingRope::Impl {
  b2Rope rope;
  Vec2 at{0, 0};
  float length = 0;
};

HangingRope::HangingRope(const Strand& strand, const Vec2& gravity, const Vec2& at)
    : impl_(std::make_unique<Impl>()) {
  impl_->at = at;
  impl_->length = strand.length;
  const Vec2 down = gravity.norm() > 0 ? Vec2(gravity.normalized()) : Vec2(0, -1);
  const int count = strand.links + 1;
  std::vector<b2Vec2> vertices;
  std::vector<float> masses(static_cast<std::size_t>(count), 1);
  masses[0] = 0;  // held
  for (int i = 0; i < count; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(strand.links);
    vertices.push_back(ToB2(down * (share * strand.length)));
  }
  b2RopeDef def;
  def.position = ToB2(at);
  def.vertices = vertices.data();
  def.count = count;
  def.masses = masses.data();
  def.gravity = ToB2(gravity);
  def.tuning = TuningOf(strand);
  impl_->rope.Create(def);
}

HangingRope::~HangingRope() = default;
HangingRope::HangingRope(HangingRope&&) noexcept = default;

void HangingRope::Step(float h, const Vec2& at) {
  const bool placed = (at - impl_->at).norm() > impl_->length;
  impl_->at = at;
  if (placed) {
    impl_->rope.Reset(ToB2(at));
  } else {
    impl_->rope.Step(h, kSweeps, ToB2(at));
  }
}

std::vector<Vec2> HangingRope::Points() const {
  PointCollector collector;
  impl_->rope.Draw(&collector);
  return std::move(collector.points);
}

}  // namespace seam
