#include "common/sync/rollback/new_touches.h"

#include <algorithm>
#include <utility>

#include "common/physics/part_places.h"
#include "common/scene/saved/persist_state.h"

namespace seam {

void NewTouches::Note() {
  const std::int64_t tick = world_.tick();
  if (tick <= newest_) {
    for (Told& told : told_) told.stands = told.stands && told.tick < tick;
  }
  newest_ = tick;
  const auto old = [&](const Told& told) { return told.tick < tick - remember_ticks_; };
  told_.erase(std::remove_if(told_.begin(), told_.end(), old), told_.end());
  for (const PartTouch& touch : world_.begun_touches()) {
    if (Told* const taken = FindTaken(touch)) {
      *taken = {touch, tick, true};
      continue;
    }
    told_.push_back({touch, tick, true});
    if (roles_.Tells(touch)) fresh_.push_back({touch, tick});
  }
}

/// Returns the first told touch of the pair that does not stand; nullptr: none.
NewTouches::Told* NewTouches::FindTaken(const PartTouch& touch) {
  const auto found = std::find_if(told_.begin(), told_.end(), [&](const Told& told) {
    return !told.stands && told.touch == touch;
  });
  return found == told_.end() ? nullptr : &*found;
}

std::vector<NewTouch> NewTouches::Take() { return std::exchange(fresh_, {}); }

std::vector<TouchReport> NewTouches::TakeReports() {
  std::vector<TouchReport> reports;
  for (const NewTouch& each : Take()) {
    const int a = MechanismOf(world_, each.touch.a);
    const int m = a >= 0 ? a : MechanismOf(world_, each.touch.b);
    if (m < 0) continue;  // an edit has taken it away since
    const bool fits = !reports.empty() && reports.back().tick == each.tick &&
                      reports.back().a.size() < kReportedTouchesMax;
    if (!fits) {
      reports.emplace_back();
      reports.back().tick = each.tick;
      reports.back().revision = world_.topology().revision();
    }
    reports.back().a.push_back(each.touch.a);
    reports.back().b.push_back(each.touch.b);
    reports.back().epoch.push_back(roles_.table().at(m).epoch);
  }
  return reports;
}

void NewTouches::Persist(StateArchive& a, std::size_t parts) {
  a.Section("touches");
  const auto touch = [&](PartTouch* t) {
    a.Int(&t->a, 0, static_cast<std::int64_t>(parts) - 1);
    a.Int(&t->b, 0, static_cast<std::int64_t>(parts) - 1);
  };
  a.Tick(&newest_);
  a.List(&told_, StateArchive::kListMost, [&](Told* told) {
    touch(&told->touch);
    a.Tick(&told->tick);
    a.Flag(&told->stands);
  });
  a.List(&fresh_, StateArchive::kListMost, [&](NewTouch* fresh) {
    touch(&fresh->touch);
    a.Tick(&fresh->tick);
  });
}

}  // namespace seam
