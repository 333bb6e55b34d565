#pragma once
/// Input of the rules: states of the bodies, and impacts on them.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Impact on one body.
struct Blow {
  int body = -1;     ///< index of the struck body, >= 0
  int by = -1;       ///< index of the striking body; -1: an anchored part
  float dv = 0;      ///< m/s, change of velocity of the struck body
  Vec2 point{0, 0};  ///< m
};

class RuleSource {
 public:
  virtual ~RuleSource() = default;
  /// Returns the state of a body.
  virtual BodyState Read(int body) const = 0;
  /// Returns the ticks that became known for any body since the last tick of the rules, ascending.
  virtual std::vector<std::int64_t> Ticks() const = 0;
  /// Returns the state of a body at one of these ticks, or at the nearest known tick that the rules
  /// have not passed yet.
  virtual BodyState ReadAt(int body, std::int64_t tick) const = 0;
  /// Returns the tick of that state. It never decreases from one call to the next of a later tick.
  virtual std::int64_t TickOf(int body, std::int64_t tick) const = 0;
  /// Marks all known ticks as processed.
  virtual void MarkProcessed() = 0;
  /// True if the newest state told of the body was refused: until one is accepted it enters
  /// nothing.
  virtual bool Doubted(int /*body*/) const { return false; }
  /// Returns the impacts on bodies since the last call, each once.
  virtual std::vector<Blow> TakeImpacts() = 0;
  /// Returns the touches of parts that began since the last call, each once.
  virtual std::vector<PartTouch> TakeTouches() = 0;
};

/// Returns the impacts of the world's last tick: one Blow for each moving body of an impact.
std::vector<Blow> ImpactsOf(const World& world);

/// Source for a world that no other peer simulates.
class WorldSource : public RuleSource {
 public:
  /// `world` must outlive it.
  explicit WorldSource(const World& world) : world_(world) {}
  BodyState Read(int body) const override { return world_.Read(body); }
  std::vector<std::int64_t> Ticks() const override { return {world_.tick()}; }
  BodyState ReadAt(int body, std::int64_t) const override { return Read(body); }
  std::int64_t TickOf(int, std::int64_t tick) const override { return tick; }
  void MarkProcessed() override {}
  std::vector<Blow> TakeImpacts() override { return ImpactsOf(world_); }
  std::vector<PartTouch> TakeTouches() override { return world_.begun_touches(); }

 private:
  const World& world_;
};

}  // namespace seam
