#include "common/measure/screen/path.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/check.h"

namespace seam {

BodyPath::BodyPath(std::int64_t first_tick, std::int64_t last_tick)
    : first_(first_tick),
      samples_(static_cast<std::size_t>(std::max<std::int64_t>(0, last_tick - first_tick + 1))) {}

const BodyPath::Sample* BodyPath::Find(std::int64_t tick) const {
  if (tick < first_ || tick > last()) return nullptr;
  const Sample& sample = samples_[static_cast<std::size_t>(tick - first_)];
  return sample.form < 0 ? nullptr : &sample;
}

bool BodyPath::Has(std::int64_t tick) const { return Find(tick) != nullptr; }

bool BodyPath::Has(double tick) const {
  return Has(static_cast<std::int64_t>(std::floor(tick))) &&
         Has(static_cast<std::int64_t>(std::ceil(tick)));
}

bool BodyPath::Whole(std::int64_t from, std::int64_t to) const {
  const Sample *a = Find(from), *b = Find(to);
  return a != nullptr && b != nullptr && a->form == b->form;
}

bool BodyPath::Whole(double from, double to) const {
  return Whole(static_cast<std::int64_t>(std::floor(from)),
               static_cast<std::int64_t>(std::ceil(to)));
}

const DoublePose& BodyPath::At(std::int64_t tick) const {
  const Sample* sample = Find(tick);
  SEAM_ASSERT(sample != nullptr);
  return sample->pose;
}

DoublePose BodyPath::At(double tick) const {
  const double low = std::floor(tick);
  const auto at = static_cast<std::int64_t>(low);
  const DoublePose& a = At(at);
  if (tick == low) return a;
  const DoublePose& b = At(at + 1);
  const double share = tick - low;
  return {a.position + share * (b.position - a.position),
          a.angle + share * WrapAngle(b.angle - a.angle)};
}

void BodyPath::Set(std::int64_t tick, const DoublePose& pose, bool same) {
  if (tick < first_ || tick > last()) return;
  known_ = known_ < 0 ? tick : std::min(known_, tick);
  if (!same || Find(tick - 1) == nullptr) ++form_;
  samples_[static_cast<std::size_t>(tick - first_)] = {pose, form_};
}

std::vector<const View*> ViewsByTick(const Recording& recording, int peer) {
  std::vector<const View*> views;
  const auto found = recording.views.find(peer);
  if (found == recording.views.end()) return views;
  views.resize(static_cast<std::size_t>(recording.last_tick - recording.first_tick + 1));
  for (const auto& [tick, view] : found->second) {
    views[static_cast<std::size_t>(tick - recording.first_tick)] = &view;
  }
  return views;
}

BodyPath ShownPath(const Recording& recording, const std::vector<const View*>& views,
                   const RevisionHistory* revisions, PartId id) {
  BodyPath path(recording.first_tick, recording.last_tick);
  const View* before = nullptr;
  for (const View* view : views) {
    const int i = view == nullptr ? -1 : IndexOf(*view, id);
    if (i >= 0) {
      const bool same =
          before != nullptr &&
          (revisions == nullptr || revisions->SameBody(view->revision, before->revision, id));
      path.Set(view->tick, DoublePose(StateIn(*view, static_cast<std::size_t>(i))), same);
    }
    before = i >= 0 ? view : nullptr;
  }
  return path;
}

BodyPath TruePath(const Recording& recording, const Oracle& oracle, PartId id) {
  const std::int64_t before = std::max(1, recording.room.tick_hz);
  BodyPath path(std::max(oracle.first_tick, recording.first_tick - before), recording.last_tick);
  for (std::int64_t tick = path.first(); tick <= path.last(); ++tick) {
    const std::optional<BodyState> truth = oracle.At(tick, id);
    if (truth) path.Set(tick, DoublePose(*truth), oracle.SameBody(tick, tick - 1, id));
  }
  return path;
}

std::vector<PartId> ShownIds(const Recording& recording) {
  std::set<PartId> ids;
  for (const auto& [peer, views] : recording.views) {
    int key = -1;
    for (const auto& [tick, view] : views) {
      if (view.revision == key && tick != views.begin()->first) continue;
      key = view.revision;
      ids.insert(view.id.begin(), view.id.end());
    }
  }
  return {ids.begin(), ids.end()};
}

}  // namespace seam
