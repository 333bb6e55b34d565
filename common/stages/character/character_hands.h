#pragma once
/// A character's hands in the engine: touch and grip.

#include <vector>

#include "common/physics/stage.h"
#include "common/scene/character.h"

namespace seam {

class CharacterHands {
 public:
  CharacterHands(const Character& character, const StageWorld& world)
      : character_(character), world_(world) {}

  /// Looks up the hands and their grips.
  void Find();
  void Forget();

  /// True if there is a hand on this side: 0 left, 1 right.
  bool has(int side) const { return body_[side] != nullptr; }
  bool holds(int side) const { return grip_[side] >= 0; }
  /// Fingertip, m, in the world. Requires has(side).
  b2Vec2 Tip(int side) const { return body_[side]->GetWorldPoint(tip_[side]); }

  /// Proposes, after a tick, a grip for each hand with hold > 0 that touches something, and the
  /// release of each grip with hold <= 0.
  void Propose(const float hold[2], std::vector<Edit>* edits) const;
  /// N; load of the grip in the engine's last step, and its strength. Requires holds(side).
  float Force(int side) const;
  float Strength(int side) const;

 private:
  void ProposeGrip(int side, std::vector<Edit>* edits) const;

  const Character character_;
  const StageWorld world_;
  b2Body* body_[2] = {};
  b2Vec2 tip_[2];           // m, in the body's frame
  int grip_[2] = {-1, -1};  // index into Scene::joints
};

}  // namespace seam
