/// Server, seats: who presses a seat's button beside it gets in, who presses it in there gets out.
/// Decided here alone, from the server's own world.

#include <cmath>

#include "common/physics/part_places.h"
#include "server/server.h"

namespace seam {
namespace {

/// Who gets out is pushed upwards by this much, m/s, so as not to fall back in.
constexpr float kHop = 2;

}  // namespace

void Server::UpdateSeats() {
  const Scene& scene = replica_.world().scene();
  if (scene.seats.empty()) return;
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    const int player = static_cast<int>(p);
    const int pressed = replica_.TakePressed(player);
    if (pressed == 0) continue;
    bool left = false;
    for (std::size_t s = 0; s < scene.seats.size(); ++s) {
      const Seat& seat = scene.seats[s];
      if (seat.player != player || ((pressed >> seat.button) & 1) == 0) continue;
      GetOut(static_cast<int>(s));
      left = true;
    }
    if (left || PlayerSits(player)) continue;
    for (std::size_t s = 0; s < scene.seats.size(); ++s) {
      const Seat& seat = scene.seats[s];
      if (seat.player >= 0 || ((pressed >> seat.button) & 1) == 0) continue;
      if (GetIn(player, static_cast<int>(s))) break;
    }
  }
}

bool Server::PlayerSits(int player) const {
  for (const Seat& seat : replica_.world().scene().seats) {
    if (seat.player == player) return true;
  }
  return false;
}

bool Server::GetIn(int player, int index) {
  const World& world = replica_.world();
  const Seat& seat = world.scene().seats[static_cast<std::size_t>(index)];
  if (world.scene().parts[static_cast<std::size_t>(seat.part)].gone) return false;
  const PartId own = world.scene().players[static_cast<std::size_t>(player)].vehicle;
  const Edit sit(SeatEdit{index, player}, EditCause::kOutside);
  if (own < 0) {
    Order(sit);
    return true;
  }
  if (world.scene().parts[static_cast<std::size_t>(own)].gone) return false;
  const BodyState vehicle = PartPose(world, seat.part);
  const float c = std::cos(vehicle.angle), s = std::sin(vehicle.angle);
  const Vec2 place =
      vehicle.position + Vec2(c * seat.at.x() - s * seat.at.y(), s * seat.at.x() + c * seat.at.y());
  if ((PartPose(world, own).position - place).norm() > seat.reach) return false;
  const Edit bond(BondEdit{seat.part, own, seat.at, seat.angle}, EditCause::kOutside);
  Order(bond);
  Order(sit);
  return true;
}

void Server::GetOut(int index) {
  const World& world = replica_.world();
  const Seat& seat = world.scene().seats[static_cast<std::size_t>(index)];
  const PartId own = world.scene().players[static_cast<std::size_t>(seat.player)].vehicle;
  for (std::size_t j = 0; own >= 0 && j < world.scene().joints.size(); ++j) {
    const Joint& joint = world.scene().joints[j];
    if (joint.gone || joint.kind != JointKind::kGlue || joint.a != seat.part || joint.b != own) {
      continue;
    }
    Order(Edit(BreakEdit{static_cast<std::int32_t>(j)}, EditCause::kOutside));
    const float mass = PartMass(world.scene().parts[static_cast<std::size_t>(own)]);
    Order(Edit(PushEdit{own, {0, kHop * mass}}, EditCause::kOutside));
  }
  Order(Edit(SeatEdit{index, -1}, EditCause::kOutside));
}

}  // namespace seam
