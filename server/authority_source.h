#pragma once
/// Body states and impacts for the rules of a room: for each body those of its authority, checked.
/// For the server's own bodies that is its world; its copies of other peers' bodies do not count.

#include <cstdint>
#include <functional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/replica.h"
#include "common/sync/rollback/new_touches.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/body_table.h"
#include "server/authority/authority_manager.h"
#include "server/rules/impact_check.h"
#include "server/rules/rule_source.h"
#include "server/rules/state_trail.h"

namespace seam {

class AuthoritySource : public RuleSource {
 public:
  /// All must outlive this object. Dropped messages and entries are counted in `stats`.
  AuthoritySource(const Replica& replica, const AuthorityManager& authority, Stats& stats);

  /// Reports about bodies for which `doubted` returns true do not count, and they enter nothing.
  void Doubt(std::function<bool(int body)> doubted) { doubted_ = std::move(doubted); }
  /// Takes states of a peer that the StateFilter accepted.
  void NoteStates(const States& accepted);
  /// Takes impacts reported by a peer. An impact counts once, if it is possible, if the peer has
  /// authority over the struck body in that epoch, and if no edit has changed the bodies since. One
  /// that the known states do not explain waits for those of its time, at most for kReportPast.
  void NoteReport(int peer, const ImpactReport& report);
  /// Takes touches reported by a peer. A touch counts once, if its parts were near each other and
  /// the peer has, or had a moment ago, authority over the first of them that moves.
  void NoteReport(int peer, const TouchReport& report);
  /// Impacts reported by peers with the right to do so, since the start.
  struct ReportCounts {
    std::int64_t accepted = 0, repeated = 0, changed = 0, implausible = 0;
  };
  const ReportCounts& counts() const { return reports_; }
  /// To be called after each step of the replica, with the touches that the server is to tell.
  void NoteTick(const std::vector<NewTouch>& touches);

  /// Saves or loads the states and the reports. Call between two ticks.
  void Persist(StateArchive& a);

  bool Doubted(int body) const override { return doubted_ && !Mine(body) && doubted_(body); }
  BodyState Read(int body) const override;
  std::vector<std::int64_t> Ticks() const override;
  BodyState ReadAt(int body, std::int64_t tick) const override;
  std::int64_t TickOf(int body, std::int64_t tick) const override;
  void MarkProcessed() override { trail_.MarkProcessed(); }
  std::vector<Blow> TakeImpacts() override;
  std::vector<PartTouch> TakeTouches() override { return std::exchange(touches_, {}); }

 private:
  bool Mine(int body) const { return authority_.Has(0, replica_.world().mechanism(body)); }
  /// An impact on a body, by ids: edits renumber bodies.
  struct Reported {
    PartId body = -1, by = -1;  ///< by: -1: an anchored part
    float dv = 0;               ///< m/s
    Vec2 point{0, 0};           ///< m
    std::int64_t tick = 0;
    int revision = 0;
    bool told = true;  ///< by a peer; else found in the server's own world
  };
  struct Held {  // by a peer, in an epoch
    int peer = -1;
    std::int32_t epoch = -1;
    bool operator==(const Held& o) const { return peer == o.peer && epoch == o.epoch; }
  };
  struct Holders {
    Held last, before;  // of the states that came
  };
  struct ToldTouch {
    NewTouch is;
    int peer = 0;
  };
  bool MayReport(int peer, const TouchReport& report, std::size_t i) const;
  /// True if no assembly of the room has the part, or there never was one.
  bool IsGone(PartId part) const;
  bool DoubtedPart(PartId part) const;
  bool MayTell(int peer, int body, std::int32_t epoch) const;
  void NoteTouch(int peer, const NewTouch& touch);
  bool MayReport(int peer, const Reported& reported, std::int32_t epoch);
  /// Returns false if a body has changed since.
  bool ToBlow(const Reported& reported, Blow* blow) const;
  void Judge(const Reported& reported, ImpactCheck* check);
  /// True if states that may still come can explain the impact.
  bool Waits(const Reported& reported, const Blow& blow, const ImpactCheck& check) const;
  void JudgeWaiting();
  void PersistReports(StateArchive& a);
  void Refuse(const Reported& reported, std::int64_t* reason, std::int64_t* dropped);

  const Replica& replica_;
  const AuthorityManager& authority_;
  Stats& stats_;
  StateTrail trail_;
  std::function<bool(int)> doubted_;
  BodyColumn<Holders> holders_;
  std::vector<ToldTouch> told_;     // of the last kReportPast ticks
  std::vector<PartTouch> touches_;  // since the last TakeTouches
  ReportCounts reports_;
  std::vector<Reported> accepted_;                              // since the last TakeImpacts
  std::vector<Reported> waiting_;                               // for states of their time
  std::set<std::tuple<std::int64_t, PartId, PartId>> counted_;  // tick, struck, by
};

}  // namespace seam
