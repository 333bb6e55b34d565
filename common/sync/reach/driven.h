#pragma once
/// Determines the mechanisms that a player's inputs move directly.

#include <vector>

#include "common/physics/world.h"
#include "common/sync/roles.h"

namespace seam {

/// By mechanism of the world's composition: true if the player owns it, if it is the player's
/// vehicle, or if the player's axes drive a motor, a thrust, a belt or a character of it, directly
/// or from a seat; with `actions` also if a button pushes one of its parts.
std::vector<bool> DrivenMechanisms(const World& world, int player, bool actions);

/// Caches each player's driven mechanisms, and the players that this peer needs inputs of.
class Drivers {
 public:
  /// Both must outlive this.
  Drivers(const World& world, const Roles& roles) : world_(world), roles_(roles) { Look(); }

  /// Call after the world's composition or the roles have changed.
  void Look();
  /// Mechanisms that the player's axes or buttons move, ascending.
  const std::vector<int>& MechanismsOf(int player) const {
    return driven_[static_cast<std::size_t>(player)];
  }
  /// Mechanisms that the player's axes move, ascending; buttons do not count.
  const std::vector<int>& MovedBy(int player) const {
    return moved_[static_cast<std::size_t>(player)];
  }
  /// True if the player's axes move an anchored belt.
  bool MovesBelt(int player) const { return !BeltsOf(player).empty(); }
  /// Anchored belts that the player's axes move.
  const std::vector<PartId>& BeltsOf(int player) const {
    return belts_[static_cast<std::size_t>(player)];
  }
  /// True if any player's axes move the mechanism; buttons do not count.
  bool Driven(int mechanism) const { return by_axes_[static_cast<std::size_t>(mechanism)] != 0; }
  /// True if the player's inputs move a mechanism that this peer simulates, or an anchored belt.
  /// Inputs of other players are not needed: their effect is visible in states.
  bool Concerns(int player) const { return concerns_[static_cast<std::size_t>(player)] != 0; }
  /// Players for which Concerns is true, ascending.
  const std::vector<int>& concerned() const { return concerned_; }

  /// True if `simulates(mechanism)` holds for any mechanism of the player, or if the player moves
  /// an anchored belt.
  template <class Simulates>
  bool Moves(int player, const Simulates& simulates) const {
    if (MovesBelt(player)) return true;
    for (const int m : MechanismsOf(player)) {
      if (simulates(m)) return true;
    }
    return false;
  }

 private:
  void Find();

  const World& world_;
  const Roles& roles_;
  int revision_ = -1;                     // revision that driven_ belongs to
  std::vector<std::vector<int>> driven_;  // by player
  std::vector<std::vector<int>> moved_;   // by player: by axes only
  std::vector<char> by_axes_;             // rebuilt by Look, by mechanism
  std::vector<std::vector<PartId>> belts_;  // by player
  std::vector<char> concerns_;              // by player
  std::vector<int> concerned_;            // players
};

}  // namespace seam
