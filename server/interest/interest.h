#pragma once
/// Relevance of each mechanism to each receiver. In a large room a mechanism is less relevant to a
/// receiver when it is far from everything that the receiver drives or has authority over.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/base/sort_keys.h"
#include "common/sync/replica.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

/// Relevance, ascending.
enum class Relevance : std::uint8_t {
  kNone,  ///< out of interest: the receiver can neither meet nor see it for seconds
  kFar,
  kNear,
  kClose,  ///< mode central: it may meet a mechanism that the receiver drives and predicts
};

class Interest {
 public:
  /// All must outlive this object.
  Interest(const Scene& scene, const SyncConfig& config, const Replica& replica);

  /// A client and the scene's player that it drives; -1: a spectator, near everything.
  struct Receiver {
    int peer = 0, player = -1;
  };
  /// A mechanism that became more relevant to a receiver.
  struct Risen {
    int peer = 0, mechanism = 0;
  };
  /// Computes all relevances from the current positions; returns those that rose. A mechanism is
  /// kNear within kNearReach of a body that the receiver drives or has authority over, and perhaps
  /// up to twice that; kClose likewise with kCloseReach, kFar with PlannerRules::hear. All else is
  /// kNone, or kFar to a player's client that has and drives nothing. In a room of at most
  /// follow_bodies everything is kClose to everyone.
  std::vector<Risen> Look(const std::vector<Receiver>& receivers);
  /// Returns the relevance as of the last Look; in a large room, kNear for an unknown peer.
  Relevance Of(int peer, int mechanism) const {
    if (small_) return Relevance::kClose;
    const auto m = static_cast<std::size_t>(mechanism), p = static_cast<std::size_t>(peer);
    if (m >= stride_ || p * stride_ >= relevance_.size()) return Relevance::kNear;
    return relevance_[p * stride_ + m];
  }
  /// True if there was no Look since the start or the last edit that changed bodies. In a large
  /// room Of then returns kNear for everything, and ReceiversFar is not valid.
  bool unknown() const { return relevance_.empty(); }
  /// False for a peer with a higher number than all receivers of the last Look; Of is kNear for it.
  bool Knows(int peer) const {
    return small_ || static_cast<std::size_t>(peer) * stride_ < relevance_.size();
  }
  /// Returns the receivers to which the mechanism is at least kFar, as of the last Look. Requires a
  /// large room.
  const std::vector<int>& ReceiversFar(int mechanism) const { return hearing_[mechanism]; }
  /// Returns the receivers to which the mechanism is at least kNear; else like ReceiversFar.
  const std::vector<int>& ReceiversNear(int mechanism) const { return receivers_near_[mechanism]; }
  /// True if everything is kClose to everyone.
  bool small() const { return small_; }

  /// m.
  static constexpr float kNearReach = 30, kCloseReach = 24;

 private:
  /// Square grid: the mechanisms with a body in each cell, each once per cell.
  struct Cells {
    std::vector<std::uint64_t> keys;  // occupied cells, ascending
    std::vector<int> begin;           // by cell: first index in mechanisms; one more at the end
    std::vector<int> mechanisms;
    std::vector<char> wanted;           // by slot, see FindCells
    std::vector<std::uint32_t> places;  // in the order of by_mechanism_: the body's cell
  };
  /// Starts with the world's bodies.
  void Start();
  /// Lists in moved_ the bodies that may have moved since the last Look.
  void FindMoved();
  /// Fills the cells near the receivers' bodies, and a few more because slots are shared.
  void FindCells(float side, const std::vector<Receiver>& receivers, Cells* cells);
  /// Marks the cells of the receiver's bodies and their eight neighbours as wanted.
  void Want(const Receiver& receiver, float side, Cells* cells);
  /// Raises the relevance of the mechanisms in the cells of the receiver's bodies, and in their
  /// eight neighbours, to at least `to`.
  void Raise(const Receiver& receiver, const Cells& cells, float side, Relevance to);
  void FindReceiverBodies(const Receiver& receiver);
  /// Raises the relevance of these mechanisms to at least `to`.
  void Note(const Receiver& receiver, const int* begin, const int* end, Relevance to);
  void NoteAll(const Receiver& receiver, Relevance to);
  void Begin(std::size_t peers, std::size_t mechanisms);
  /// Adds the mechanisms that are more relevant to a receiver than in the Look before.
  void FindRisen(const Receiver& receiver, std::vector<Risen>* risen) const;

  const Scene& scene_;
  const SyncConfig& config_;
  const Replica& replica_;
  bool small_ = false;                                  // everything is kClose to everyone
  std::size_t stride_ = 0;                              // mechanisms in a row
  std::vector<Relevance> relevance_;                    // by peer and mechanism
  std::vector<Relevance> before_;                       // in the Look before
  std::vector<std::vector<int>> noted_, noted_before_;  // by peer: mechanisms of at least kFar
  std::vector<char> looked_, looked_before_;            // by peer: was a receiver
  MechanismColumn<std::vector<int>> hearing_;           // peers, at least kFar
  MechanismColumn<std::vector<int>> receivers_near_;    // peers, at least kNear
  std::vector<std::vector<int>> held_;           // by peer, in a Look: bodies it has authority over
  std::vector<int> receiver_bodies_;             // bodies of the current receiver
  std::vector<std::uint64_t> centres_, around_;  // cells of its bodies; these and their neighbours
  Cells far_, near_, close_;                     // in a Look
  std::vector<std::pair<int, int>> by_mechanism_;  // mechanism, body; ascending
  BodyColumn<int> place_of_;                       // its index in by_mechanism_
  std::vector<int> moved_;                         // in a Look: bodies, some twice
  std::uint64_t change_ = 0;                       // World::last_change at the last Look
  bool all_moved_ = true;                          // no cell is known
  std::vector<SortKey> order_, spare_;             // for FindCells
  EditHook edited_;
};

}  // namespace seam
