/// Corrector: turns received states into snapshots, corrections or a replay.

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/codec/persist_message.h"
#include "common/sync/correct/corrector.h"
#include "common/sync/quantize.h"
#include "common/sync/reach/way_to.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Most that kept States may be in the future, ticks.
constexpr std::int64_t kWaitingTicksMax = 120;

}  // namespace

Corrector::Corrector(const SyncConfig& config, World& world, const Roles& roles,
                     Activities& activities, BodyMemory& memory, Display& display, Replay& replay)
    : config_(config),
      world_(world),
      roles_(roles),
      activities_(activities),
      memory_(memory),
      display_(display),
      replay_(replay),
      blender_(config, world, roles, memory, display) {}

Received Corrector::Receive(const States& states) {
  Received result;
  if (IsEarly(states)) {
    if (IsNear(states) && waiting_.size() < kEarlyMessagesMax) {
      Wait(states);
      result.used = static_cast<int>(states.id.size());
    } else {
      result.stale = static_cast<int>(states.id.size());
    }
    return result;
  }
  std::vector<Blender::Entry> to_correct;
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (!IsNews(states, i, body, &result)) continue;
    memory_.track(body).heard_tick = states.tick;
    memory_.track(body).heard_epoch = states.epoch[i];
    memory_.MarkUpdated(body);
    if (ReceiveOne(states, i, body)) to_correct.emplace_back(i, body);
  }
  ClosePlaced();
  if (config_.policy->GoesBack(roles_.self())) {
    const auto asks = [&](const Blender::Entry& e) { return replay_.Ask(e.second, states.tick); };
    to_correct.erase(std::remove_if(to_correct.begin(), to_correct.end(), asks), to_correct.end());
  }
  blender_.Correct(states, to_correct);
  if (result.used > 0) display_.AddAge(world_.tick() - states.tick);
  return result;
}

/// True if the message is of a future tick, or of an edit not yet applied here.
bool Corrector::IsEarly(const States& states) const {
  return states.tick > world_.tick() || states.revision > world_.topology().revision();
}

bool Corrector::IsNear(const States& states) const {
  return states.tick <= world_.tick() + kWaitingTicksMax &&
         states.tick > world_.tick() - kWaitingTicksMax;
}

void Corrector::Wait(const States& states) {
  if (waited_.empty()) waited_.emplace_back();
  waiting_.push_back(std::move(waited_.back()));
  waited_.pop_back();
  waiting_.back() = states;
}

void Corrector::ReceiveWaiting() {
  std::size_t left = 0;
  for (States& states : waiting_) {
    if (!IsEarly(states)) {
      Receive(states);
    } else if (IsNear(states)) {
      std::swap(waiting_[left++], states);
    }
  }
  std::move(waiting_.begin() + static_cast<std::ptrdiff_t>(left), waiting_.end(),
            std::back_inserter(waited_));
  waiting_.resize(left);
}

void Corrector::Persist(StateArchive& a) {
  a.Section("states of later ticks");
  a.List(&waiting_, kEarlyMessagesMax,
         [&](States* states) { PersistMessage(a, states, kBusMessageBytesMax); });
}

bool Corrector::IsNews(const States& states, std::size_t i, int body, Received* result) const {
  if (body < 0) {
    ++result->unknown;
    return false;
  }
  const BodyTrack& track = memory_.track(body);
  if (states.revision < track.changed_at) {
    ++result->stale;  // the state of an earlier body with the same root
    return false;
  }
  const AuthorityRecord& record = roles_.table().at(world_.mechanism(body));
  if (track.placed && (record.authority == roles_.self() || states.peer == roles_.self())) {
    ++result->unknown;
    return false;
  }
  const bool trusts = config_.policy->GoesBack(roles_.self()) && roles_.Simulates(body);
  if (track.placed && trusts && replay_.LacksEdit(states.revision, states.tick)) {
    ++result->stale;  // its sender will roll back and send another state
    return false;
  }
  if (states.epoch[i] < record.epoch || states.tick <= track.heard_tick) {
    ++result->stale;
    return false;
  }
  ++result->used;
  return true;
}

bool Corrector::ReceiveOne(const States& states, std::size_t i, int body) {
  const BodyState remote = Unpack(states, i, world_.Read(body).angle);
  if (!memory_.track(body).placed) memory_.snapshots().ForgetAfter(body, states.tick - 1);
  memory_.snapshots().Add(body, states.tick, remote, (states.flags[i] & kStateFalls) != 0);
  if (!memory_.track(body).placed) {
    PlaceNow(body, states.tick, remote, (states.flags[i] & kStateAsleep) != 0);
    return false;
  }
  return config_.reconcile != nullptr && roles_.RoleOfBody(body) == kRoleSecondary;
}

void Corrector::Place(const States& states) {
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || memory_.track(body).placed) continue;
    memory_.track(body).heard_tick = states.tick;  // older states are stale from now on
    memory_.track(body).heard_epoch = states.epoch[i];
    const BodyState remote = Unpack(states, i, world_.Read(body).angle);
    memory_.snapshots().ForgetAfter(body, states.tick - 1);
    memory_.snapshots().Add(body, states.tick, remote, (states.flags[i] & kStateFalls) != 0);
    PlaceNow(body, states.tick, remote, (states.flags[i] & kStateAsleep) != 0);
  }
}

/// Places a body at the state of a message, extrapolated to now: the message is as old as its
/// transit.
void Corrector::PlaceNow(int body, std::int64_t tick, const BodyState& remote, bool asleep) {
  BodyState by_now = remote;
  const bool moves_on = !asleep && tick < world_.tick();
  placed_.emplace_back(world_.id(body), moves_on);
  if (moves_on) {
    by_now = memory_.MovedOn(body, world_.tick());
    by_now.angle = UnwrapAngle(by_now.angle, remote.angle);
    if (!memory_.snapshots().falls(body)) {  // a falling one bounces off anchored shapes already
      by_now.position = WayTo(world_, memory_, body, remote.position, tick, by_now.position);
    }
  }
  PlaceBody(body, by_now, asleep);
}

void Corrector::PlaceBody(int body, const BodyState& state, bool asleep) {
  activities_.Unpark(body);
  memory_.track(body).placed = true;
  replay_.Forget();  // the barriers lack this body
  world_.Write(body, WithinLimits(state, world_.scene().speed_limit));
  if (asleep) world_.SetAwake(body, false);
  *memory_.history().At(world_.tick(), body) = world_.Read(body);
  display_.Reset(body);
}

}  // namespace seam
