#include "common/sync/publisher.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "common/record/chain_check.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// A view that shows what the one before it does is published after so long.
constexpr std::int64_t kUnmovedUs = 1000000;

/// Bytes of a seal in a log, without channel and ticks.
constexpr std::size_t kSealBytes = kLogHeaderBytes + 58;

template <typename T>
std::vector<T> Slice(const std::vector<T>& v, std::size_t first, std::size_t last) {
  return std::vector<T>(v.begin() + static_cast<std::ptrdiff_t>(first),
                        v.begin() + static_cast<std::ptrdiff_t>(last));
}

bool ShowsTheSame(const View& a, const View& b) {
  const auto shown = [](const View& v) {
    return std::tie(v.revision, v.id, v.role, v.authority, v.x, v.y, v.angle, v.vx, v.vy, v.spin,
                    v.age);
  };
  return shown(a) == shown(b);
}

}  // namespace

template <class Message>
void Publisher::Number(Message& message) {
  using Traits = MessageTraits<Message>;
  static_assert(Traits::kTravels != Travels::kEdge);
  if (!recorder_.listening()) return;
  int whose = -1;
  if constexpr (Traits::kTravels == Travels::kBusPeer) whose = message.peer;
  if constexpr (Traits::kTravels == Travels::kBusPlayer) whose = message.player;
  const std::string channel = ChannelName(room_, Traits::kKind, whose);
  message.session = session_;
  message.sequence = static_cast<decltype(message.sequence)>(sequence_[channel]++);
  const Bytes bytes = Encode(message);
  ++seal_.messages;
  seal_.messages_crc = ChainedCrc(seal_.messages_crc, channel, bytes);
  bytes_ += kLogHeaderBytes + channel.size() + bytes.size();
  pending_ = true;
  recorder_.Publish(channel, message.utime, bytes);
}

void Publisher::NoteTick(std::uint64_t hash) {
  ticked_ = true;
  const std::int32_t before = std::exchange(before_step_, 0);
  const std::int32_t after = NewMessages() - before;
  ticks_.push_back({0, before, after, static_cast<std::uint16_t>(hash)});
  sealed_ += before + after;
}

void Publisher::EndTick(std::int64_t utime, int peer, std::int64_t tick, bool keep) {
  if (!recorder_.listening()) return;
  if (keep) PublishUnmoved();
  pending_ = false;
  // What came after the step is the last tick's; what came in a call without a step, the next
  // one's.
  if ((std::exchange(ticked_, false) || keep) && !ticks_.empty()) {
    ticks_.back().after += NewMessages();
    sealed_ += NewMessages();
  }
  const std::string channel = ChannelName(room_, MessageTraits<LogSeal>::kKind, peer);
  seal_.utime = utime;
  seal_.session = session_;
  seal_.sequence = static_cast<std::int32_t>(sequence_[channel]);
  seal_.peer = peer;
  seal_.tick = tick;
  seal_.ticks = PackTicks(ticks_);
  const std::size_t size = kSealBytes + channel.size() + seal_.ticks.size();
  const bool full = ++unkept_ == kSealTicksMax || bytes_ >= kSealShare * size;
  // A call of the server may step twice, and all ticks must fit a seal.
  const bool kept = keep || full || ticks_.size() + 2 > static_cast<std::size_t>(kSealTicksMax);
  recorder_.EndTick(channel, seal_, kept);
  if (!kept) return;
  ++sequence_[channel];
  seal_ = LogSeal();
  ticks_.clear();
  bytes_ = 0;
  sealed_ = before_step_ = 0;
  unkept_ = 0;
}

template <class Message>
void Publisher::Publish(Message message) {
  Number(message);
}

template <class Message>
void Publisher::Repeat(Message message) {
  static_assert(MessageTraits<Message>::kTravels == Travels::kBusRoom);
  if (!recorder_.listening()) return;
  message.session = session_;
  message.sequence = kSaidAgain;
  recorder_.Repeat(ChannelName(room_, MessageTraits<Message>::kKind), message.utime,
                   Encode(message));
}

template void Publisher::Repeat(Room);
template void Publisher::Repeat(ScenePart);
template void Publisher::Publish(Room);
template void Publisher::Publish(ScenePart);
template void Publisher::Publish(Inputs);
template void Publisher::Publish(States);
template void Publisher::Publish(Grants);
template void Publisher::Publish(Accepted);
template void Publisher::Publish(Audit);
template void Publisher::Publish(Divergence);
template void Publisher::Publish(EditOrder);
template void Publisher::Publish(Meta);
template void Publisher::Publish(Impacts);
template void Publisher::Publish(Strands);
template void Publisher::Publish(Stats);
template void Publisher::Publish(Load);
template void Publisher::Publish(Event);
template void Publisher::Publish(Summary);

void Publisher::Publish(const View& message) {
  if (!recorder_.listening()) return;
  const bool next = !shown_.id.empty() && message.tick == shown_.tick + unmoved_ + 1;
  if (!next) PublishUnmoved();
  if (next && ShowsTheSame(message, shown_) && message.utime - shown_.utime < kUnmovedUs &&
      unmoved_ < kViewUnmovedMax) {
    ++unmoved_;
    unmoved_us_ = message.utime;
    return;
  }
  View view = message;
  view.unmoved = static_cast<std::int16_t>(next ? unmoved_ : 0);
  PublishNow(view);
}

void Publisher::PublishUnmoved() {
  if (unmoved_ == 0) return;
  View view = shown_;
  view.utime = unmoved_us_;
  view.tick += unmoved_;
  view.unmoved = static_cast<std::int16_t>(unmoved_ - 1);
  PublishNow(view);
}

void Publisher::PublishNow(const View& view) {
  shown_ = view;
  unmoved_ = 0;
  const std::size_t count = view.id.size();
  const std::size_t parts = std::max<std::size_t>(1, (count + kViewBodiesMax - 1) / kViewBodiesMax);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t a = count * part / parts;
    const std::size_t b = count * (part + 1) / parts;
    View piece;
    piece.utime = view.utime;
    piece.peer = view.peer;
    piece.tick = view.tick;
    piece.revision = view.revision;
    piece.part = static_cast<std::int32_t>(part);
    piece.parts = static_cast<std::int32_t>(parts);
    piece.id = Slice(view.id, a, b);
    piece.role = Slice(view.role, a, b);
    piece.authority = Slice(view.authority, a, b);
    piece.x = Slice(view.x, a, b);
    piece.y = Slice(view.y, a, b);
    piece.angle = Slice(view.angle, a, b);
    piece.vx = Slice(view.vx, a, b);
    piece.vy = Slice(view.vy, a, b);
    piece.spin = Slice(view.spin, a, b);
    piece.age = Slice(view.age, a, b);
    piece.unmoved = view.unmoved;
    Number(piece);
  }
}

}  // namespace seam
