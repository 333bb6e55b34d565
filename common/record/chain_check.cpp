#include "common/record/chain_check.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <variant>

#include "common/net/crc32c.h"
#include "common/record/log_bytes.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// Adds a range; one that goes on where the last one ends becomes part of it.
void AddRange(std::int64_t after_tick, std::int64_t tick, bool forged,
              const std::set<std::string>& channels, std::vector<DamagedRange>* all) {
  const std::int64_t first = std::max<std::int64_t>(0, std::min(after_tick + 1, tick));
  if (!all->empty() && !all->back().missing && first >= all->back().first_tick &&
      first <= all->back().last_tick + 1) {
    DamagedRange& last = all->back();
    last.last_tick = std::max(last.last_tick, tick);
    last.forged = last.forged && forged;
    last.channels.insert(channels.begin(), channels.end());
    return;
  }
  all->push_back({first, std::max(first, tick), false, forged, false, channels});
}

/// True for a message that its publisher repeats, which is in no seal.
bool IsSaidAgain(const LogEvent& event) {
  if (event.channel.find(std::string(".") + MessageTraits<Room>::kKind) == std::string::npos)
    return false;
  const AnyMessage any = Decode(event.data);
  if (const auto* room = std::get_if<Room>(&any)) return room->sequence == kSaidAgain;
  const auto* part = std::get_if<ScenePart>(&any);
  return part != nullptr && part->sequence == kSaidAgain;
}

}  // namespace

std::int32_t ChainedCrc(std::int32_t crc, const std::string& channel, ByteView message) {
  const auto seed = static_cast<std::uint32_t>(crc);
  return static_cast<std::int32_t>(Crc32c(message, Crc32c(TextBytes(channel), seed)));
}

struct ChainCheck::Seal {
  std::int64_t session;
  int peer;
  std::int64_t tick, first_tick;
  std::int32_t messages, messages_crc, log_events, log_crc;
  Bytes keyed;
};

ChainCheck::ChainCheck(const LogPlace& from, const Secret* key)
    : crc_(from.crc), first_(from.bytes == 0 && from.segment == 0) {
  if (key != nullptr) key_ = *key, keyed_.emplace(*key, from.keyed);
}

std::optional<ChainCheck::Seal> ChainCheck::SealOf(const AnyMessage& message) {
  const auto read = [](const auto& m, std::size_t ticks, const Bytes& keyed) {
    const std::int64_t before = ticks > 0 ? static_cast<std::int64_t>(ticks) - 1 : 0;
    const std::int64_t first = m.messages < 0 ? m.tick + 1 : m.tick - before;  // -1: of no tick
    return Seal{m.session,      m.peer,       m.tick,    first, m.messages,
                m.messages_crc, m.log_events, m.log_crc, keyed};
  };
  if (const auto* seal = std::get_if<LogSeal>(&message)) {
    return read(*seal, TicksOf(*seal)->size(), seal->log_keyed);
  }
  if (const auto* chain = std::get_if<TickChain>(&message)) return read(*chain, 1, {});
  return std::nullopt;
}

void ChainCheck::Note(ByteView header, const LogEvent& event) {
  const std::string room = RoomOfChannel(event.channel);
  std::optional<Seal> seal;
  if (event.channel.find(".chain") != std::string::npos) seal = SealOf(Decode(event.data));
  if (seal && seal->messages >= 0) CheckMessages({room, seal->session, seal->peer}, *seal);
  if (seal && seal->log_events > 0) return CheckBytes(header, event, *seal);
  first_ = false;
  for (std::uint32_t* crc : {&crc_, &own_crc_}) {
    *crc = Crc32c(event.data, Crc32c(TextBytes(event.channel), Crc32c(header, *crc)));
  }
  if (keyed_) AddEvent(header, event, 0, &*keyed_);
  ++events_;
  channels_.insert(event.channel);
  if (seal || room.empty() || IsSaidAgain(event)) return;
  const int peer = PublisherOfChannel(event.channel);
  Heard& heard = heard_[{room, SessionOf(event.data).value_or(0), peer}];
  ++heard.messages;
  heard.crc = ChainedCrc(heard.crc, event.channel, event.data);
  heard.channels.insert(event.channel);
}

/// Checks the messages of a publisher, unless some are missing (they are gaps in its numbers) or
/// came twice.
void ChainCheck::CheckMessages(const Publisher& publisher, const Seal& seal) {
  Heard& heard = heard_[publisher];
  if (heard.messages == seal.messages && heard.crc != seal.messages_crc) {
    AddRange(heard.tick, seal.tick, false, heard.channels, &messages_damage_);
  }
  heard = Heard();
  heard.tick = seal.tick;
}

void ChainCheck::AddEvent(ByteView header, const LogEvent& event, std::size_t without,
                          KeyedChain* chain) {
  chain->Add(header);
  chain->Add(TextBytes(event.channel));
  chain->Add({event.data.data(), event.data.size() - without});
}

bool ChainCheck::KeyedAsWritten(ByteView header, const LogEvent& event, const Seal& seal) {
  if (!keyed_) return true;
  KeyedChain::Hash told{};
  const bool there = seal.keyed.size() == told.size();
  if (there) {
    std::memcpy(told.data(), seal.keyed.data(), told.size());
    AddEvent(header, event, kSealKeyedBytes, &*keyed_);
  }
  const bool same = there && keyed_->Is(told);
  keyed_.emplace(*key_, told);
  return same;
}

void ChainCheck::CheckBytes(ByteView header, const LogEvent& event, const Seal& seal) {
  const ByteView data(event.data.data(), event.data.size() - kSealCrcBytes);
  const auto with = [&](std::uint32_t crc) {
    return Crc32c(data, Crc32c(TextBytes(event.channel), Crc32c(header, crc)));
  };
  const auto written = static_cast<std::uint32_t>(seal.log_crc);
  const bool same = with(crc_) == written || with(own_crc_) == written;
  // A later segment's first event is a seal, which goes on from the segment before; the numbers do
  // too. In a capture of a stock logger they begin anew.
  const bool begins = first_ && !skipped_ && !same && seal.log_events == 1 && event.number > 0;
  if (begins) begins_after_ = seal.tick;
  first_ = false;
  const bool good = begins || (same && !skipped_ && events_ + 1 == seal.log_events);
  const bool keyed = KeyedAsWritten(header, event, seal) || begins;
  // In a log of another logger none is: it has numbers of its own, and a filter leaves out messages
  // of ticks.
  sealed_ = sealed_ || (good && seal.tick > 0);
  channels_.insert(event.channel);
  if (good && keyed) {
    CloseDamage(seal.first_tick - 1);
    NoteHole(seal);
    tick_ = seal.tick;
  } else {  // its tick may be what is damaged: the next good one says where the damage ended
    forged_ = forged_ && good;
    damaged_ = true;
    damaged_channels_.insert(channels_.begin(), channels_.end());
  }
  crc_ = written;
  own_crc_ = 0;
  events_ = 0;
  skipped_ = false;
  channels_.clear();
}

void ChainCheck::NoteHole(const Seal& seal) {
  if (seal.peer != 0) return;
  // One of no tick names the last sealed tick, which may be another peer's; 0 before the first.
  if (seal.messages < 0 &&
      (seal.tick == 0 || (server_session_ == seal.session && seal.tick <= server_tick_))) {
    return;
  }
  const std::int64_t next = server_tick_ + 1;
  if (next > 0 && server_session_ == seal.session && seal.messages >= 0 && seal.first_tick > next) {
    bytes_damage_.push_back({next, seal.first_tick - 1, false, false, true, {}});
  }
  server_tick_ = seal.tick;
  server_session_ = seal.session;
}

void ChainCheck::CloseDamage(std::int64_t last_tick) {
  if (!damaged_) return;
  AddRange(tick_, std::max(tick_ + 1, last_tick), forged_, damaged_channels_, &bytes_damage_);
  damaged_ = false;
  server_tick_ = -1;  // it may have ended ticks in there
  forged_ = true;
  damaged_channels_.clear();
}

std::vector<DamagedRange> ChainCheck::Damage() const {
  if (!sealed_ && !keyed_) return messages_damage_;
  std::vector<DamagedRange> all = bytes_damage_;
  if (damaged_ || events_ > 0 || skipped_) {
    std::set<std::string> channels = damaged_channels_;
    channels.insert(channels_.begin(), channels_.end());
    AddRange(tick_, tick_ + 1, damaged_ && forged_, channels, &all);
    all.back().to_the_end = true;
  }
  return all;
}

}  // namespace seam
