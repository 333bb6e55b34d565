#pragma once
/// How much each mechanism concerns each receiver: in a large room what is far from all that it has
/// concerns it less.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/base/sort_keys.h"
#include "common/sync/replica.h"

namespace seam {

/// Ascending.
enum class Concern : std::uint8_t {
  kNone,  ///< nothing of the receiver could meet it or see it for seconds
  kFar,
  kNear,
  kClose,  ///< mode central: it may meet what the receiver drives and predicts
};

class Interest {
 public:
  /// All must outlive it.
  Interest(const Scene& scene, const SyncConfig& config, const Replica& replica);

  /// Who is told, and which of the scene's players it plays; -1: it watches, and is near all.
  struct Receiver {
    int peer = 0, player = -1;
  };
  /// A mechanism that came to concern a receiver more than it did.
  struct Risen {
    int peer = 0, mechanism = 0;
  };
  /// Looks where everything is now. A receiver is near what is within kNearReach of what it drives
  /// or has authority over, and maybe what is twice as far; close likewise with kCloseReach, far
  /// with PlannerRules::hear: the rest is nothing to it, but far if it has and drives nothing. In a
  /// room of at most follow_bodies all is close to everyone.
  std::vector<Risen> Look(const std::vector<Receiver>& receivers);
  /// As of the last Look; in a large room, of who was not there, kNear.
  Concern Of(int peer, int mechanism) const {
    if (small_) return Concern::kClose;
    const auto m = static_cast<std::size_t>(mechanism), p = static_cast<std::size_t>(peer);
    if (m >= stride_ || p * stride_ >= concern_.size()) return Concern::kNear;
    return concern_[p * stride_ + m];
  }
  /// Whether the mechanisms are others since the last Look, or nobody has looked yet: then Of says
  /// kNear of all, and nobody hears.
  bool unknown() const { return concern_.empty(); }
  /// As of the last Look, in a large room: the receivers to whom the mechanism is at least far.
  const std::vector<int>& Hearing(int mechanism) const {
    return hearing_[static_cast<std::size_t>(mechanism)];
  }
  /// Of those: the receivers to whom it is at least near.
  const std::vector<int>& HearingNear(int mechanism) const {
    return hearing_near_[static_cast<std::size_t>(mechanism)];
  }
  /// Whether all is close to everyone.
  bool small() const { return small_; }
  /// The mechanisms have changed: in a large room all is near until the next Look.
  void Remap();

  /// m.
  static constexpr float kNearReach = 30, kCloseReach = 24;

 private:
  /// Mechanisms by the cells of a square grid that their bodies are in, each once in a cell.
  struct Cells {
    std::vector<std::uint64_t> keys;  // of cells with anything, ascending
    std::vector<int> begin;           // by cell: where it begins in mechanisms; one more at the end
    std::vector<int> mechanisms;
    std::vector<char> wanted;           // by slot, see FindCells
    std::vector<std::uint32_t> places;  // in the order of by_mechanism_: the body's cell
  };
  /// Which bodies may be elsewhere than in the last Look.
  void FindMoved();
  /// Those that the receivers may ask for, and some others.
  void FindCells(float side, const std::vector<Receiver>& receivers, Cells* cells);
  /// Marks the cells of the receiver's things and those beside them.
  void Want(const Receiver& receiver, float side, Cells* cells);
  /// What is in the cells of the receiver's things and in those beside them concerns it so much.
  void Raise(const Receiver& receiver, const Cells& cells, float side, Concern to);
  void FindThings(const Receiver& receiver);
  /// These mechanisms concern the receiver at least so much.
  void Note(const Receiver& receiver, const int* begin, const int* end, Concern to);
  void NoteAll(const Receiver& receiver, Concern to);
  void Begin(std::size_t peers, std::size_t mechanisms);
  /// What concerns a receiver more than in the Look before.
  void FindRisen(const Receiver& receiver, std::vector<Risen>* risen) const;

  const Scene& scene_;
  const SyncConfig& config_;
  const Replica& replica_;
  bool small_ = false;                                  // all is close to everyone
  std::size_t stride_ = 0;                              // mechanisms in a row
  std::vector<Concern> concern_;                        // by peer and mechanism
  std::vector<Concern> before_;                         // of the Look before
  std::vector<std::vector<int>> noted_, noted_before_;  // by peer: mechanisms of at least kFar
  std::vector<char> looked_, looked_before_;            // by peer: was a receiver
  std::vector<std::vector<int>> hearing_;               // by mechanism: peers
  std::vector<std::vector<int>> hearing_near_;          // the same
  std::vector<std::vector<int>> held_;           // by peer, in a Look: bodies it has authority over
  std::vector<int> things_;                      // of the receiver at hand: bodies
  std::vector<std::uint64_t> centres_, around_;  // cells: with its things, and beside them
  Cells far_, near_, close_;                     // of a Look
  std::vector<std::pair<int, int>> by_mechanism_;  // mechanism, body; ascending
  std::vector<int> place_of_;                      // by body: its place in by_mechanism_
  std::vector<int> moved_;                         // of a Look: bodies, some twice
  std::uint64_t change_ = 0;                       // World::last_change at the last Look
  bool all_moved_ = true;                          // places are not known
  std::vector<SortKey> order_, spare_;             // for FindCells
};

}  // namespace seam
