#include "server/sessions/traffic_count.h"

#include <string>
#include <unordered_map>
#include <vector>

#include "common/codec/codec.h"
#include "common/codec/short_form.h"
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

/// Finds the kind of a message in its short form.
std::int8_t KindOf(ByteView bytes) {
  static const auto kinds = [] {
    std::vector<std::int8_t> by_type;
    for (const MessageType& type : MessageTypes()) by_type.push_back(KindOfType(type.name));
    return by_type;
  }();
  const int type = TypeOfShortForm(bytes);
  return type < 0 ? kTrafficOther : kinds[static_cast<std::size_t>(type)];
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
  const std::size_t kind = ours ? kTrafficJoining : kTrafficOther;
  (out ? out_ : in_)[kind] += static_cast<std::int64_t>(datagram.size);
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
