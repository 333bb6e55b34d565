#pragma once
/// One world with a player's character "hero", driven by a trial, and its visible state. Edits
/// proposed by physics are applied at once.

#include <memory>
#include <string>

#include "common/physics/world.h"
#include "tests/lab/gait/ability.h"

namespace seam {

/// In the world's frame.
struct GaitSight {
  Vec2 centre{0, 0}, velocity{0, 0};  ///< of mass, m and m/s
  float mass = 0;                     ///< kg
  float head_y = 0;                   ///< m; middle
  float hand_y = 0;                   ///< m; middle of the higher lower arm
  float soles = 0;                    ///< m; middle of the lower foot, less half its height
  float torso = 0;                    ///< rad; 0 is upright
  bool feet = false;                  ///< a foot touches something
  bool other = false;                 ///< another part does
  /// On its soles alone, the torso within 30 degrees.
  bool upright() const;
};

class GaitRun {
 public:
  /// `ground` are tables of the scene; `place` lines of the [[character]].
  GaitRun(const GaitSetup& setup, const CharacterGains& gains, const std::string& ground,
          const std::string& place);

  /// One tick with these axes, -1 to 1.
  void Step(float drive, float lift = 0);
  /// Until `seconds` have passed since the beginning.
  void RunTo(double seconds, float drive, float lift = 0);
  double time() const;  ///< s

  /// Returns the state after the last step.
  const GaitSight& Look() const { return sight_; }
  /// Applies an impulse to the middle of the torso, N s.
  void Shove(Vec2 impulse);
  /// By a command, for so many seconds.
  void GoLimp(float seconds);
  /// Ticks that it has been upright without a break, up to now.
  int upright_ticks() const { return upright_ticks_; }
  const World& world() const { return *world_; }

 private:
  GaitSight See() const;

  std::unique_ptr<World> world_;
  GaitSight sight_;
  int upright_ticks_ = 0;
};

/// Flat ground, from -200 to 200 m.
extern const char* const kFlat;

}  // namespace seam
