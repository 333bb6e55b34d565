#include "server/trust/drift.h"

#include <algorithm>
#include <cmath>

#include "common/sync/rollback/replay.h"
#include "common/sync/state_arithmetic.h"

namespace seam {
namespace {

/// Slower than this a body has no direction, m/s.
constexpr float kMoves = 0.5f;
/// Greatest difference of one message that counts, m and m/s.
constexpr float kStep = 0.02f, kKick = 0.2f;
/// Time constant of the share of late, s: longer than the noise of a message, so that a sum which
/// only fades is seen to fall.
constexpr float kOfLateS = 2;
/// A longer silence begins the sums anew, s: the copy has been corrected by others meanwhile.
constexpr float kSilence = 3;

/// Returns a vector of at most this length.
Vec2 AtMost(float most, const Vec2& v) {
  const float length = v.norm();
  return length > most ? Vec2(v * (most / length)) : v;
}

}  // namespace

Drift::Drift(const Replica& replica)
    : replica_(replica), tracks_(replica.table(), BodyRule::kSame) {}

/// Greater differences are doubts by themselves: they count as the greatest that is none.
void Drift::Add(int body, std::int64_t tick, const BodyState& copy, const BodyState& off) {
  Track& track = tracks_[body];
  const int holder = replica_.authority().at(replica_.world().mechanism(body)).authority;
  const float seconds = static_cast<float>(tick - track.tick) * replica_.world().dt();
  if (holder != track.holder || seconds > kSilence) track = Track{};
  track.holder = holder;
  track.tick = tick;
  const float keep = std::exp(-seconds / kDriftForgetS);
  const bool moves = copy.velocity.norm() > kMoves;
  const Vec2 along = moves ? Vec2(copy.velocity.normalized()) : Vec2(0, 0);
  const auto add = [&](const Vec2& by, Sums* sums) {
    const Eigen::Array3f more(by.dot(along), by.x(), by.y());
    sums->sum = keep * sums->sum + more;
    sums->chance2 = keep * keep * sums->chance2 + more.square();
  };
  const Vec2 way = off.position - track.left.position - seconds * track.left.velocity;
  add(AtMost(kStep, way), &track.moved);
  add(AtMost(kKick, off.velocity - track.left.velocity), &track.kicked);
  track.left = Replay::Agrees(off) ? off : BodyState{};
  const float share = Share(track);
  track.of_late += (1 - std::exp(-seconds / kOfLateS)) * (share - track.of_late);
  track.falls = share < track.of_late;
  greatest_ = std::max(greatest_, share);
}

float Drift::Share(const Sums& sums, float bound) {
  return (sums.sum.abs() / (kChances * sums.chance2.sqrt()).max(bound)).maxCoeff();
}

float Drift::Share(const Track& track) const {
  return std::max(Share(track.moved, kDriftWay), Share(track.kicked, kDriftVelocity));
}

bool Drift::Lies(int body) const {
  const Track& track = tracks_[body];
  return Share(track) > 1 && !track.falls;
}

}  // namespace seam
