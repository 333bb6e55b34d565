#include "server/rules/seats.h"

#include <cmath>

#include "common/physics/part_places.h"

namespace seam {
namespace {

/// Who gets out is pushed upwards by this much, m/s, so as not to fall back in.
constexpr float kHop = 2;

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
  Edit sit;
  sit.kind = EditKind::kSeat;
  sit.cause = EditCause::kOutside;
  sit.a = index;
  sit.player = player;
  if (own < 0) {
    edits->push_back(sit);
    return true;
  }
  if (world.scene().parts[static_cast<std::size_t>(own)].gone) return false;
  const BodyState vehicle = PartPose(world, seat.part);
  const float c = std::cos(vehicle.angle), s = std::sin(vehicle.angle);
  const Vec2 place =
      vehicle.position + Vec2(c * seat.at.x() - s * seat.at.y(), s * seat.at.x() + c * seat.at.y());
  if ((PartPose(world, own).position - place).norm() > seat.reach) return false;
  Edit bond;
  bond.kind = EditKind::kBond;
  bond.cause = EditCause::kOutside;
  bond.a = seat.part;
  bond.b = own;
  bond.x = seat.at.x();
  bond.y = seat.at.y();
  bond.angle = seat.angle;
  edits->push_back(bond);
  edits->push_back(sit);
  return true;
}

void GetOut(const World& world, int index, std::vector<Edit>* edits) {
  const Seat& seat = world.scene().seats[static_cast<std::size_t>(index)];
  const PartId own = world.scene().players[static_cast<std::size_t>(seat.player)].vehicle;
  Edit stand;
  stand.kind = EditKind::kSeat;
  stand.cause = EditCause::kOutside;
  stand.a = index;
  stand.player = -1;
  for (std::size_t j = 0; own >= 0 && j < world.scene().joints.size(); ++j) {
    const Joint& joint = world.scene().joints[j];
    if (joint.gone || joint.kind != JointKind::kGlue || joint.a != seat.part || joint.b != own) {
      continue;
    }
    Edit part;
    part.kind = EditKind::kBreak;
    part.cause = EditCause::kOutside;
    part.joint = static_cast<std::int32_t>(j);
    edits->push_back(part);
    Edit hop;
    hop.kind = EditKind::kPush;
    hop.cause = EditCause::kOutside;
    hop.a = own;
    hop.y = kHop * PartMass(world.scene().parts[static_cast<std::size_t>(own)]);
    edits->push_back(hop);
  }
  edits->push_back(stand);
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

}  // namespace seam
