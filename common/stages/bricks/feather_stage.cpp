#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/scene/bricks.h"
#include "common/scene/scene_limits.h"
#include "common/stages/bricks/feather_chunk.h"
#include "common/stages/make_stages.h"
#include "common/topology/feather_blast.h"

namespace seam {
namespace {

/// Time ahead for which a body's path gets fixtures, s, and the cells per tick for that. Cells that
/// the body could touch within the tick do not count: they get fixtures at once.
constexpr float kPathAhead = 0.2f;
constexpr int kCellsPerTick = 2;
/// m; a body's cells beyond this distance are dropped.
constexpr float kKeep = 4;
/// The engine's largest motion in a step, m, and the margin of its boxes around shapes, m.
constexpr float kStepMax = 2, kFat = 0.2f;

/// Cells from..to inclusive; none: from > to.
struct CellRange {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;

  bool empty() const { return x0 > x1 || y0 > y1; }
  bool Contains(int x, int y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
  bool Contains(const CellRange& o) const {
    return o.empty() || (Contains(o.x0, o.y0) && Contains(o.x1, o.y1));
  }
  CellRange Within(const CellRange& o) const {
    return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
  }
  CellRange With(const CellRange& o) const {
    if (empty()) return o;
    if (o.empty()) return *this;
    return {std::min(x0, o.x0), std::min(y0, o.y0), std::max(x1, o.x1), std::max(y1, o.y1)};
  }
};

/// Returns the largest distance of a body's shapes from its origin, m.
float ReachOf(b2Body* body) {
  float reach = 0;
  b2Transform still;
  still.SetIdentity();
  for (b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext()) {
    for (int32 child = 0; child < f->GetShape()->GetChildCount(); ++child) {
      b2AABB box;
      f->GetShape()->ComputeAABB(&box, still, child);
      const b2Vec2 far = b2Max(b2Abs(box.lowerBound), b2Abs(box.upperBound));
      reach = std::max(reach, far.Length());
    }
  }
  return reach;
}

class FeatherStage : public Stage {
 public:
  /// Must be cheap: stages are also made only to be counted.
  explicit FeatherStage(const StageWorld& world) : world_(world) {
    const Solver& solver = world.scene.solver;
    tick_s_ = 1.0f / static_cast<float>(solver.tick_hz);
    most_ = kStepMax * static_cast<float>(solver.substeps);
  }

  void Rebuilt(b2World* world) override {
    b2_ = world;
    if (store_.cell_count() == 0) {
      store_ = FeatherStore(world_.scene.bricks);
      loaded_.resize(static_cast<std::size_t>(store_.cell_count()));
    }
    TakeOut();
    followed_.assign(world_.built.moving.size(), {});
    for (std::size_t i = 0; i < followed_.size(); ++i) {
      followed_[i].reach = ReachOf(world_.built.moving[i].body);
    }
  }
  void Emptied() override {
    b2_ = nullptr;
    for (Loaded& l : loaded_) {  // the chunks stay valid
      l.body = nullptr;
      l.wanted = 0;
    }
  }
  void Placed() override { Stream(0); }
  void BeforeTick() override { Stream(kCellsPerTick); }

 private:
  struct Loaded {
    b2Body* body = nullptr;
    int wanted = 0;                // number of bodies that want it
    std::unique_ptr<Chunk> chunk;  // kept while the world is rebuilt
  };
  struct Followed {
    float reach = 0;  // m
    CellRange cells;  // cells that it wants
  };

  /// Brings the store up to date with the scene's freed bricks. Requires that no cell has fixtures.
  void TakeOut() {
    const std::vector<Brick> gone = FreedBricks(world_.scene.bricks, world_.scene.parts);
    const std::size_t known = std::min(taken_.size(), gone.size());
    const auto same = static_cast<std::size_t>(
        std::mismatch(taken_.begin(), taken_.begin() + static_cast<std::ptrdiff_t>(known),
                      gone.begin())
            .first -
        taken_.begin());
    const auto at = static_cast<std::ptrdiff_t>(same);
    const std::vector<Brick> back(taken_.begin() + at, taken_.end());
    const std::vector<Brick> out(gone.begin() + at, gone.end());
    store_.Restore(back);
    SEAM_ASSERT(store_.Remove(out) == out.size());
    for (const auto* changed : {&back, &out}) {
      for (const Brick& b : *changed) ForgetAround(b);
    }
    taken_ = gone;
  }
  /// Drops the outlines of the cells with this brick on their boundary.
  void ForgetAround(const Brick& b) {
    const BrickKind& kind = store_.kinds()[static_cast<std::size_t>(b.kind)];
    for (int y = FeatherStore::CellOf(b.y - 1); y <= FeatherStore::CellOf(b.y + kind.height); ++y) {
      for (int x = FeatherStore::CellOf(b.x - 1); x <= FeatherStore::CellOf(b.x + kind.width);
           ++x) {
        const int cell = store_.CellAt(x, y);
        if (cell >= 0) loaded_[static_cast<std::size_t>(cell)].chunk.reset();
      }
    }
  }

  /// Returns the cells within `margin` m of the body's path over `ahead` s.
  CellRange CellsNear(const b2Body& body, float reach, float margin, float ahead) const {
    const b2Vec2 from = body.GetPosition();
    const b2Vec2 to = from + ahead * body.GetLinearVelocity();
    const float out = reach + margin;
    const CellRange near{Cell(std::min(from.x, to.x) - out), Cell(std::min(from.y, to.y) - out),
                         Cell(std::max(from.x, to.x) + out), Cell(std::max(from.y, to.y) + out)};
    return near.Within(
        {store_.cell_x_min(), store_.cell_y_min(), store_.cell_x_max(), store_.cell_y_max()});
  }
  static int Cell(float metres) {
    constexpr float kSide = FeatherStore::kCell * kBrickUnit, kCellsFar = 1e6f;
    return static_cast<int>(std::floor(std::clamp(metres, -kCellsFar, kCellsFar) / kSide));
  }

  void Stream(int budget) {
    if (store_.cell_count() == 0) return;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
      Followed& f = followed_[i];
      const b2Body& body = *world_.built.moving[i].body;
      if (body.GetType() != b2_dynamicBody ||
          IsAside(body)) {  // kinematic: touches nothing anchored
        if (!f.cells.empty()) Want({}, &f);
        continue;
      }
      const float speed = std::max(kSpeedMax, body.GetLinearVelocity().Length());
      const float margin = kFat + std::min(most_, speed * tick_s_);
      const CellRange must = CellsNear(body, f.reach, margin, 0);
      const CellRange ahead = CellsNear(body, f.reach, margin, kPathAhead);
      const CellRange keep = CellsNear(body, f.reach, margin + kKeep, kPathAhead);
      CellRange want = f.cells.Within(keep).With(must);
      if (!want.Contains(ahead) && budget > 0) want = want.With(ahead);
      if (!want.Contains(f.cells) || !f.cells.Contains(want)) budget -= Want(want, &f);
    }
  }

  /// Sets the cells that a body wants; returns how many got their fixtures.
  int Want(const CellRange& cells, Followed* f) {
    int made = 0;
    for (int y = cells.y0; y <= cells.y1; ++y) {
      for (int x = cells.x0; x <= cells.x1; ++x) {
        if (!f->cells.Contains(x, y)) made += Add(store_.CellAt(x, y));
      }
    }
    for (int y = f->cells.y0; y <= f->cells.y1; ++y) {
      for (int x = f->cells.x0; x <= f->cells.x1; ++x) {
        if (!cells.Contains(x, y)) Drop(store_.CellAt(x, y));
      }
    }
    f->cells = cells;
    return made;
  }

  int Add(int cell) {
    if (cell < 0) return 0;
    Loaded& l = loaded_[static_cast<std::size_t>(cell)];
    if (l.wanted++ > 0) return 0;
    if (l.chunk == nullptr) {
      l.chunk = std::make_unique<Chunk>(
          ChunkOf(store_, store_.cell_x(cell), store_.cell_y(cell), world_.scene.solver.skin));
    }
    l.body = AddChunk(*l.chunk, IdOf(cell), b2_);
    return 1;
  }
  void Drop(int cell) {
    if (cell < 0) return;
    Loaded& l = loaded_[static_cast<std::size_t>(cell)];
    if (--l.wanted > 0) return;
    if (l.body != nullptr) b2_->DestroyBody(l.body);
    l.body = nullptr;
    l.chunk.reset();
  }
  /// Returns the id of a cell's first fixture; a cell has fewer than 1024 reachable outlines.
  static std::uintptr_t IdOf(int cell) {
    return kStageFixture + (static_cast<std::uintptr_t>(cell) << 10);
  }

  const StageWorld world_;
  FeatherStore store_{FeatureList<BrickField>()};
  std::vector<Brick> taken_;  // removed from the store
  b2World* b2_ = nullptr;
  std::vector<Loaded> loaded_;      // by cell
  std::vector<Followed> followed_;  // by moving body
  float tick_s_ = 0, most_ = 0;
};

}  // namespace

std::unique_ptr<Stage> MakeFeatherStage(const StageWorld& world) {
  return std::make_unique<FeatherStage>(world);
}

}  // namespace seam
