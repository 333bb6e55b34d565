#pragma once
/// Remembers where states that a peer hears differ from its own of the same tick, for the bus
/// (divergence_t).

#include <cstdint>
#include <map>
#include <optional>

#include "common/codec/messages.h"
#include "common/scene/types.h"

namespace seam {

class Divergences {
 public:
  /// Adds the difference `off` of a state told by `holder` from our own of that tick. `missing`:
  /// number of players without known inputs of that tick. Of each body the greatest one is kept,
  /// until it is taken.
  void Note(std::int32_t id, std::int64_t tick, int holder, const BodyState& off, int missing);
  /// Returns the differences since the last call, of a peer at `tick`; the greatest kDivergenceMax.
  /// nullopt: none.
  std::optional<Divergence> Take(std::int64_t now_us, int peer, std::int64_t tick);

 private:
  struct Greatest {
    std::int64_t tick = 0;
    int holder = 0, missing = 0;
    float apart = 0, kick = 0;  // m, m/s
    /// 1 m and 4 m/s count alike.
    float size() const { return apart + kick / 4; }
  };
  std::map<std::int32_t, Greatest> greatest_;  // by id
};

}  // namespace seam
