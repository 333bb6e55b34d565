#pragma once
/// Changes the states in a client's packed messages: for a client that lies (RewritingNet).

#include <functional>
#include <variant>
#include <vector>

#include "common/codec/codec.h"
#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/scene/scene.h"

namespace seam {

/// Reads a client's packed states on their way, for forgers that need only ids, epochs and ticks.
class SentStates {
 public:
  /// Returns the first States in a message, or nullptr. To be given every message, since packed
  /// states are differences from earlier ones.
  const States* In(const Bytes& message) {
    const AnyMessage any = Decode(message);
    const auto* packed = std::get_if<PackedStates>(&any);
    const std::vector<States>* all = packed == nullptr ? nullptr : unpacker_.Take(*packed);
    return all == nullptr ? nullptr : &all->front();
  }

 private:
  StatesUnpacker unpacker_{PackedMotion()};
};

/// To be given every message of the client, since packed states are differences from earlier ones.
class RewrittenStates {
 public:
  explicit RewrittenStates(const Scene& scene)
      : motion_(scene.gravity.x(), scene.gravity.y(), scene.solver.tick_hz) {}

  /// Calls `change` for the states in the message, and replaces it; other messages stay.
  void Rewrite(Bytes* message, const std::function<void(States*)>& change) {
    const AnyMessage any = Decode(*message);
    const auto* packed = std::get_if<PackedStates>(&any);
    const std::vector<States>* all = packed == nullptr ? nullptr : honest_.Take(*packed);
    if (all == nullptr) return;
    for (States states : *all) {
      change(&states);
      lying_.Add(states);
    }
    // Nothing is acknowledged to this packer, so that it tells whole states.
    *message = Encode(lying_.Take(0).front().packed);
  }

 private:
  const PackedMotion motion_;
  StatesUnpacker honest_{motion_};
  StatesPacker lying_{motion_};
};

}  // namespace seam
