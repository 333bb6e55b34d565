#include "server/rules/seats.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/saved/persist_state.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

/// A part this near to its place in a seat, m and rad, can be fastened without a visible jump.
constexpr float kFastenWithin = 0.05f, kFastenTurn = 0.2f;
/// A part that has not arrived this long after the normal time of the way is released, s.
constexpr int kArrivalMargin = 2;
/// Least speed at which peers that heard late show the part catching up, m/s.
constexpr float kCatchUpSpeed = 2;
/// Time until a body has settled in the view of a peer that has just joined, s.
constexpr double kViewSettles = 0.6;
/// Way::heard_at while a peer is joining.
constexpr int kComingIn = -2;
/// Longest wait for such peers after the end of the way, s.
constexpr double kPeerWaitMax = 1.5;
/// Most ticks in a seat that are told apart: a month.
constexpr int kSeatTicksMost = 1 << 28;

bool PlayerSits(const World& world, int player) {
  for (const Seat& seat : world.scene().seats) {
    if (seat.player == player) return true;
  }
  return false;
}

/// Returns the distance of a part from its place in a seat, m.
float DistanceTo(const World& world, const Seat& seat, PartId own) {
  const BodyState vehicle = PartPose(world, seat.part);
  const Vec2 place = vehicle.position + Turned(seat.at, vehicle.angle);
  return (PartPose(world, own).position - place).norm();
}

/// Returns false and adds no edit if the player cannot get in.
bool GetIn(const World& world, int player, int index, std::vector<Edit>* edits) {
  const Seat& seat = world.scene().seats[static_cast<std::size_t>(index)];
  if (world.scene().parts[static_cast<std::size_t>(seat.part)].gone) return false;
  const PartId own = world.scene().players[static_cast<std::size_t>(player)].vehicle;
  const Edit sit(SeatEdit{index, player}, EditCause::kOutside);
  if (own < 0) {
    edits->push_back(sit);
    return true;
  }
  if (world.scene().parts[static_cast<std::size_t>(own)].gone) return false;
  if (DistanceTo(world, seat, own) > seat.reach) return false;
  edits->push_back(sit);
  return true;
}

/// True if a player's part is where the seat will hold it.
bool IsThere(const World& world, const Seat& seat, PartId own) {
  const BodyState vehicle = PartPose(world, seat.part), now = PartPose(world, own);
  const Vec2 place = vehicle.position + Turned(seat.at, vehicle.angle);
  const float turn = WrapAngle(now.angle - vehicle.angle - seat.angle);
  return (now.position - place).norm() < kFastenWithin && std::fabs(turn) < kFastenTurn;
}

}  // namespace

std::vector<Edit> LeaveSeat(const World& world, int index) {
  std::vector<Edit> edits;
  const Seat& seat = world.scene().seats[static_cast<std::size_t>(index)];
  if (seat.player < 0) return edits;
  const PartId own = world.scene().players[static_cast<std::size_t>(seat.player)].vehicle;
  for (std::size_t j = 0; own >= 0 && j < world.scene().joints.size(); ++j) {
    const Joint& joint = world.scene().joints[j];
    if (joint.gone || joint.kind != JointKind::kGlue || joint.a != seat.part || joint.b != own) {
      continue;
    }
    edits.emplace_back(BreakEdit{static_cast<std::int32_t>(j)}, EditCause::kOutside);
  }
  edits.emplace_back(SeatEdit{index, -1}, EditCause::kOutside);
  return edits;
}

SeatRefusal RefusedSeat(const World& world, int player, int pressed, const std::set<int>& taken) {
  SeatRefusal nearest;
  const Scene& scene = world.scene();
  const PartId own = scene.players[static_cast<std::size_t>(player)].vehicle;
  const auto gone = [&scene](PartId part) {
    return scene.parts[static_cast<std::size_t>(part)].gone;
  };
  if (own >= 0 && gone(own)) return nearest;
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    if (seat.player == player) return {};
    if (((pressed >> seat.button) & 1) == 0 || gone(seat.part)) continue;
    if (taken.count(static_cast<int>(s)) > 0) continue;  // of this tick: it is told of that
    const float away = own >= 0 ? DistanceTo(world, seat, own) : 0.0f;
    if (nearest.seat >= 0 && away >= nearest.away) continue;
    nearest = {static_cast<int>(s), away <= seat.reach ? seat.player : -1, away};
  }
  return nearest;
}

std::vector<Edit> SeatEdits(const World& world, int player, int pressed, std::set<int>* taken) {
  std::vector<Edit> edits;
  if (pressed == 0) return edits;
  const Scene& scene = world.scene();
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    if (seat.player != player || ((pressed >> seat.button) & 1) == 0) continue;
    for (const Edit& edit : LeaveSeat(world, static_cast<int>(s))) edits.push_back(edit);
  }
  if (!edits.empty() || PlayerSits(world, player)) return edits;
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    if (seat.player >= 0 || ((pressed >> seat.button) & 1) == 0) continue;
    if (taken->count(static_cast<int>(s)) > 0) continue;
    if (!GetIn(world, player, static_cast<int>(s), &edits)) continue;
    taken->insert(static_cast<int>(s));
    break;
  }
  return edits;
}

std::vector<Edit> SeatBonds::Next(const World& world, int heard) {
  const Scene& scene = world.scene();
  std::vector<Edit> edits;
  ways_.resize(scene.seats.size());
  asked_.resize(scene.seats.size(), -1);
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    const PartId own =
        seat.player < 0 ? -1 : scene.players[static_cast<std::size_t>(seat.player)].vehicle;
    Way& way = ways_[s];
    if (way.own != own) way = {own, world.topology().revision(), 0, -1};
    if (own < 0) {
      asked_[s] = -1;
      continue;
    }
    way.ticks = std::min(way.ticks + 1, kSeatTicksMost);
    if (heard < 0) {
      way.heard_at = kComingIn;
    } else if (way.heard_at < 0 && heard >= way.revision) {
      const double settles = way.heard_at == kComingIn ? kViewSettles : 0;
      way.heard_at = way.ticks + static_cast<int>(settles * scene.solver.tick_hz);
    }
    if (way.ticks < SeatTicks(scene.solver.tick_hz) || asked_[s] == own) continue;
    const Edit bond(BondEdit{seat.part, own, seat.at, seat.angle}, EditCause::kOutside);
    if (!world.topology().Validate(bond).ok()) continue;
    const int over = way.ticks - SeatTicks(scene.solver.tick_hz);
    if (IsThere(world, seat, own)) {
      if (way.ticks < Due(world, s)) continue;
      edits.push_back(bond);
      asked_[s] = own;
    } else if (over > kArrivalMargin * scene.solver.tick_hz) {
      edits.emplace_back(SeatEdit{static_cast<std::int32_t>(s), -1}, EditCause::kOutside);
      asked_[s] = own;
    }
  }
  return edits;
}

/// Returns the first tick, counted from the taking of the seat, at which a bond is a jump for
/// nobody. A peer that hears late displays the way late, while the vehicle moves on; a bond before
/// the displayed part arrives would make it jump.
int SeatBonds::Due(const World& world, std::size_t seat) const {
  const int hz = world.scene().solver.tick_hz;
  const int last = SeatTicks(hz) + static_cast<int>(kPeerWaitMax * hz);
  const Way& way = ways_[seat];
  if (way.heard_at < 0) return last;
  const float late = static_cast<float>(std::max(0, way.heard_at - SeatWaitTicks(hz)));
  const float speed = PartPose(world, world.scene().seats[seat].part).velocity.norm();
  const float behind = std::min(speed * late / kCatchUpSpeed, 1e6f);
  return std::min(last, way.heard_at + static_cast<int>(behind));
}

void SeatBonds::Persist(StateArchive& a, const World& world) {
  a.Section("seats");
  const std::size_t seats = world.scene().seats.size(), parts = world.scene().parts.size();
  a.List(&ways_, seats, [&](Way* way) {
    PersistPart(a, &way->own, parts);
    a.Int(&way->revision, 0, INT32_MAX);
    a.Int(&way->ticks, 0, kSeatTicksMost);
    a.Int(&way->heard_at, kComingIn, kSeatTicksMost);
  });
  a.List(&asked_, seats, [&](PartId* part) { PersistPart(a, part, parts); });
}

}  // namespace seam
