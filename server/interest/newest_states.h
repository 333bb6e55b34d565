#pragma once
/// Latest state per body, and the receivers whose dead reckoning it invalidates. A client that only
/// displays a body extrapolates the state that it was sent last; a new one is due when this is off
/// by more than a threshold (as in IEEE 1278 and Aronson, "Dead Reckoning: Latency Hiding for
/// Networked Games", 1997).

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/wire_body.h"
#include "common/physics/world.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

/// Receivers that need a new state, besides the body's followers.
enum class News : std::uint8_t {
  kNobody,
  kNear,  ///< receivers near the body
  kAll,   ///< receivers far from it, too
};

/// Conditions under which a receiver needs a new state.
struct ReckoningRule {
  float off;     ///< m; error of the extrapolated last state, at a point of the body
  double least;  ///< s since that state: not sooner, unless epoch or sleep changed
};
constexpr ReckoningRule kNearReckoning{0.005f, 0};
constexpr ReckoningRule kFarReckoning{0.05f, 0.5};
/// s after which a state is sent in any case, so that one may be lost before the receiver stops
/// extrapolating (kReckonShownMax). The second one is for bodies slower than kRepeatSlow, m/s.
constexpr double kStateRepeatS = 0.5, kStateRepeatSlowS = 2;
/// Like kStateRepeatS, for states that the server sends in a silent holder's name: the holder's
/// last state is half a second old by then, and may be the one that was lost.
constexpr double kStateRepeatSilentS = 0.25;
constexpr float kRepeatSlow = 0.05f;

/// An edit leaves only the states of unchanged bodies.
class NewestStates {
 public:
  /// The world and the table of its bodies must outlive this object.
  NewestStates(const World& world, const BodyTable& table, int tick_hz)
      : world_(world),
        tick_hz_(tick_hz),
        bodies_(table, BodyRule::kSame),
        together_(table, MechanismRule::kFresh, News::kNobody) {}

  /// An entry of a message: its body, and the receivers that need it.
  struct Told {
    int body = -1, mechanism = -1;  ///< -1: the body is gone
    News news = News::kNobody;
    /// Due to receivers that come to the same state by themselves: kRefreshHz times a second, and
    /// whatever comes less often.
    bool refresh = false;
  };
  /// Takes a message; returns one element per entry. Entries of one mechanism get the same `news`,
  /// since its bodies are displayed together.
  /// `repeat_s`: s after which the state of a moving body is sent in any case.
  const std::vector<Told>& Take(const States& states, double repeat_s = kStateRepeatS);
  /// Returns the latest state of an assembly. Requires has(id).
  const WireBody& at(PartId id) const { return bodies_[world_.BodyOfId(id)].heard; }
  /// Returns the header of the message that it came in. Requires has(id).
  const StatesHeader& header(PartId id) const { return bodies_[world_.BodyOfId(id)].header; }
  bool has(PartId id) const {
    const int body = world_.BodyOfId(id);
    return body >= 0 && bodies_[body].heard.tick >= 0;
  }

 private:
  struct Body {
    StatesHeader header;        // of the latest
    WireBody heard, near, far;  // the latest; the last due to near, and to far receivers
    WireBody followed;          // the last refresh
    float reach = -1;           // m, from its origin to its farthest point; -1: not known yet
  };
  bool IsRefresh(const Body& body, std::int64_t before) const;
  bool IsNews(const Body& body, const WireBody& told, const ReckoningRule& rule,
              double repeat_s) const;

  const World& world_;
  const int tick_hz_;
  BodyColumn<Body> bodies_;
  std::vector<Told> told_;          // result of the last Take
  MechanismColumn<News> together_;  // in Take
};

}  // namespace seam
