#include "server/sessions/place_table.h"

#include <algorithm>
#include <cstring>

#include "common/base/names.h"
#include "common/base/state_archive.h"
#include "common/codec/message_limits.h"
#include "common/net/keyed_hash.h"

namespace seam {
namespace {

/// Longest list of free names in a refusal, bytes. The message must still fit with the longest name
/// in use before the list and the count of omitted names after it.
constexpr std::size_t kFreeBytesMax = 120;
static_assert(kFreeBytesMax + kNameBytesMax + 40 <= kImpairBytesMax);

bool IsHeld(const Place& place, std::int64_t now_us) {
  return !place.name.empty() && now_us - place.heard_us < PlaceTable::kNameHeldUs;
}

}  // namespace

PlaceTable::Answer PlaceTable::Claim(std::int64_t now_us, const std::string& name,
                                     std::uint64_t key, std::uint64_t session) {
  const int own = FindName(name);
  if (own > 0) {
    Place& place = At(own);
    if (place.key_hash == KeyHash(key)) {
      // A late or replayed Join of an ended session must not end the session that came after it.
      if (session == place.previous) return {};
      NoteKnown(own);
      return {own, key, ""};
    }
    if (IsHeld(place, now_us)) {
      return {-1, 0, "the name " + name + " is in use; " + FreeNames(now_us)};
    }
    Free(own);
  }
  const int player = PlayerOf(name);
  const int peer = ChoosePeer(player);
  if (peer < 0) return {-1, 0, "the room is full"};
  Free(peer);
  Place& place = At(peer);
  place.name = name;
  place.player = player;
  std::uint64_t drawn = 0;
  while (drawn == 0) drawn = entropy_.Next();
  place.key_hash = KeyHash(drawn);
  return {peer, drawn, ""};
}

std::uint64_t PlaceTable::KeyHash(std::uint64_t key) {
  HashKey secret{};
  std::memcpy(secret.data(), &key, sizeof key);
  return std::max<std::uint64_t>(1, KeyedHash(secret, TextBytes("place")));
}

void PlaceTable::Free(int peer) {
  Place& place = At(peer);
  if (place.key_known) changes_.push_back({peer, place.name, 0});
  place = Place();
}

void PlaceTable::NoteKnown(int peer) {
  Place& place = At(peer);
  if (std::exchange(place.key_known, true)) return;
  changes_.push_back({peer, place.name, place.key_hash});
}

void PlaceTable::Assume(std::int64_t now_us, int peer, const std::string& name,
                        std::uint64_t key_hash) {
  if (peer < 1 || peer >= kPeersMax) return;
  const int elsewhere = FindName(name);
  if (elsewhere > 0) At(elsewhere) = Place();
  At(peer) = Place();
  if (key_hash == 0) return;
  Place& place = At(peer);
  place.name = name;
  place.key_hash = key_hash;
  place.player = PlayerOf(name);
  place.heard_us = now_us;
  place.key_known = true;
}

void PlaceTable::NoteBack(int peer, std::int64_t now_us) {
  if (peer < 1 || peer >= kPeersMax || at(peer).name.empty()) return;
  At(peer).heard_us = now_us;
}

int PlaceTable::PlayerOf(const std::string& name) const {
  for (std::size_t p = 0; p < scene_.players.size(); ++p) {
    if (scene_.players[p].name == name) return static_cast<int>(p);
  }
  return -1;
}

int PlaceTable::Abandoned(std::int64_t now_us, const std::string& name, std::uint64_t key) const {
  const int own = FindName(name);
  if (own < 0) return -1;
  const Place& place = at(own);
  const bool silent = place.occupied && now_us - place.heard_us >= kKeylessUs;
  return silent && !place.key_known && place.key_hash != KeyHash(key) ? own : -1;
}

bool PlaceTable::IsOwner(const std::string& name, std::uint64_t key) const {
  const int own = FindName(name);
  return own > 0 && at(own).key_hash == KeyHash(key);
}

bool PlaceTable::IsReserved(std::int64_t now_us, int player) const {
  return std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    return !place.name.empty() && place.player == player && IsHeld(place, now_us);
  });
}

std::string PlaceTable::FreeNames(std::int64_t now_us) const {
  std::string list;
  int left_out = 0;
  for (const Player& player : scene_.players) {
    const int own = FindName(player.name);
    if (own > 0 && IsHeld(at(own), now_us)) continue;
    if (list.size() + player.name.size() + 2 > kFreeBytesMax) {
      ++left_out;
    } else {
      list += (list.empty() ? "free are " : ", ") + player.name;
    }
  }
  if (left_out > 0) list += " and " + std::to_string(left_out) + " more";
  return list.empty() ? "no player is free" : list;
}

int PlaceTable::FindName(const std::string& name) const {
  const auto found = std::find_if(places_.begin() + 1, places_.end(),
                                  [&](const Place& place) { return place.name == name; });
  return found == places_.end() ? -1 : static_cast<int>(found - places_.begin());
}

int PlaceTable::ChoosePeer(int player) const {
  // Player p is peer p + 1 wherever possible, so that peer numbers mean the same in all recordings
  // of a scene; spectators come after the players.
  const auto free = [](const Place& place) { return place.name.empty(); };
  if (player >= 0 && free(at(player + 1))) return player + 1;
  const auto first =
      places_.begin() +
      std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(scene_.players.size()) + 1, kPeersMax);
  auto best = std::find_if(first, places_.end(), free);
  // Else the unoccupied place that was left first, although it is still held for its owner.
  for (auto it = first; it != places_.end() && (best == places_.end() || !free(*best)); ++it) {
    const bool earlier = best == places_.end() || it->heard_us < best->heard_us;
    if (!it->occupied && earlier) best = it;
  }
  return best == places_.end() ? -1 : static_cast<int>(best - places_.begin());
}

void PlaceTable::Enter(int peer, std::int64_t now_us) {
  At(peer).occupied = true;
  At(peer).heard_us = now_us;
}

void PlaceTable::Heard(int peer, std::int64_t now_us, bool ready) {
  At(peer).heard_us = now_us;
  if (ready) NoteKnown(peer);
}

void PlaceTable::Leave(int peer, std::uint64_t session, bool goodbye) {
  Place& place = At(peer);
  place.occupied = false;
  place.previous = session;
  // An owner that never received the key could not come back with it.
  if (goodbye || !place.key_known) Free(peer);
}

void PlaceTable::Persist(StateArchive& a, std::int64_t now_us) {
  a.Section("places");
  struct Saved {
    int peer = 0;
    std::int64_t age_us = 0;
    Place place;
  };
  std::vector<Saved> all;
  for (int peer = 1; peer < kPeersMax; ++peer) {
    if (!at(peer).name.empty()) all.push_back({peer, now_us - at(peer).heard_us, at(peer)});
  }
  if (a.reading()) places_.fill(Place());
  a.List(&all, places_.size(), [&](Saved* saved) {
    Place& place = saved->place;
    a.Int(&saved->peer, 1, kPeersMax - 1);
    a.Int(&saved->age_us, 0, INT64_MAX);
    a.Text(&place.name, kNameBytesMax);
    a.Word(&place.key_hash);
    a.Int(&place.player, -1, static_cast<std::int64_t>(scene_.players.size()) - 1);
    a.Flag(&place.occupied);
    a.Flag(&place.key_known);
    a.Word(&place.previous);
    if (!a.reading() || !a.ok()) return;
    a.Require(IsName(place.name) && FindName(place.name) < 0 && place.key_hash != 0 &&
                  at(saved->peer).name.empty(),
              "a place is wrong");
    // Who never learned the key could not come back with it.
    if (place.occupied && !place.key_known) return;
    place.heard_us = place.occupied ? now_us : now_us - std::min(saved->age_us, kNameHeldUs);
    place.occupied = false;
    At(saved->peer) = place;
  });
}

}  // namespace seam
