#include "server/rules/seats.h"

#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

/// Whoever is so near to a place in a seat, m and rad, can be fastened there without a jump.
constexpr float kFastenWithin = 0.05f, kFastenTurn = 0.2f;
/// And who has not come there so long after the time that the way takes is let go, s.
constexpr int kComeWithin = 2;

bool PlayerSits(const World& world, int player) {
  for (const Seat& seat : world.scene().seats) {
    if (seat.player == player) return true;
  }
  return false;
}

/// False, and nothing: it cannot be.
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
  const BodyState vehicle = PartPose(world, seat.part);
  const Vec2 place = vehicle.position + Turned(seat.at, vehicle.angle);
  if ((PartPose(world, own).position - place).norm() > seat.reach) return false;
  edits->push_back(sit);
  return true;
}

void GetOut(const World& world, int index, std::vector<Edit>* edits) {
  const Seat& seat = world.scene().seats[static_cast<std::size_t>(index)];
  const PartId own = world.scene().players[static_cast<std::size_t>(seat.player)].vehicle;
  for (std::size_t j = 0; own >= 0 && j < world.scene().joints.size(); ++j) {
    const Joint& joint = world.scene().joints[j];
    if (joint.gone || joint.kind != JointKind::kGlue || joint.a != seat.part || joint.b != own) {
      continue;
    }
    edits->emplace_back(BreakEdit{static_cast<std::int32_t>(j)}, EditCause::kOutside);
  }
  edits->emplace_back(SeatEdit{index, -1}, EditCause::kOutside);
}

/// Whether a player's part is where the seat will have it.
bool IsThere(const World& world, const Seat& seat, PartId own) {
  const BodyState vehicle = PartPose(world, seat.part), now = PartPose(world, own);
  const Vec2 place = vehicle.position + Turned(seat.at, vehicle.angle);
  const float turn = WrapAngle(now.angle - vehicle.angle - seat.angle);
  return (now.position - place).norm() < kFastenWithin && std::fabs(turn) < kFastenTurn;
}

}  // namespace

std::vector<Edit> SeatEdits(const World& world, int player, int pressed) {
  std::vector<Edit> edits;
  if (pressed == 0) return edits;
  const Scene& scene = world.scene();
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    if (seat.player != player || ((pressed >> seat.button) & 1) == 0) continue;
    GetOut(world, static_cast<int>(s), &edits);
  }
  if (!edits.empty() || PlayerSits(world, player)) return edits;
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    if (seat.player >= 0 || ((pressed >> seat.button) & 1) == 0) continue;
    if (GetIn(world, player, static_cast<int>(s), &edits)) break;
  }
  return edits;
}

std::vector<Edit> SeatBonds::Next(const World& world) {
  const Scene& scene = world.scene();
  std::vector<Edit> edits;
  waited_.resize(scene.seats.size(), 0);
  asked_.resize(scene.seats.size(), -1);
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    const Seat& seat = scene.seats[s];
    const PartId own =
        seat.player < 0 ? -1 : scene.players[static_cast<std::size_t>(seat.player)].vehicle;
    waited_[s] = own < 0 ? 0 : waited_[s] + 1;
    if (own < 0) asked_[s] = -1;
    const int over = waited_[s] - SeatTicks(scene.solver.tick_hz);
    if (over < 0 || asked_[s] == own) continue;
    const Edit bond(BondEdit{seat.part, own, seat.at, seat.angle}, EditCause::kOutside);
    if (!world.topology().Validate(bond).ok()) continue;
    if (IsThere(world, seat, own)) {
      edits.push_back(bond);
      asked_[s] = own;
    } else if (over > kComeWithin * scene.solver.tick_hz) {
      edits.emplace_back(SeatEdit{static_cast<std::int32_t>(s), -1}, EditCause::kOutside);
      asked_[s] = own;
    }
  }
  return edits;
}

}  // namespace seam
