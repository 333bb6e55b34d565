#pragma once
/// What the rules go by: where bodies are, and what struck them.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Something struck a body.
struct Blow {
  int body = -1;     ///< index of the body that was struck, >= 0
  int by = -1;       ///< of the body that struck it; -1: something anchored
  float dv = 0;      ///< m/s, change of velocity of the struck body
  Vec2 point{0, 0};  ///< m
};

class RuleSource {
 public:
  virtual ~RuleSource() = default;
  /// Where a body is.
  virtual BodyState Read(int body) const = 0;
  /// What struck bodies since the last call, each blow once.
  virtual std::vector<Blow> TakeBlows() = 0;
};

/// What a world felt in its last tick: a blow for each moving body of an impact.
std::vector<Blow> BlowsOf(const World& world);

/// A world that nobody else simulates.
class WorldSource : public RuleSource {
 public:
  /// `world` must outlive it.
  explicit WorldSource(const World& world) : world_(world) {}
  BodyState Read(int body) const override { return world_.Read(body); }
  std::vector<Blow> TakeBlows() override { return BlowsOf(world_); }

 private:
  const World& world_;
};

}  // namespace seam
