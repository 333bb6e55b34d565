#include "server/sessions/traffic_count.h"

#include <string>
#include <unordered_map>

#include "common/codec/codec.h"
#include "common/net/loose_datagram.h"

namespace seam {
namespace {

std::int8_t KindOfType(const std::string& name) {
  static const std::unordered_map<std::string, std::int8_t> kinds = {
      {"states_t", kTrafficStates},       {"packed_states_t", kTrafficStates},
      {"reset_t", kTrafficStates},        {"differing_t", kTrafficStates},
      {"inputs_t", kTrafficInputs},       {"packed_inputs_t", kTrafficInputs},
      {"rest_t", kTrafficRest},           {"grants_t", kTrafficGrants},
      {"release_t", kTrafficHandOver},    {"exact_states_t", kTrafficHandOver},
      {"edit_t", kTrafficEdits},          {"snapshot_t", kTrafficJoining},
      {"hello_t", kTrafficJoining},       {"challenge_t", kTrafficJoining},
      {"join_t", kTrafficJoining},        {"welcome_t", kTrafficJoining},
      {"chunk_t", kTrafficJoining},       {"ready_t", kTrafficJoining},
      {"bye_t", kTrafficJoining},         {"ping_t", kTrafficClock},
      {"pong_t", kTrafficClock},          {"meta_t", kTrafficRules},
      {"impact_report_t", kTrafficRules}, {"touch_report_t", kTrafficRules}};
  const auto found = kinds.find(name);
  return found == kinds.end() ? kTrafficOther : found->second;
}

/// Finds the kind by the type's hash, with which a message begins.
std::int8_t KindOf(ByteView message) {
  static const auto kinds = [] {
    std::unordered_map<std::uint64_t, std::int8_t> by_hash;
    for (const MessageType& type : MessageTypes()) by_hash[type.hash] = KindOfType(type.name);
    return by_hash;
  }();
  if (message.size < 8) return kTrafficOther;
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < 8; ++i) hash = hash << 8 | message.data[i];
  const auto found = kinds.find(hash);
  return found == kinds.end() ? kTrafficOther : found->second;
}

}  // namespace

void TrafficCount::AddPlain(ByteView plain, bool out) {
  auto& counts = out ? out_ : in_;
  messages_.clear();
  const std::size_t bytes = plain.size + Seal::kTagBytes;
  if (!ReadMessages(plain, &messages_)) {
    counts[kTrafficOther] += static_cast<std::int64_t>(bytes);
    return;
  }
  std::size_t framing = bytes;
  for (const DatagramMessage& message : messages_) {
    framing -= message.bytes.size;
    counts[static_cast<std::size_t>(KindOf(message.bytes))] +=
        static_cast<std::int64_t>(message.bytes.size);
  }
  counts[kTrafficFraming] += static_cast<std::int64_t>(framing);
}

void TrafficCount::AddLoose(ByteView datagram, bool out) {
  const bool ours = LooseNumber(datagram) != 0;
  const std::int8_t kind = ours ? KindOf(LooseMessage(datagram)) : std::int8_t{kTrafficOther};
  (out ? out_ : in_)[static_cast<std::size_t>(kind)] += static_cast<std::int64_t>(datagram.size);
}

void TrafficCount::Write(Load* load) const {
  for (std::size_t kind = 0; kind < kTrafficKinds; ++kind) {
    if (out_[kind] == 0 && in_[kind] == 0) continue;
    load->kind.push_back(static_cast<std::int8_t>(kind));
    load->bytes_out.push_back(out_[kind]);
    load->bytes_in.push_back(in_[kind]);
  }
}

}  // namespace seam
