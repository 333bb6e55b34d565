#include "common/record/segments/keyframe.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "common/codec/codec.h"
#include "common/codec/message_limits.h"
#include "common/record/recorder.h"

namespace seam {
namespace {

/// Returns the kind in the name of a channel of this room.
std::string KindOf(const std::string& channel, const std::string& room) {
  const std::string rest = channel.substr(("SEAM." + room + ".").size());
  return rest.substr(0, rest.find('.'));
}

template <class Message>
bool Is(const std::string& kind) {
  return kind == MessageTraits<Message>::kKind;
}

}  // namespace

void Keyframe::Note(const std::string& channel, ByteView message) {
  const std::string room = RoomOfChannel(channel);
  if (room.empty() || PublisherOfChannel(channel) != 0) return;
  const std::string kind = KindOf(channel, room);
  const bool begins = Is<Room>(kind);
  const bool needed =
      begins || Is<Inputs>(kind) || Is<EditOrder>(kind) || Is<ScenePart>(kind) || Is<Meta>(kind);
  const std::int64_t session = needed ? SessionOf(message).value_or(0) : 0;
  if (session == 0) return;
  if (session_ == 0 || (begins && session != session_)) *this = Keyframe(), session_ = session;
  if (session != session_) return;
  Bytes bytes(message.begin(), message.end());
  if (begins || Is<Inputs>(kind)) {
    newest_[channel] = std::move(bytes);
  } else if (Is<Meta>(kind)) {
    NoteValues(channel, message);
  } else {
    kept_[channel].push_back(std::move(bytes));
  }
  if (!Is<ScenePart>(kind)) return;
  const AnyMessage any = Decode(message);
  const auto* part = std::get_if<ScenePart>(&any);
  std::deque<Bytes>& parts = kept_[channel];
  if (part != nullptr && parts.size() > static_cast<std::size_t>(part->parts)) parts.pop_front();
}

void Keyframe::NoteValues(const std::string& channel, ByteView message) {
  AnyMessage any = Decode(message);
  auto* meta = std::get_if<Meta>(&any);
  if (meta == nullptr) return;
  for (std::size_t i = 0; i < meta->value.size(); ++i) {
    values_[{meta->kind[i], meta->id[i], meta->key[i]}] = meta->value[i];
  }
  for (auto* list : {&meta->kind, &meta->key}) list->clear();
  meta->id.clear();
  meta->value.clear();
  values_channel_ = channel;
  newest_values_ = std::move(*meta);
}

void Keyframe::Each(const Visit& visit) const {
  for (const auto& [channel, message] : newest_) visit(channel, message);
  for (const auto& [channel, messages] : kept_) {
    for (const Bytes& message : messages) visit(channel, message);
  }
  EachOfValues(visit);
}

void Keyframe::EachOfValues(const Visit& visit) const {
  Meta meta = newest_values_;
  const auto messages = static_cast<std::int64_t>((values_.size() + kMetaMax - 1) / kMetaMax);
  meta.sequence -= messages - 1;
  for (auto next = values_.begin(); next != values_.end(); ++meta.sequence) {
    Meta part = meta;
    for (; next != values_.end() && part.value.size() < kMetaMax; ++next) {
      part.kind.push_back(static_cast<std::int8_t>(next->first[0]));
      part.id.push_back(next->first[1]);
      part.key.push_back(static_cast<std::int8_t>(next->first[2]));
      part.value.push_back(next->second);
    }
    visit(values_channel_, Encode(part));
  }
}

}  // namespace seam
