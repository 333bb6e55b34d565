#pragma once
/// A client that lies: the real client, of which the messages are changed on their way out.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/codec/packed/packed_inputs.h"
#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/codec/wire_body.h"
#include "common/net/net.h"
#include "common/scene/scene.h"

namespace seam {

/// Names of all attacks, in the order of docs/trust.md; the first is "none".
const std::vector<std::string>& AttackNames();

/// The lies of one client. Its honest client believes in the states that it has.
class Cheat {
 public:
  /// Throws OperatorError for a name that is not among AttackNames(). `scene` must outlive it.
  Cheat(const std::string& attack, const Scene& scene);

  /// Returns the network of the lying client; this must outlive it.
  std::unique_ptr<Net> Around(std::unique_ptr<Net> net);
  /// Tick of the first lie, -1: none yet; the number of messages with lies.
  std::int64_t first_tick() const { return first_tick_; }
  std::int64_t lies() const { return lies_; }

 private:
  /// Changes a told body; false: it is not told.
  using Change = std::function<bool(std::int64_t tick, WireBody* body)>;

  void ChooseLies(const std::string& attack);
  void Rewrite(Bytes* message);
  void RewriteStates(Bytes* message, const PackedStates& packed);
  void LeaveOutInputs(Bytes* message, const PackedInputs& packed);
  void RewriteOther(Bytes* message);
  void NoteLie(std::int64_t tick);
  bool IsCar(std::int32_t id) const;
  /// Lies that are small in each message: a car that gains `rate` m/s in each second along its way,
  /// as by a stronger engine or less friction; one that keeps `share` more of each blow's speed.
  Change Gain(double rate);
  Change Bounce(double share);

  const Scene& scene_;
  std::vector<std::int32_t> car_;  // ids of the bodies of the first player's vehicle, ascending
  std::string attack_;
  std::int64_t start_tick_ = 150;
  Change change_;
  StatesUnpacker honest_;
  StatesPacker lying_;
  std::map<std::int32_t, WireBody> first_;  // by id: the honest state of the first lie
  /// Of a car's part, by Gain and Bounce: how far its told state is ahead.
  struct Ahead {
    std::int64_t tick = -1;
    double way = 0, speed = 0;  // m, m/s
    double was = 0;             // honest speed of that tick
  };
  std::map<std::int32_t, Ahead> ahead_;  // by id
  std::int32_t wheel_ = -1;              // id of the one that is torn off
  std::int64_t tick_ = 0;                // newest told
  std::int64_t first_tick_ = -1, lies_ = 0;
  std::int32_t revision_ = 0;  // newest told
  int pings_ = 0;
};

}  // namespace seam
