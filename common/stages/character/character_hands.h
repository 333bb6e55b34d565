#pragma once
/// A character's hands in the engine: what they touch and what they hold.

#include <vector>

#include "common/physics/stage.h"
#include "common/scene/character.h"

namespace seam {

class CharacterHands {
 public:
  CharacterHands(const Character& character, const StageWorld& world)
      : character_(character), world_(world) {}

  /// Looks the hands and their grips up.
  void Find();
  void Forget();

  /// Whether there is a hand at this side, 0 left or 1 right.
  bool has(int side) const { return body_[side] != nullptr; }
  bool holds(int side) const { return grip_[side] >= 0; }
  /// m, in the world. Requires has(side).
  b2Vec2 Tip(int side) const { return body_[side]->GetWorldPoint(tip_[side]); }

  /// After a tick: a grip of each hand with hold > 0 that touches something; the end of each with
  /// hold <= 0.
  void Propose(const float hold[2], std::vector<Edit>* edits) const;
  /// N; what the grip bore in the engine's last step, and what it may. Requires holds(side).
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
