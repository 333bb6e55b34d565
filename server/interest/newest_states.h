#pragma once
/// The newest state that was heard of each body, and whom it is news to: who only shows a body goes
/// on from what it was told last, and has to hear of it again when that has gone wrong (dead
/// reckoning with a threshold, as in IEEE 1278 and Aronson, "Dead Reckoning: Latency Hiding for
/// Networked Games", 1997).

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/topology/body_remap.h"

namespace seam {

/// A body's entry of a States, with what the message says of all of them; quanta of states_t.
struct HeardState {
  std::int32_t peer = 0;   ///< the authority
  std::int64_t tick = -1;  ///< -1: nothing was heard
  std::int32_t revision = 0;
  std::int64_t composition = 0;
  std::int32_t epoch = 0;
  std::int8_t flags = 0;
  std::int32_t x = 0, y = 0;  ///< 1/512 m, of the room's origin
  std::int16_t angle = 0, vx = 0, vy = 0, spin = 0;
};

/// Whom a state is news to, besides who follows the body.
enum class News : std::uint8_t {
  kNobody,
  kNear,  ///< who is near it
  kAll,   ///< who is far from it, too
};

/// When a receiver is told.
struct NewsRule {
  float off;     ///< m, of a point of the body from where the last told state takes it
  double least;  ///< s since then: not before
};
constexpr NewsRule kNearNews{0.005f, 0};
constexpr NewsRule kFarNews{0.05f, 0.5};
/// s after which it is told in any case, so that one may be lost before the receiver's reckoning
/// ends (kReckonShownMax); and what is slower than kSlow, m/s, which hardly gets anywhere.
constexpr double kNewsRepeat = 0.5, kNewsRepeatSlow = 2;
/// The same of what the server says in a silent holder's name: the holder's last word is half a
/// second old by then, and may be the one that was lost.
constexpr double kNewsRepeatSilent = 0.25;
constexpr float kSlow = 0.05f;

class NewestStates {
 public:
  /// `world` must outlive it.
  NewestStates(const World& world, int tick_hz) : world_(world), tick_hz_(tick_hz) {}

  /// An entry of a message: which body it is of, and whom it is news to.
  struct Told {
    int body = -1, mechanism = -1;  ///< -1: it has left meanwhile
    News news = News::kNobody;
  };
  /// Takes a message; by its entries, what it told. All of a mechanism that are in it are news
  /// together, as they are shown as one.
  /// `repeat_s`: of what moves, s after which it is told in any case.
  const std::vector<Told>& Take(const States& states, double repeat_s = kNewsRepeat);
  /// Of an assembly. Requires that it has been heard of.
  const HeardState& at(PartId id) const { return bodies_[static_cast<std::size_t>(id)].heard; }
  bool has(PartId id) const {
    const auto i = static_cast<std::size_t>(id);
    return i < bodies_.size() && bodies_[i].heard.tick >= 0;
  }
  /// The bodies have changed, and come from these. Nothing was heard yet of those that are others.
  void Remap(const std::vector<BodyOrigin>& bodies);

 private:
  struct Body {
    HeardState heard, near, far;  // the newest, and what the others were told
    float reach = -1;             // m, of its farthest point from its origin; -1: not known yet
  };
  bool IsNews(const Body& body, const HeardState& told, const NewsRule& rule,
              double repeat_s) const;

  const World& world_;
  const int tick_hz_;
  std::vector<Body> bodies_;    // by part
  std::vector<Told> told_;      // of the last message
  std::vector<News> together_;  // by mechanism, in Take
};

}  // namespace seam
