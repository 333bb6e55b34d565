#include "server/chronicle.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "server/broadcast.h"

namespace seam {
namespace {

/// Most events kept between two calls of TakeEvents: all that a minute may say.
constexpr std::size_t kKeptMax = 60 * Chronicle::kPerS * (kEventKindMax + 1);

std::int64_t Milli(double value) { return std::llround(std::clamp(value, -1e12, 1e12) * 1e3); }

}  // namespace

Event Chronicle::Say(std::int64_t now_us, Event event) {
  SEAM_ASSERT(event.kind >= 0 && event.kind <= kEventKindMax);
  event.utime = now_us;
  event.tick = replica_.tick();
  if (broadcast_.muted()) return event;
  Allowance& allowance = allowances_[static_cast<std::size_t>(event.kind)];
  const double more = static_cast<double>(now_us - allowance.at_us) * 1e-6 * kPerS;
  allowance.events = std::min<double>(kEventBurst, allowance.events + more);
  allowance.at_us = now_us;
  if (allowance.events < 1) {
    ++dropped_;
    return event;
  }
  allowance.events -= 1;
  ++events_;
  broadcast_.Publish(event);
  if (keeps_ && kept_.size() < kKeptMax) kept_.push_back(event);
  return event;
}

void Chronicle::SayResumed(std::int64_t now_us) {
  Say(now_us, MakeEvent(EventKind::kResumed,
                        "the room goes on after tick " + std::to_string(replica_.tick())));
}

std::string Chronicle::NameOf(int player) const {
  return replica_.world().scene().players[static_cast<std::size_t>(player)].name;
}

void Chronicle::NoteEdit(std::int64_t now_us, const Edit& edit) {
  if (broadcast_.muted()) return;
  ++edits_;
  if (const BreakEdit* const broken = edit.As<BreakEdit>()) SayBroken(now_us, broken->joint);
  if (const SeatEdit* const seat = edit.As<SeatEdit>()) SaySeat(now_us, *seat);
}

void Chronicle::SayBroken(std::int64_t now_us, int joint) {
  const Topology& topology = replica_.world().topology();
  if (!topology.HasJoint(joint)) return;
  const Joint& is = topology.scene().joints[static_cast<std::size_t>(joint)];
  const auto name = [&](PartId part) {
    return part < 0 ? std::string("the world")
                    : topology.scene().parts[static_cast<std::size_t>(part)].name;
  };
  Event event = MakeEvent(EventKind::kBroke, name(is.a) + " and " + name(is.b) + " come apart");
  event.body = is.a;
  event.other = is.b;
  event.index = joint;
  Say(now_us, event);
}

void Chronicle::SaySeat(std::int64_t now_us, const SeatEdit& edit) {
  const std::vector<Seat>& seats = replica_.world().scene().seats;
  if (edit.seat < 0 || edit.seat >= static_cast<int>(seats.size())) return;
  const Seat& seat = seats[static_cast<std::size_t>(edit.seat)];
  const bool takes = edit.player >= 0;
  const int player = takes ? edit.player : seat.player;
  if (player < 0) return;
  const bool here = sessions_.PeerOfPlayer()[static_cast<std::size_t>(player)] >= 0;
  const std::string text = takes  ? NameOf(player) + " takes the seat " + seat.name
                           : here ? NameOf(player) + " leaves the seat " + seat.name
                                  : NameOf(player) + " is gone: the seat " + seat.name + " is free";
  Event event = MakeEvent(takes ? EventKind::kSeatTaken : EventKind::kSeatFreed, text, player);
  event.body = seat.part;
  event.index = edit.seat;
  Say(now_us, event);
}

void Chronicle::NoteValues(std::int64_t now_us, const Meta& meta) {
  for (std::size_t i = 0; i < meta.id.size(); ++i) {
    if (meta.kind[i] != kMetaPlayer || meta.key[i] != kMetaScore) continue;
    const int player = meta.id[i];
    char text[80];
    std::snprintf(text, sizeof text, "%s has %g points", NameOf(player).c_str(),
                  static_cast<double>(meta.value[i]));
    Event event = MakeEvent(EventKind::kScored, text, player);
    event.value_milli = Milli(static_cast<double>(meta.value[i]));
    Say(now_us, event);
  }
}

bool Chronicle::NoteReady(const std::string& name) {
  ClientAccount& account = sessions_.accounts().Of(name);
  const bool again = account.known;
  account.known = changed_ = true;
  account.rejoins += again ? 1 : 0;
  account.NotePresent(replica_.tick(), 1);
  return again;
}

void Chronicle::NoteLeft(const std::string& name) {
  sessions_.accounts().Of(name).NotePresent(replica_.tick(), -1);
  changed_ = true;
}

void Chronicle::NoteTick(std::int64_t late_us) {
  ++ticks_;
  if (late_us * room_.tick_hz > 1000000) ++late_ticks_;
}

void Chronicle::CountHandOvers() {
  const AuthorityTable& table = replica_.authority();
  // An edit replaces mechanisms: their authorities are not counted as hand-overs.
  const bool same = revision_ == replica_.revision() &&
                    holders_.size() == static_cast<std::size_t>(table.count());
  revision_ = replica_.revision();
  holders_.resize(static_cast<std::size_t>(table.count()), 0);
  for (int m = 0; m < table.count(); ++m) {
    const int before = std::exchange(holders_[static_cast<std::size_t>(m)], table.at(m).authority);
    const int now = table.at(m).authority;
    if (!same || now == before) continue;
    ++hand_overs_;
    Session* const session = now > 0 ? sessions_.Find(now) : nullptr;
    if (session != nullptr) ++session->account->hand_overs;
  }
}

}  // namespace seam
