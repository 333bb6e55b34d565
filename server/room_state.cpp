#include "server/room_state.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <variant>

#include "common/base/state_archive.h"
#include "common/codec/persist_message.h"
#include "common/sync/edits/topology_snapshot.h"
#include "common/sync/metadata.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/authority_source.h"
#include "server/edits/edit_log.h"
#include "server/room_clock.h"
#include "server/rules/bounds_watch.h"
#include "server/rules/rules.h"
#include "server/rules/seats.h"
#include "server/sessions/session_table.h"
#include "server/trust/trust_ladder.h"

namespace seam {
namespace {

/// The bytes begin with this, the version and a hash of all that follows.
constexpr char kRoomMagic[8] = {'S', 'E', 'A', 'M', 'R', 'O', 'O', 'M'};
struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t unused;
  std::uint64_t hash;
};

/// Most edits of a room; numbers of edits go on from there.
constexpr int kRevisionMost = 1 << 30;

Status NotReadable(const std::string& why) {
  return Status::Error("this is no saved room: " + why);
}

template <class Message>
std::vector<Message> Stamped(std::int64_t now_us, std::vector<Message> messages) {
  for (Message& message : messages) message.utime = now_us;
  return messages;
}

/// Most bytes of a message: a Room has the scene's text.
constexpr std::size_t kSavedMessageMost = kBusMessageBytesMax + kSceneTextBytesMax;

}  // namespace

std::vector<Snapshot> RoomState::Edits(std::int64_t now_us) const {
  return parts_.edits.History(now_us);
}

std::vector<Grants> RoomState::Authority(std::int64_t now_us) const {
  return parts_.authority.Export(now_us);
}

std::vector<States> RoomState::Bodies(std::int64_t now_us) const {
  if (!parts_.clock.started()) return {};
  return Stamped(now_us, parts_.replica.Everything());
}

std::vector<Rest> RoomState::Resting(std::int64_t now_us) const {
  if (!parts_.clock.started()) return {};
  return Stamped(now_us, std::as_const(parts_.replica).rest().Everything());
}

std::vector<Meta> RoomState::Metadata(std::int64_t now_us) const {
  std::vector<Meta> all = parts_.settings.Export(now_us, parts_.replica.tick());
  if (parts_.rules == nullptr) return all;
  for (Meta& meta : parts_.rules->metadata().Export(now_us, parts_.replica.tick())) {
    all.push_back(std::move(meta));
  }
  return all;
}

StateDraft RoomState::Copy(std::int64_t now_us, std::size_t expected_bytes) {
  StateArchive a;
  a.Reserve(expected_bytes);
  std::uint64_t header = 0;
  for (std::size_t i = 0; i < sizeof(Header) / sizeof header; ++i) a.Word(&header);
  a.Section("room");
  Room settings = parts_.room;
  settings.session = 0;  // the server that loads the room begins a session of its own
  PersistMessage(a, &settings, kSavedMessageMost);
  std::int32_t epoch = parts_.epoch;
  a.Int(&epoch, 1, INT32_MAX);
  std::vector<Snapshot> edits = Edits(0);
  a.List(&edits, StateArchive::kListMost,
         [&](Snapshot* part) { PersistMessage(a, part, kSavedMessageMost); });
  std::vector<int> present;
  Persist(a, now_us, &present);
  return a.TakeDraft();
}

Bytes RoomState::Finish(StateDraft copy) {
  Bytes all = copy.Finish();
  Header header{};
  std::memcpy(header.magic, kRoomMagic, sizeof kRoomMagic);
  header.version = kRoomStateVersion;
  header.hash = Fnv1a(all.data() + sizeof header, all.size() - sizeof header);
  std::memcpy(all.data(), &header, sizeof header);
  return all;
}

Bytes RoomState::Save(std::int64_t now_us) { return Finish(Copy(now_us, 0)); }

std::unique_ptr<const SavedRoom> SavedRoom::Read(ByteView bytes, Status* status) {
  const auto fail = [status](const std::string& why) {
    *status = NotReadable(why);
    return nullptr;
  };
  Header header{};
  if (bytes.size < sizeof header) return fail("it is too short");
  std::memcpy(&header, bytes.data, sizeof header);
  if (std::memcmp(header.magic, kRoomMagic, sizeof kRoomMagic) != 0)
    return fail("it begins otherwise");
  if (header.version != kRoomStateVersion) {
    return fail("it is of version " + std::to_string(header.version) + ", this server reads " +
                std::to_string(kRoomStateVersion));
  }
  const ByteView rest(bytes.data + sizeof header, bytes.size - sizeof header);
  if (header.unused != 0 || header.hash != Fnv1a(rest.data, rest.size)) {
    return fail("it is damaged");
  }
  StateArchive a(rest);
  a.Section("room");
  Room room;
  PersistMessage(a, &room, kSavedMessageMost);
  std::int32_t epoch = 1;
  a.Int(&epoch, 1, INT32_MAX);
  std::vector<TopologyEntry> entries;
  std::vector<Snapshot> edits;
  a.List(&edits, StateArchive::kListMost, [&](Snapshot* part) {
    PersistMessage(a, part, kSavedMessageMost);
    if (!a.ok()) return;
    const Status read = ReadEntries(*part, &entries);
    if (!read.ok()) a.Fail(read.why());
  });
  a.Require(edits.empty() || edits.front().number <= kRevisionMost, "there were too many edits");
  if (!a.ok()) return fail(a.status().why());
  Scene scene;
  try {
    scene = ParseScene(room.scene_text, room.scene_name + ".toml");
  } catch (const OperatorError& error) {
    return fail(error.what());
  }
  std::unique_ptr<SavedRoom> saved(new SavedRoom(room, scene));
  saved->epoch_ = epoch;
  if (!edits.empty()) {
    const Status made = TopologyFold::FromEntries(saved->scene_, entries, edits.front().number,
                                                  &saved->fold_, &saved->topology_);
    if (!made.ok()) return fail("its edits cannot be: " + made.why());
  }
  saved->parts_.assign(rest.end() - static_cast<std::ptrdiff_t>(a.left()), rest.end());
  return saved;
}

Status RoomState::Load(const SavedRoom& saved, std::int64_t now_us, std::vector<int>* gone) {
  const Room &was = saved.room(), &is = parts_.room;
  const bool same = was.mode == is.mode && was.reconcile == is.reconcile &&
                    was.predict == is.predict && was.tick_hz == is.tick_hz &&
                    was.send_hz == is.send_hz && was.input_delay_ticks == is.input_delay_ticks &&
                    was.scene_text == is.scene_text && was.seed == is.seed;
  if (!same) return Status::Error("the room was saved with other settings or another scene");
  parts_.edits.GoOnFrom(saved.fold());
  StateArchive a(saved.parts());
  Persist(a, now_us, gone);
  if (a.ok() && a.left() > 0) a.Fail("there is more than the room");
  return a.ok() ? Status::Ok() : NotReadable(a.status().why());
}

void RoomState::Persist(StateArchive& a, std::int64_t now_us, std::vector<int>* present) {
  const World& world = parts_.replica.world();
  const auto players = static_cast<std::int64_t>(world.scene().players.size());
  a.Section("clock");
  bool started = parts_.clock.started(), ruled = parts_.rules != nullptr;
  a.Flag(&started);
  for (int p = 0; !a.reading() && p < static_cast<int>(players); ++p) {
    if (parts_.sessions.PeerOfPlayer()[static_cast<std::size_t>(p)] >= 0) present->push_back(p);
  }
  a.List(present, static_cast<std::size_t>(players),
         [&](int* player) { a.Int(player, 0, players - 1); });
  parts_.replica.Persist(a, Replica::Past::kAll);
  if (!a.ok()) return;
  parts_.authority.Persist(a);
  parts_.edits.Persist(a);
  parts_.seats.Persist(a, world);
  parts_.bounds.Persist(a);
  parts_.ladder.Persist(a);
  parts_.sessions.places().Persist(a, now_us);
  parts_.settings.Persist(a);
  a.Flag(&ruled);
  a.Require(ruled == (parts_.rules != nullptr), "it has other rules");
  if (parts_.rules != nullptr && a.ok()) {
    parts_.source->Persist(a);
    parts_.rules->Persist(a);
  }
  if (a.reading() && a.ok() && started) parts_.clock.GoOn(now_us, parts_.replica.tick());
}

}  // namespace seam
