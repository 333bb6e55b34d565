#include "common/record/recording.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <variant>

#include "common/codec/codec.h"

namespace seam {
namespace {

/// Most channels with tracked sequence numbers; a session has about 4 per peer.
constexpr std::size_t kChannelsMax = 16384;
/// Longest pause of a session, ticks: views farther apart do not belong together. Without this
/// limit, one damaged tick number would make a session of thousands of years.
constexpr std::int64_t kTickPauseMax = 100000;

bool SameSession(const Room& a, const Room& b) {
  const auto tie = [](const Room& r) {
    return std::tie(r.protocol, r.scene_name, r.scene_text, r.mode, r.reconcile, r.predict,
                    r.impair, r.seed, r.tick_hz, r.send_hz, r.input_delay_ticks);
  };
  return tie(a) == tie(b);
}

template <class T>
bool TickLess(const T& a, const T& b) {
  return a.tick < b.tick;
}

template <class T>
bool AppendByTick(std::vector<T>* to, T& message) {
  const bool in_order = to->empty() || !TickLess(message, to->back());
  to->push_back(std::move(message));
  return in_order;
}

}  // namespace

bool RecordingBuilder::Add(const std::string& channel, ByteView message, std::int64_t heard_us) {
  heard_us_ = heard_us;
  ++recording_.events_read;
  const std::string room = RoomOfChannel(channel);
  const bool other_room = room.empty() || (!wanted_room_.empty() && room != wanted_room_);
  if (other_room || (!follows_newest_ && SessionOf(message).value_or(*session_) != *session_)) {
    ++recording_.foreign;
    return false;
  }
  AnyMessage any = Decode(message);
  return std::visit(
      [&](auto& m) {
        using M = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<M, std::monostate>) {
          ++recording_.undecodable;
          const std::int32_t protocol = OldRoomProtocol(message);
          if (protocol != 0) recording_.foreign_protocol = protocol;
          return false;
        } else if constexpr (MessageTraits<M>::kTravels == Travels::kEdge) {
          ++recording_.foreign;  // a message of the edge does not belong on the bus
          return false;
        } else {
          if (wanted_room_.empty()) wanted_room_ = room;
          if (!IsOfSession(m)) {
            ++recording_.foreign;
            return false;
          }
          const bool again = m.sequence == kSaidAgain;
          return (again || !IsDuplicate(channel, m.sequence, message)) && Keep(m);
        }
      },
      any);
}

/// Follows the newest session, if asked to: a session begins with its Room.
template <class Message>
bool RecordingBuilder::IsOfSession(const Message& message) {
  if (!session_) session_ = message.session;
  if (message.session == *session_) return true;
  constexpr bool begins = std::is_same_v<Message, Room>;
  if (!begins || !follows_newest_ || ended_.count(message.session) != 0) return false;
  ended_.insert(*session_);
  session_ = message.session;
  Recording next;
  next.events_read = recording_.events_read;
  next.foreign = recording_.foreign;
  next.undecodable = recording_.undecodable;
  recording_ = std::move(next);
  has_room_ = false;
  scene_parts_ = SceneParts();
  sorted_ = true;
  heard_.clear();
  partial_.clear();
  return true;
}

void RecordingBuilder::CountGaps(const std::string& channel, std::int64_t more) {
  if (more == 0) return;
  recording_.bus_gaps += more;
  if ((recording_.gaps[channel] += more) == 0) recording_.gaps.erase(channel);
}

bool RecordingBuilder::IsDuplicate(const std::string& channel, std::int64_t sequence,
                                   ByteView message) {
  if (heard_.size() >= kChannelsMax && heard_.count(channel) == 0) return false;
  Heard& heard = heard_[channel];
  std::uint64_t& hash = heard.hashes[static_cast<std::size_t>(sequence) % 64];
  const std::uint64_t hash_before = hash;
  hash = Fnv1a(message.data, message.size);
  const std::int64_t ahead = sequence - heard.highest;
  // The first, or a publisher that was restarted.
  if (heard.highest < 0 || ahead <= -64 || ahead >= kNumbersAheadMax) {
    heard.first = heard.highest = sequence;
    heard.mask = 1;
    return false;
  }
  if (ahead > 0) {
    CountGaps(channel, ahead - 1);
    heard.highest = sequence;
    heard.mask = ahead < 64 ? heard.mask << ahead | 1 : 1;
    return false;
  }
  const std::uint64_t bit = std::uint64_t{1} << -ahead;
  if ((heard.mask & bit) != 0) {
    if (hash != hash_before) return false;  // another message of that number: a restart
    ++recording_.duplicates;
    return true;
  }
  heard.mask |= bit;  // late: counted as missing before, unless it precedes the first
  CountGaps(channel, sequence > heard.first ? -1 : heard.first - sequence - 1);
  heard.first = std::min<std::int64_t>(heard.first, sequence);
  return false;
}

bool RecordingBuilder::Keep(Room& room) {
  if (room.protocol < kOldestReadableProtocol || room.protocol > kProtocolVersion) {
    recording_.foreign_protocol = room.protocol;
    ++recording_.foreign;
    return false;
  }
  if (has_room_ && room.scene_text.empty()) room.scene_text = recording_.room.scene_text;
  const bool other = has_room_ && !SameSession(room, recording_.room);
  // Older recordings have no number that tells a server from the one before it.
  const bool restarted = has_room_ && room.sequence < room_sequence_;
  if (room.session == 0 && (other || restarted)) recording_.mixed = true;
  if (other) {
    ++recording_.foreign;
    return false;
  }
  room_sequence_ = std::max(room_sequence_, room.sequence);
  if (!has_room_) recording_.room = std::move(room);
  has_room_ = true;
  AddScene();
  return true;
}

bool RecordingBuilder::Keep(ScenePart& part) {
  if (!scene_parts_.Take(part)) {
    ++recording_.undecodable;
    return false;
  }
  AddScene();
  return true;
}

/// Adds a scene that came in parts to its Room, whichever came first.
void RecordingBuilder::AddScene() {
  if (has_room_ && scene_parts_.whole() && recording_.room.scene_text.empty()) {
    recording_.room.scene_text = scene_parts_.TakeText();
  }
}

bool RecordingBuilder::Keep(Inputs& inputs) {
  Inputs& kept = recording_.inputs[inputs.player][inputs.first_tick];
  if (inputs.drive.size() > kept.drive.size()) kept = std::move(inputs);
  return true;
}

bool RecordingBuilder::Keep(States& states) {
  recording_.states.push_back(std::move(states));
  return true;
}

bool RecordingBuilder::Keep(Grants& grants) {
  recording_.grants.push_back(std::move(grants));
  return true;
}

bool RecordingBuilder::Keep(EditOrder& edit) {
  if (edit.number >= 0) recording_.edits.try_emplace(edit.number, std::move(edit));
  return true;
}

bool RecordingBuilder::Keep(Meta& meta) {
  recording_.meta.push_back(std::move(meta));
  return true;
}

bool RecordingBuilder::Keep(Strands& strands) {
  recording_.strands[strands.peer][strands.tick] = std::move(strands);
  return true;
}

bool RecordingBuilder::Keep(Impacts& impacts) {
  sorted_ = AppendByTick(&recording_.impacts, impacts) && sorted_;
  return true;
}

bool RecordingBuilder::Keep(Stats& stats) {
  sorted_ = AppendByTick(&recording_.stats[stats.peer], stats) && sorted_;
  return true;
}

bool RecordingBuilder::Keep(Load& load) {
  sorted_ = AppendByTick(&recording_.loads, load) && sorted_;
  return true;
}

bool RecordingBuilder::Keep(Event& event) {
  sorted_ = AppendByTick(&recording_.events, event) && sorted_;
  return true;
}

bool RecordingBuilder::Keep(Summary& summary) {
  recording_.summaries.push_back(std::move(summary));
  return true;
}

bool RecordingBuilder::Keep(Audit& audit) {
  sorted_ = AppendByTick(&recording_.audits, audit) && sorted_;
  return true;
}

bool RecordingBuilder::Keep(Divergence& divergence) {
  sorted_ = AppendByTick(&recording_.divergences, divergence) && sorted_;
  return true;
}

Recording& RecordingBuilder::recording() {
  if (!sorted_) {
    const auto sort = [](auto& v) {
      using T = typename std::decay_t<decltype(v)>::value_type;
      std::stable_sort(v.begin(), v.end(), TickLess<T>);
    };
    sort(recording_.impacts);
    sort(recording_.events);
    for (auto& [peer, stats] : recording_.stats) sort(stats);
    sort(recording_.loads);
    sorted_ = true;
  }
  if (recording_.last_tick - recording_.first_tick > kTickPauseMax) DropStrayTicks();
  return recording_;
}

/// Keeps the longest run of ticks without a pause over kTickPauseMax.
void RecordingBuilder::DropStrayTicks() {
  std::vector<std::int64_t> ticks;
  for (const auto& [peer, views] : recording_.views) {
    for (const auto& [tick, view] : views) ticks.push_back(tick);
  }
  std::sort(ticks.begin(), ticks.end());
  std::size_t best = 0, best_size = 0;
  for (std::size_t begin = 0, end = 0; begin < ticks.size(); begin = end) {
    end = begin + 1;
    while (end < ticks.size() && ticks[end] - ticks[end - 1] <= kTickPauseMax) ++end;
    if (end - begin > best_size) {
      best = begin;
      best_size = end - begin;
    }
  }
  recording_.first_tick = ticks[best];
  recording_.last_tick = ticks[best + best_size - 1];
  recording_.undecodable += static_cast<std::int64_t>(ticks.size() - best_size);
  for (auto& [peer, views] : recording_.views) {
    views.erase(views.begin(), views.lower_bound(recording_.first_tick));
    views.erase(views.upper_bound(recording_.last_tick), views.end());
  }
}

void MemoryRecorder::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  builder.Add(channel, message, utime);
}

}  // namespace seam
