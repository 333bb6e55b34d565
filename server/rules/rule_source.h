#pragma once
/// What the rules go by: where bodies are, and what struck them.

#include <cstdint>
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
  /// Ticks that became known of any body since the last tick of the rules, ascending, up to now.
  virtual std::vector<std::int64_t> Ticks() const = 0;
  /// Where a body was at one of them, or as near to it as is known and not looked at yet.
  virtual BodyState ReadAt(int body, std::int64_t tick) const = 0;
  /// The tick at which it was there: never falls from one call to the next of a later tick.
  virtual std::int64_t TickOf(int body, std::int64_t tick) const = 0;
  /// The rules have looked at all of them.
  virtual void NoteLooked() = 0;
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
  std::vector<std::int64_t> Ticks() const override { return {world_.tick()}; }
  BodyState ReadAt(int body, std::int64_t) const override { return Read(body); }
  std::int64_t TickOf(int, std::int64_t tick) const override { return tick; }
  void NoteLooked() override {}
  std::vector<Blow> TakeBlows() override { return BlowsOf(world_); }

 private:
  const World& world_;
};

}  // namespace seam
