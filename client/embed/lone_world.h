#pragma once
/// A world alone, without a room: steps a scene by its players' inputs, applies the edits that its
/// physics causes, and can be saved. Rules of the server (triggers, health, scripts) do not act.

#include <memory>
#include <string>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/status.h"
#include "common/physics/world.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

class LoneWorld {
 public:
  /// Requires a scene that ParseScene accepted.
  explicit LoneWorld(const Scene& scene);
  ~LoneWorld();
  LoneWorld(const LoneWorld&) = delete;
  LoneWorld& operator=(const LoneWorld&) = delete;

  /// The world as it is now; replaced by Load and Reset.
  const World& world() const { return *world_; }
  /// Returns the number of the scene's players.
  int player_count() const { return static_cast<int>(inputs_.size()); }

  /// Sets a player's input from the next tick on; buttons act when they go down. Returns an error
  /// of one line if there is no such player.
  Status SetInput(int player, const Input& input);
  /// Sets pose and velocity of a moving body, by its id. Returns an error of one line if there is
  /// no such body, or a number is not finite or beyond the limits of saved states.
  Status Write(PartId body, const BodyState& state);
  /// Advances by so many ticks, 0 or more.
  void Step(int ticks);

  /// Goes back to tick 0.
  void Reset();
  /// Returns the state as bytes. This world and one that loads them continue with the same bits;
  /// saving is a barrier (World::Barrier).
  Bytes Save();
  /// Continues a state of the same scene. Returns an error of one line, and changes nothing, if
  /// the bytes are damaged or of another scene or version.
  Status Load(ByteView bytes);

 private:
  void StepOnce();
  void Become(std::unique_ptr<World> world, std::vector<Edit> edits, std::vector<Input> inputs);

  const Scene scene_;
  std::unique_ptr<World> world_;
  std::vector<Edit> edits_;    // applied, in order
  std::vector<Input> inputs_;  // of each player, now
  std::vector<int> held_;      // buttons of each player in the last tick
};

}  // namespace seam
