#pragma once
/// Whose name and peer number is whose. A place outlives its session for a while, and its owner
/// takes it back with the key that the first Welcome brought.

#include <array>
#include <cstdint>
#include <string>

#include "common/base/entropy.h"
#include "common/base/limits.h"
#include "common/scene/scene.h"

namespace seam {

struct Place {
  std::string name;            ///< "": free
  std::uint64_t key = 0;       ///< never 0 in a taken place
  int player = -1;             ///< index in the scene, -1: a spectator
  std::int64_t heard_us = 0;   ///< newest authenticated datagram of a session in it
  bool occupied = false;       ///< has a session
  bool key_known = false;      ///< the owner certainly has the key
  std::uint64_t previous = 0;  ///< number of the last session that was in it and is over
};

class PlaceTable {
 public:
  /// A taken name is refused to who has not its key until so long after the newest authenticated
  /// datagram, us. Then it is free.
  static constexpr std::int64_t kNameHeldUs = 30000000;
  /// A place whose owner may not have been told its key yet, who then could not come back, is given
  /// to another so long after its session's newest datagram, us. Who loads a room acknowledges many
  /// times in it.
  static constexpr std::int64_t kKeylessUs = 1000000;

  /// Both must outlive it.
  PlaceTable(const Scene& scene, Entropy& entropy) : scene_(scene), entropy_(entropy) {}

  struct Answer {
    int peer = -1;        ///< the place, or -1: refused
    std::string refusal;  ///< for people; "": say nothing
  };
  /// The place for who says this name and key (0: none) in a new session of this number: its own,
  /// whoever is in it now, or a new one.
  Answer Claim(std::int64_t now_us, const std::string& name, std::uint64_t key,
               std::uint64_t session);
  /// The place of this name if a session is in it that is silent (kKeylessUs) and whose owner is
  /// not known to have a key, and `key` is another: it has to end before the name is claimed. Else
  /// -1.
  int Abandoned(std::int64_t now_us, const std::string& name, std::uint64_t key) const;
  /// A session is in the place from now on.
  void Enter(int peer, std::int64_t now_us);
  /// The session in it has got an authenticated datagram. `ready`: it has said Ready, so it has
  /// been welcomed.
  void Heard(int peer, std::int64_t now_us, bool ready);
  /// The session of this number is over. `goodbye`: its owner said so, and needs the place no more.
  void Leave(int peer, std::uint64_t session, bool goodbye);

  /// "free are bob, carl": the scene's players whose places may be claimed without a key; those
  /// that do not fit a message are counted. "no player is free" when none may be.
  std::string FreeNames(std::int64_t now_us) const;

  const Place& at(int peer) const { return places_[static_cast<std::size_t>(peer)]; }

 private:
  int FindName(const std::string& name) const;
  /// A peer number for a new place of `player`; -1: the room is full.
  int ChoosePeer(int player) const;
  Place& At(int peer) { return places_[static_cast<std::size_t>(peer)]; }

  const Scene& scene_;
  Entropy& entropy_;
  std::array<Place, static_cast<std::size_t>(kPeersMax)> places_{};  // by peer; 0 is the server's
};

}  // namespace seam
