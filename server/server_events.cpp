/// Server: what it tells of its clock, its bounds and its end, and the sum of the session.

#include <utility>
#include <variant>

#include "server/chronicle.h"
#include "server/rules/rules.h"
#include "server/server.h"
#include "server/server_commands.h"

namespace seam {

void Server::WatchClock(std::int64_t now_us) {
  if (!clock_.Note(now_us, replica_.tick())) return;
  const std::string percent = std::to_string(clock_.speed_ppm() / 10000);
  Event event =
      MakeEvent(EventKind::kSpeed,
                clock_.speed_ppm() == kFullSpeedPpm
                    ? "the room runs at full speed again"
                    : (input_room_ != nullptr ? "inputs come late: the room runs at "
                                              : "the server cannot keep up: the room runs at ") +
                          percent + " % of its speed");
  event.value_milli = clock_.speed_ppm() / 1000;
  chronicle_->Say(now_us, event);
}

Summary Server::Sum(std::int64_t now_us, Ended ended) const {
  return chronicle_->Sum(now_us, ended, ladder_, rules_.get());
}

void Server::RemoveOutside(std::int64_t now_us) {
  const std::vector<Edit> edits = bounds_.Next(filter_.TakeOutside());
  for (const Edit& edit : edits) edits_->Add(edit);
  if (edits.empty()) return;
  const PartId first = edits.front().As<RemoveEdit>()->part;
  std::string what = replica_.world().scene().parts[static_cast<std::size_t>(first)].name;
  if (edits.size() > 1) what += " and " + std::to_string(edits.size() - 1) + " more";
  Event event = MakeEvent(EventKind::kOutOfBounds, "out of bounds: " + what);
  event.body = first;
  event.value_milli = 1000 * static_cast<std::int64_t>(edits.size());
  chronicle_->Say(now_us, event);
}

void Server::End(std::int64_t now_us, const std::string& reason) {
  chronicle_->Say(now_us, MakeEvent(EventKind::kEnded, "the room ends: " + reason));
  if (started()) chronicle_->Publish(now_us, Sum(now_us, Ended::kEnded));
  broadcast_.EndTick(now_us, false, true);
}

void Server::Shutdown(std::int64_t now_us, const std::string& reason) {
  if (!std::exchange(over_, true)) End(now_us, reason);
  sessions_.Close(now_us, reason, &stats_.counters);
}

void Server::NameStandby(std::int64_t now_us, const std::string& address) {
  if (over_ || address.empty() || address == standby_.address) return;
  standby_.utime = now_us;
  standby_.address = address;
  standby_.room = config_.room;
  standby_.epoch = epoch_;  // the room's own: they stay
  sessions_.SendToAll(Encode(standby_));
}

void Server::RedirectAll(std::int64_t now_us, const Redirect& redirect) {
  if (!std::exchange(over_, true)) End(now_us, "it goes on at " + redirect.address);
  Redirect now = redirect;
  now.utime = now_us;
  sessions_.RedirectAll(now);
}

void Server::Forsake(std::int64_t now_us) {
  if (!std::exchange(over_, true)) End(now_us, "it goes on at another server");
  sessions_.Forsake();
}

void Server::AnswerOnly(std::int64_t now_us) {
  Address from;
  Bytes datagram;
  for (int n = 0; n < kDatagramsMax && net_.Receive(&from, &datagram); ++n) {
    sessions_.Receive(now_us, from, datagram, [&](Session& session, ByteView message) {
      if (std::holds_alternative<Bye>(Decode(message))) sessions_.Leave(session, "left");
    });
  }
  sessions_.DropSilent(now_us);
  sessions_.TakeEvents();
  sessions_.Flush(now_us, &stats_.counters);
}

std::vector<std::string> Server::TakeWarnings() {
  return commands_ == nullptr ? std::vector<std::string>{} : commands_->TakeWarnings();
}

bool Server::script_stopped() const { return rules_ != nullptr && rules_->stopped(); }

}  // namespace seam
