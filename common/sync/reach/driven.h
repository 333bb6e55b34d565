#pragma once
/// What a player drives: the mechanisms that the player's inputs move directly.

#include <vector>

#include "common/physics/world.h"
#include "common/sync/roles.h"

namespace seam {

/// By mechanism of the world's composition: whether it is the player's own (its owner, or the
/// player's vehicle), whether the player's axes turn a motor, a thrust or a character of it, or of
/// a seat in which the player sits; with `actions` also whether a button pushes a part of it.
std::vector<bool> DrivenMechanisms(const World& world, int player, bool actions);

/// The same for all players, kept until an edit changes it, and which of them this peer's world has
/// to hear of.
class Drivers {
 public:
  /// Both must outlive this.
  Drivers(const World& world, const Roles& roles) : world_(world), roles_(roles) { Look(); }

  /// After changes of the world's composition or of roles.
  void Look();
  /// Mechanisms that the player's axes or buttons move, ascending.
  const std::vector<int>& MechanismsOf(int player) const {
    return driven_[static_cast<std::size_t>(player)];
  }
  /// Those that the player's axes move: buttons do not count; ascending.
  const std::vector<int>& MovedBy(int player) const {
    return moved_[static_cast<std::size_t>(player)];
  }
  /// Whether the player's axes move an anchored belt.
  bool MovesBelt(int player) const { return belts_[static_cast<std::size_t>(player)] != 0; }
  /// Whether any player's axes move the mechanism; buttons do not count.
  bool Driven(int mechanism) const { return by_axes_[static_cast<std::size_t>(mechanism)] != 0; }
  /// Whether the player's inputs move something that this peer simulates, or a belt that does not
  /// move itself. What others do is only seen, by their states.
  bool Concerns(int player) const { return concerns_[static_cast<std::size_t>(player)] != 0; }
  /// The players of whom it holds, ascending.
  const std::vector<int>& concerned() const { return concerned_; }

  /// Whether `simulates` (of a mechanism's index) holds for one of the player's; true for who moves
  /// an anchored belt.
  template <class Simulates>
  bool Moves(int player, const Simulates& simulates) const {
    if (belts_[static_cast<std::size_t>(player)] != 0) return true;
    for (const int m : MechanismsOf(player)) {
      if (simulates(m)) return true;
    }
    return false;
  }

 private:
  void Find();

  const World& world_;
  const Roles& roles_;
  int revision_ = -1;                     // of which driven_ is
  std::vector<std::vector<int>> driven_;  // by player
  std::vector<std::vector<int>> moved_;   // by player: by axes
  std::vector<char> by_axes_;             // by mechanism
  std::vector<char> belts_, concerns_;    // by player
  std::vector<int> concerned_;            // players
};

}  // namespace seam
