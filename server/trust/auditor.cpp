#include "server/trust/auditor.h"

#include <algorithm>
#include <numeric>

#include "common/physics/part_places.h"
#include "common/scene/character.h"
#include "common/scene/mechanism_ids.h"
#include "common/sync/inputs/input_feed.h"
#include "common/sync/quantize.h"
#include "common/sync/rollback/presses.h"

namespace seam {
namespace {

/// A mechanism is put anew after a time between these, s: long enough that a lie is more than the
/// wire's rounding, short enough that chaos has not begun. It is out if it is told of too seldom.
constexpr double kPutAfterS = 0.15, kPutWithinS = 0.25, kOutS = 1;
/// A body that a message left out is where it was told to be in the last of these, s, moved on.
constexpr double kMovedOnS = 0.1;
/// Work of building the spare world, steps of a body for each part of the scene.
constexpr std::int64_t kBuildSteps = 4;
/// The spare world skips ticks if it is later than this, s.
constexpr double kSkipS = 0.5;
/// A lie for this time weighs 1, s; a gross one kGrossAudited as much.
constexpr double kAuditedS = 0.25;
constexpr float kGrossAudited = 4;
/// A mechanism that may have met more is not compared: piles are chaos.
constexpr std::size_t kIslandMost = 6;
/// A character's step is known once it has been followed for so long, s: three steps. Others are
/// tried as seldom as this, s.
constexpr double kStepKnownS = 1, kOthersS = 0.5;

}  // namespace

Auditor::Auditor(const Replica& replica, std::uint64_t seed)
    : replica_(replica),
      random_(seed),
      tracks_(replica.table(),
              [](int, const std::vector<const Track*>& before) {
                Track track = before.size() == 1 ? *before.front() : Track{};
                track.since = track.put = track.from = -1;
                track.active = false;
                track.step.Take();
                return track;
              }),
      renumbered_(replica.table(), [this](const BodyRemap&) { NoteRenumbered(); }),
      surroundings_(replica),
      noted_(replica.world().scene().players.size(), -1000),
      followed_(static_cast<std::size_t>(kPeersMax), 0) {
  NoteRenumbered();
}

int Auditor::Seconds(double s) const {
  return static_cast<int>(s * replica_.world().scene().solver.tick_hz);
}

void Auditor::NoteRenumbered() {
  const World& world = replica_.world();
  if (spare_ != nullptr && spare_->world().composition().hash != world.composition().hash) {
    spare_.reset();
  }
  watched_.clear();
  active_.clear();
  draw_at_ = 0;
  place_.assign(static_cast<std::size_t>(world.body_count()), 0);
  size_.assign(world.composition().mechanisms.size(), 0);
  for (int body = 0; body < world.body_count(); ++body) {
    place_[static_cast<std::size_t>(body)] =
        size_[static_cast<std::size_t>(world.mechanism(body))]++;
  }
  characters_.assign(size_.size(), 0);
  for (const Character& character : world.scene().characters) {
    if (!character.active) continue;
    const int m = MechanismOf(world, character.parts[kTorso]);
    if (m >= 0) characters_[static_cast<std::size_t>(m)] = 1;
  }
  for (int m = 0; m < tracks_.size(); ++m) {
    if (tracks_[m].drawn && !tracks_[m].told.empty()) Activate(m);
  }
}

void Auditor::Forget(int mechanism) {
  Leave(mechanism);
  LoseStep(mechanism);
  tracks_[mechanism].told.Forget();
}

void Auditor::NoteEdit(const Edit& edit) {
  const World& world = replica_.world();
  std::vector<int> moved;
  for (const PartId part : world.topology().PartsOf(edit)) {
    const int m = MechanismOf(world, part);
    if (m >= 0) moved.push_back(m);
  }
  if (moved.empty() && edit.As<InsertEdit>() == nullptr) {  // of the ground: it may move any
    moved.resize(static_cast<std::size_t>(tracks_.size()));
    std::iota(moved.begin(), moved.end(), 0);
  }
  for (const int m : moved) {
    Forget(m);
    tracks_[m].revision = replica_.revision() + 1;
  }
  if (credit_ < 0) spare_.reset();  // one that is built anew has all edits
  if (spare_ == nullptr) return;
  const auto parts = static_cast<std::int64_t>(replica_.world().scene().parts.size());
  if (edit.As<PushEdit>() == nullptr) credit_ -= kBuildSteps * parts;
  // Its controllers remember their steps, and learn from pushes that they are limp.
  for (int m = 0; edit.As<PushEdit>() == nullptr && m < tracks_.size(); ++m) Leave(m);
  spare_->Apply(edit);
}

void Auditor::NoteTold(int player, const States& states) {
  const World& world = replica_.world();
  const std::int64_t oldest = world.tick() - Seconds(kBehindS + kSkipS);
  if (states.tick <= oldest) return;
  surroundings_.NoteTold(states);
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world.BodyOfId(states.id[i]);
    if (body < 0) continue;
    Track& track = tracks_[world.mechanism(body)];
    if (states.revision < track.revision) continue;
    if (track.peer != states.peer) {
      track.gain = SteadyGain();
      Forget(world.mechanism(body));
      track.peer = states.peer;
    }
    track.player = player;
    if (track.drawn) Activate(world.mechanism(body));
    track.told.DropBefore(oldest + 1);
    track.told.Add(states.tick, place_[static_cast<std::size_t>(body)],
                   size_[static_cast<std::size_t>(world.mechanism(body))],
                   Unpack(states, i, world.Read(body).angle));
  }
}

bool Auditor::Asleep(int mechanism) const {
  const World& world = replica_.world();
  return !AnyIdOf(world.composition(), mechanism,
                  [&](PartId id) { return world.awake(world.BodyOfId(id)); });
}

void Auditor::Build() {
  spare_ = std::make_unique<SpareWorld>(replica_.world().topology(), SpareWorld::Present::kNone);
  credit_ -= kBuildSteps * static_cast<std::int64_t>(replica_.world().scene().parts.size());
  JumpTo(replica_.tick() - Seconds(kBehindS) - 1);
}

void Auditor::JumpTo(std::int64_t tick) {
  for (int m = 0; m < tracks_.size(); ++m) {
    Leave(m);
    LoseStep(m);
  }
  spare_->SetTick(std::max<std::int64_t>(0, tick));
}

void Auditor::Leave(int mechanism) {
  Track& track = tracks_[mechanism];
  if (track.since >= 0 && spare_ != nullptr) spare_->Take(mechanism);
  track.since = track.put = track.from = -1;
  track.step.Take();
}

void Auditor::LoseStep(int mechanism) { tracks_[mechanism].step_since = -1; }

void Auditor::Work() {
  const std::int64_t now = replica_.tick();
  if (now == worked_) return;
  worked_ = now;
  const int tick_hz = replica_.world().scene().solver.tick_hz;
  credit_ = std::min<std::int64_t>(kStepsPerS, credit_ + kStepsPerS / tick_hz);
  surroundings_.AfterTick(watched_);
  if (now >= draw_at_) Draw();
  if (active_.empty() || credit_ < 0) return;
  if (spare_ == nullptr) Build();
  const std::int64_t to = now - Seconds(kBehindS);
  const std::int64_t late = to - spare_->world().tick();
  if (late < 0 || late > Seconds(kSkipS)) JumpTo(to - 1);
  for (int i = 0; i < 2 && credit_ >= 0 && spare_->world().tick() < to; ++i) StepOnce();
}

void Auditor::StepOnce() {
  const std::int64_t tick = spare_->world().tick() + 1;
  spare_->Step([&](World* world) {
    for (const int p : players_) {
      const InputTrack& track = replica_.inputs(p);
      world->SetInput(p, track.At(tick));
      EachAction(*world, p, track.PressedAt(tick), [&](int action, int m) {
        if (tracks_[m].since >= 0) world->Act(p, action);
      });
    }
  });
  const std::int64_t substeps = spare_->world().scene().solver.substeps;
  const auto steps = substeps * static_cast<std::int64_t>(spare_->world().present().size());
  counts_.steps += steps;
  credit_ -= steps;
  // Visit may add some.
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (tracks_[active_[i]].drawn) Visit(active_[i], tick);
  }
  const auto idle = [this](int m) {
    const Track& track = tracks_[m];
    return track.since < 0 && (!track.drawn || track.told.empty());
  };
  const auto end = std::remove_if(active_.begin(), active_.end(), [&](int m) {
    if (idle(m)) tracks_[m].active = false;
    return idle(m);
  });
  active_.erase(end, active_.end());
}

void Auditor::Activate(int mechanism) {
  if (!std::exchange(tracks_[mechanism].active, true)) active_.push_back(mechanism);
}

void Auditor::Visit(int mechanism, std::int64_t tick) {
  Track& track = tracks_[mechanism];
  const ToldStates::Told* const told = track.told.GoTo(tick, Seconds(kOutS));
  if (told == nullptr) {
    const bool still = track.put < 0 && track.told.empty() && Asleep(mechanism);
    const bool silent = track.put >= 0 && tick - track.put > Seconds(kOutS);
    if (silent) LoseStep(mechanism);
    if (track.since >= 0 && (silent || (track.put < 0 && !still))) Leave(mechanism);
    return;
  }
  const bool due = tick >= track.due;
  if (!due && !Walks(mechanism)) return;
  std::optional<Gain> gain;
  if (track.put >= 0) gain = spare_->Compare(mechanism, told->states);
  if (Walks(mechanism) && track.put >= 0) {
    const auto other = track.step.Add(tick, Seconds(kOthersS), gain);
    if (other && !spare_->TryOther(mechanism, *other)) track.step.NoOther();
    if (due) gain = track.step.Take();
    if (track.step_since < 0 || tick - track.step_since < Seconds(kStepKnownS)) gain.reset();
  }
  if (due) {
    // Without the forces of its contacts, which are not told, it moves otherwise at first.
    if (track.from == track.since) gain.reset();
    Compare(mechanism, *told, gain);
    track.due = tick + Seconds(random_.Uniform(kPutAfterS, kPutWithinS));
  }
  PutTold(mechanism, tick, due);
}

/// `anew`: it is compared from here on.
void Auditor::PutTold(int mechanism, std::int64_t tick, bool anew) {
  Track& track = tracks_[mechanism];
  const auto whole = track.told.Whole(Seconds(kMovedOnS), spare_->world().dt());
  if (!whole) {
    if (Walks(mechanism)) Leave(mechanism);
    return;
  }
  spare_->Put(mechanism, track.peer, *whole);
  if (track.since < 0) track.since = tick;
  if (track.step_since < 0) track.step_since = tick;
  track.put = tick;
  if (!anew && track.from >= 0) return;
  track.from = tick;
  surroundings_.EachNear(mechanism, tick, tick, [&](int other) { PutStill(other, tick); });
}

/// Something of the same holder that nobody tells of as it lies still, in the way of the rest.
void Auditor::PutStill(int mechanism, std::int64_t tick) {
  Track& track = tracks_[mechanism];
  if (!track.drawn || track.since >= 0 || !track.told.empty() || !Asleep(mechanism)) return;
  std::vector<BodyState> states;
  for (const int body : spare_->bodies(mechanism)) states.push_back(replica_.world().Read(body));
  spare_->Put(mechanism, replica_.authority().at(mechanism).authority, states);
  track.since = tick;
  Activate(mechanism);
}

/// True if the inputs came that go with each message of states. What is missing before these was
/// held, or was lost with sixteen datagrams in a row.
bool Auditor::ToldInputs(int player, std::int64_t from, std::int64_t to) const {
  const InputTrack& inputs = replica_.inputs(player);
  for (std::int64_t tick = std::max(from, to - kInputsRedundant) + 1; tick <= to; ++tick) {
    if (!inputs.knows(tick)) return false;
  }
  return true;
}

/// True if all that may have moved the mechanism between the ticks, directly or through others, was
/// in the spare world.
bool Auditor::Knows(int mechanism, std::int64_t from, std::int64_t to) const {
  const Track& track = tracks_[mechanism];
  if (driven_by_others_[static_cast<std::size_t>(mechanism)] != 0) return false;
  std::vector<int> island = {mechanism};
  bool alone = true;
  for (std::size_t i = 0; alone && i < island.size(); ++i) {
    const bool known = surroundings_.EachNear(island[i], from, to, [&](int other) {
      const Track& near = tracks_[other];
      const bool own = replica_.authority().at(other).authority == track.peer;
      alone = alone && own && near.since >= 0 && near.since <= from;
      if (std::find(island.begin(), island.end(), other) == island.end()) island.push_back(other);
    });
    alone = alone && known && island.size() <= kIslandMost;
  }
  return alone;
}

void Auditor::Compare(int mechanism, const ToldStates::Told& told,
                      const std::optional<Gain>& gain) {
  Track& track = tracks_[mechanism];
  if (track.player < 0) return;
  const std::int64_t from = track.from >= 0 ? track.from : told.tick;
  const bool all =
      ToldInputs(track.player, from, told.tick) && !track.told.LeavesOut(Seconds(kOutS));
  track.gain.NoteAllTold(all);
  if (gain && all && Knows(mechanism, from, told.tick)) {
    track.gain.Add(*gain);
    ++counts_.compared;
  }
  counts_.greatest = std::max(counts_.greatest, track.gain.share());
  if (track.gain.lies()) NoteLie(mechanism, told);
}

void Auditor::NoteLie(int mechanism, const ToldStates::Told& told) {
  Track& track = tracks_[mechanism];
  std::int64_t& noted = noted_[static_cast<std::size_t>(track.player)];
  const double since = static_cast<double>(told.tick - noted) / Seconds(kAuditedS);
  noted = std::max(noted, told.tick);
  const auto first =
      std::find_if(told.states.begin(), told.states.end(),
                   [](const std::optional<BodyState>& state) { return state.has_value(); });
  const auto place = static_cast<std::size_t>(first - told.states.begin());
  Found found{track.peer, track.player, {}};
  found.doubt.body = spare_->bodies(mechanism)[place];
  found.doubt.tick = told.tick;
  found.doubt.told = **first;
  found.doubt.expected = spare_->Stepped(mechanism, found.doubt.body);
  found.doubt.kind = track.gain.leaves_out() ? DoubtKind::kLeftOut : DoubtKind::kGain;
  found.doubt.weight =
      static_cast<float>(std::clamp(since, 0.0, 1.0)) * (track.gain.gross() ? kGrossAudited : 1);
  found_.push_back(found);
}

}  // namespace seam
