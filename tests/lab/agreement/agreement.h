#pragma once
/// How long the peers of a room differ about a body although each of them knows all inputs.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "client/embed/cluster.h"

namespace seam {

/// Compares the pasts of all peers that simulate a body at every tick, once, as soon as all of them
/// know all inputs up to it. Call Look after every virtual instant.
class AgreementWatch {
 public:
  explicit AgreementWatch(Cluster& cluster) : cluster_(cluster) {}
  void Look();

  /// The longest time in which a pair of peers differed all along, s; 0: none did.
  double longest_s() const;
  /// The body of that time; empty: none.
  std::string body() const { return body_; }
  /// Number of comparisons of a body between two peers.
  std::int64_t compared() const { return compared_; }
  std::int64_t differed() const { return differed_; }

  /// Two poses farther apart than this, m, with the way of an edge by their angles, differ.
  static constexpr float kApart = 0.05f;

 private:
  using Pair = std::tuple<int, int, PartId>;  // two peers and a body's id
  std::optional<std::int64_t> KnownTick() const;
  /// Number of ticks that the peers' pasts are compared back.
  std::int64_t PastTicks() const;
  void Compare(int a, int b, std::int64_t tick);

  Cluster& cluster_;
  std::vector<const Replica*> peers_;
  std::map<Pair, std::int64_t> differ_;  // number of ticks, one after another
  std::int64_t looked_ = -1, compared_tick_ = -1, longest_ = 0, compared_ = 0, differed_ = 0;
  std::string body_;
};

}  // namespace seam
