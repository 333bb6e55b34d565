#pragma once
/// A world beside the room's: mechanisms are put at told states, stepped with the known inputs, and
/// compared with the states that were told later. Used while the room runs (server/trust) and on
/// recordings (common/measure).

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/physics/world.h"
#include "common/stages/character_guess.h"
#include "common/sync/audit/turns.h"

namespace seam {

/// The way of a mechanism beside physics since it was put: later told states minus stepped ones.
struct Gain {
  double seconds = 0;
  Vec2 position{0, 0};  ///< of the centre of mass, m
  Vec2 velocity{0, 0};  ///< of the centre of mass, m/s
  Vec2 stepped{0, 0};   ///< velocity of the centre of mass as stepped, m/s
  double apart = 0;     ///< greatest move of a body relative to the centre of mass, m
  bool met = false;     ///< it has touched another mechanism, of the same holder
  /// A sum over short intervals, each from told states: places hardly depend on forces then.
  bool summed = false;
};

class SpareWorld {
 public:
  /// kNone: only mechanisms that Put has named are in the world; else all.
  enum class Present { kAll, kNone };
  SpareWorld(const Topology& topology, Present present);

  const World& world() const { return world_; }
  /// Bodies of a mechanism, ascending: the order of its states below.
  const std::vector<int>& bodies(int mechanism) const {
    return bodies_[static_cast<std::size_t>(mechanism)];
  }
  void SetTick(std::int64_t tick) { world_.SetTick(tick); }
  /// Applies an edit. If it renumbers bodies, all mechanisms leave the world. What controllers
  /// remember stays. Requires Present::kNone.
  void Apply(const Edit& edit);
  /// Puts a mechanism at these states and into the world. `holder`: its peer; mechanisms of other
  /// holders that it touches from now on make it incomparable. 0: it is only in the way of others.
  /// Full turns of hinged bodies are put right.
  void Put(int mechanism, int holder, std::vector<BodyState> states);
  /// Takes a mechanism out of the world. Requires Present::kNone.
  void Take(int mechanism);
  /// From its next Put on, a character is in another state that its poses allow: the limbs on its
  /// left are put for those on its right, or its controller is in another mode (OtherStates).
  /// `other`: 0 as it is now, and then ascending. Returns false if there is no such other: it is
  /// then again as it was.
  bool TryOther(int mechanism, int other);
  /// Steps once; `inputs` sets those of the tick.
  void Step(const std::function<void(World*)>& inputs);
  /// Returns the state of the body in whose place it was put (ExchangeSides).
  BodyState Stepped(int mechanism, int body) const { return world_.Read(PlaceOf(mechanism, body)); }
  /// Compares a mechanism's bodies with states told for now, but for those that were left out.
  /// nullopt if it has no holder, or has touched another one's.
  using ToldNow = std::vector<std::optional<BodyState>>;
  std::optional<Gain> Compare(int mechanism, const ToldNow& told) const;

 private:
  struct Standing {
    int holder = 0;
    bool met = false;      // has touched another mechanism
    bool lost = false;     // that was another holder's
    std::int64_t put = 0;  // tick
  };

  /// A character before others were tried.
  struct Before {
    std::int64_t tick = 0;
    std::vector<float> memory;
    char exchanged = 0;
    std::vector<CharacterGuess> others;
  };

  std::vector<float> MemoryOf(int character);
  void Remember(int character, const std::vector<float>& memory);
  void Number();
  /// Body in which the told state of this one is put.
  int PlaceOf(int mechanism, int body) const;

  World world_;
  std::optional<Turns> turns_;
  std::vector<std::vector<int>> bodies_;  // rebuilt for each topology, by mechanism
  std::vector<Standing> standings_;       // rebuilt for each topology, by mechanism
  // The body itself, or the same limb on the other side.
  std::vector<int> other_side_;    // rebuilt for each topology, by body
  std::vector<int> character_of_;  // rebuilt for each topology, by mechanism: its first one
  std::vector<char> exchanged_;    // by character, which edits do not renumber
  std::vector<Before> before_;     // by character
};

}  // namespace seam
