#pragma once
/// Reservations (places) of player names and peer numbers. A place outlives its session by up to
/// kNameHeldUs; its owner reclaims it with the key from its first Welcome.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/base/entropy.h"
#include "common/base/limits.h"
#include "common/scene/scene.h"

namespace seam {

class StateArchive;

struct Place {
  std::string name;            ///< "": free
  std::uint64_t key_hash = 0;  ///< KeyHash of its key; never 0 in a taken place
  int player = -1;             ///< index in the scene, -1: a spectator
  std::int64_t heard_us = 0;   ///< newest authenticated datagram of a session in it
  bool occupied = false;       ///< has a session
  bool key_known = false;      ///< the owner certainly has the key
  std::uint64_t previous = 0;  ///< number of the last session in it that has ended
};

class PlaceTable {
 public:
  /// Time after the newest authenticated datagram for which a name is refused to clients without
  /// its key, us. Then the name is free.
  static constexpr std::int64_t kNameHeldUs = 30000000;
  /// The same for an owner that may not have received its key yet, and so could not come back, us:
  /// from its session's newest datagram. A client that loads a room acknowledges many times within
  /// it.
  static constexpr std::int64_t kKeylessUs = 1000000;

  /// Both must outlive this object.
  PlaceTable(const Scene& scene, Entropy& entropy) : scene_(scene), entropy_(entropy) {}

  struct Answer {
    int peer = -1;        ///< the place, or -1: refused
    std::uint64_t key = 0;  ///< of the place
    std::string refusal;  ///< for people; "": send no answer
  };
  /// Finds the place for a client with this name and key (0: none) in a new session of number
  /// `session`: the client's own, even if another session is in it, or a new one.
  Answer Claim(std::int64_t now_us, const std::string& name, std::uint64_t key,
               std::uint64_t session);
  /// Returns the place of this name if its session was silent for kKeylessUs, its owner is not
  /// known to have the key, and `key` is another. The session has to end before the name is
  /// claimed. Else -1.
  int Abandoned(std::int64_t now_us, const std::string& name, std::uint64_t key) const;
  /// True if there is a place of this name, and this is its key.
  bool IsOwner(const std::string& name, std::uint64_t key) const;
  /// True if somebody has, or may still come back to, the place of this player.
  bool IsReserved(std::int64_t now_us, int player) const;
  /// Marks the place as occupied by a session.
  void Enter(int peer, std::int64_t now_us);
  /// To be called when the session in the place has got an authenticated datagram. `ready`: the
  /// client has said Ready, so it has received the Welcome with its key.
  void Heard(int peer, std::int64_t now_us, bool ready);
  /// Ends the session of this number. `goodbye`: the owner said so; the place becomes free.
  void Leave(int peer, std::uint64_t session, bool goodbye);

  /// A place of which the owner has the key now, or has not any more.
  struct Change {
    int peer = 0;
    std::string name;
    std::uint64_t key_hash = 0;  ///< 0: nobody has it
  };
  /// Returns the changes since the last call, in their order.
  std::vector<Change> TakeChanges() { return std::exchange(changes_, {}); }
  /// Makes such a change again, as a log has it; the owner is counted as heard now.
  void Assume(std::int64_t now_us, int peer, const std::string& name, std::uint64_t key_hash);
  /// Counts the owner of the place, if there is one, as heard now.
  void NoteBack(int peer, std::int64_t now_us);
  /// Returns the only trace of a key that this keeps, and that a log has: nobody can find the key
  /// by it. Never 0.
  static std::uint64_t KeyHash(std::uint64_t key);

  /// Saves the taken places and how long ago their owners were heard. Reading: no place has a
  /// session, and the owner of one that had is counted as heard now.
  void Persist(StateArchive& a, std::int64_t now_us);

  /// Returns "free are bob, carl": the scene's players that may be claimed without a key. Names
  /// that do not fit a message are only counted. "no player is free" if there is none.
  std::string FreeNames(std::int64_t now_us) const;

  const Place& at(int peer) const { return places_[static_cast<std::size_t>(peer)]; }

 private:
  int FindName(const std::string& name) const;
  /// Returns the index in the scene of the player of this name; -1: a spectator.
  int PlayerOf(const std::string& name) const;
  void Free(int peer);
  void NoteKnown(int peer);
  /// Returns a peer number for a new place of `player`; -1: the room is full.
  int ChoosePeer(int player) const;
  Place& At(int peer) { return places_[static_cast<std::size_t>(peer)]; }

  const Scene& scene_;
  Entropy& entropy_;
  std::vector<Change> changes_;
  std::array<Place, static_cast<std::size_t>(kPeersMax)> places_{};  // by peer; 0 is the server's
};

}  // namespace seam
