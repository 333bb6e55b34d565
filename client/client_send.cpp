/// Client: sends to the server, no faster than the path carries.

#include <algorithm>
#include <utility>

#include "client/client.h"
#include "client/goodbye.h"

namespace seam {

bool Client::LineReady(std::int64_t now_us) {
  if (link_ == nullptr) return false;
  credit_.Fill(now_us, link_->rate().bytes_per_s());
  return credit_.Ready();
}

/// States that the path cannot carry now wait for the next tick in which it can, unless newer ones
/// follow: on a thin line those ticks may never be ticks of a send.
void Client::SendStates(std::int64_t now_us) {
  for (const std::int64_t number : link_->TakeAckedNumbers()) packer_->Acknowledge(number);
  for (const States& states : replica_->TakeStates()) packer_->Add(states);
  if (!packer_->empty()) unsent_.clear();
  for (const StatesPacker::Message& message : packer_->Take(now_us)) {
    unsent_.emplace_back(message.number, Encode(message.packed));
    offered_bytes_ += static_cast<double>(unsent_.back().second.size());
  }
  if (!line_ready_) return;
  for (const auto& [number, bytes] : std::exchange(unsent_, {})) {
    link_->SendUnreliable(bytes, {{kListedSlot, number}});
  }
}

std::int16_t Client::LineLoad(std::int64_t now_us) {
  constexpr std::int64_t kLineUs = 2000000;
  if (offered_us_ < 0) offered_us_ = now_us;
  if (now_us - offered_us_ < kLineUs) return line_permille_;
  const double passed_s = static_cast<double>(now_us - offered_us_) * 1e-6;
  const double load = offered_bytes_ / (link_->rate().bytes_per_s() * passed_s);
  line_permille_ = link_->rate().full() ? static_cast<std::int16_t>(std::min(30000.0, 1000 * load))
                                        : std::int16_t{-1};
  offered_bytes_ = 0;
  offered_us_ = now_us;
  return line_permille_;
}

void Client::SendInputs(std::int64_t now_us) {
  if (player_ < 0 || policy_->IsOracle() || Quiet() || !line_ready_) return;
  const InputTrack& track = replica_->inputs(player_);
  const std::int64_t acked = link_->acked(player_);
  // Where edits wait for all players' inputs, an otherwise silent client must not delay them.
  const bool due = replica_->tick() % std::max(1, room_.tick_hz / room_.send_hz) == 0;
  const bool rides = link_->Sends(now_us) || (due && EditsWait());
  const int count = policy_->InputsOnly()
                        ? feed_.TakeAll(track, acked, now_us)
                        : feed_.Take(track, acked, replica_->tick(), now_us, rides);
  if (count == 0) return;
  InputsPacker packer;
  packer.Add(track.Export(player_, count));
  link_->SendUnreliable(Encode(packer.Finish()), {{player_, track.newest()}});
}

void Client::Flush(std::int64_t now_us) {
  // Before the server has a session for us, it ignores datagrams of a link.
  if (link_->last_receive_us() < 0) return;
  const auto send = [&](ByteView datagram) {
    stats_.bytes_out += static_cast<std::int64_t>(datagram.size);
    stats_.datagrams_out += 1;
    credit_.Spend(datagram.size);
    net_.Send(at_, datagram);
  };
  link_->Flush(now_us, send, static_cast<std::size_t>(std::max(0.0, credit_.bytes())));
}

void Client::PublishUnmoved() {
  if (publisher_ != nullptr) publisher_->PublishUnmoved();
}

void Client::Shutdown(std::int64_t now_us) {
  PublishUnmoved();
  if (link_ == nullptr || closed_) return;
  SayGoodbye(now_us, link_.get(), [&] { Flush(now_us); });
  net_.Flush();
}

}  // namespace seam
