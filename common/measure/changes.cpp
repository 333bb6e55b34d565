/// Bodies that come, go, split and merge: measures how late peers learn of it, and whether their
/// views have exactly the existing bodies.

#include <algorithm>

#include "common/measure/parts.h"
#include "common/sync/edits/edit_order.h"

namespace seam {
namespace {

/// Returns the longest time that a view lacked an edit, ticks.
std::int64_t LongestLag(const Recording& recording) {
  std::int64_t longest = 0;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const auto lacking = recording.edits.lower_bound(view.revision);
      if (lacking == recording.edits.end()) continue;
      longest = std::max(longest, tick - lacking->second.tick);
    }
  }
  return longest;
}

/// Counts the ids that are in only one of the two lists. Requires both ascending.
std::int64_t DifferingIds(const std::vector<PartId>& there, const std::vector<PartId>& shown) {
  std::int64_t both = 0;
  auto a = there.begin();
  for (const PartId id : shown) {
    while (a != there.end() && *a < id) ++a;
    if (a != there.end() && *a == id) ++both;
  }
  return static_cast<std::int64_t>(there.size() + shown.size()) - 2 * both;
}

/// Counts the edits before the first that the log lacks; the topology after that is unknown.
std::int32_t KnownEdits(const Recording& recording) {
  std::int32_t known = 0;
  for (const auto& [number, edit] : recording.edits) {
    if (number != known) break;
    ++known;
  }
  return known;
}

}  // namespace

void MeasureChanges(const Recording& recording, const RevisionHistory& revisions,
                    Measures* measures) {
  for (const auto& [number, order] : recording.edits) {
    const Edit edit = ToEdit(order);
    const RemoveEdit* removed = edit.As<RemoveEdit>();
    if (removed != nullptr && removed->left_bounds) ++measures->left_bounds;
  }
  if (!revisions.change()) return;
  measures->topology_lag_s = static_cast<double>(LongestLag(recording)) * TickSeconds(recording);
  std::map<int, std::vector<const View*>> by_revision;
  const std::int32_t known = KnownEdits(recording);
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      if (view.revision <= known) by_revision[revisions.Key(view.revision)].push_back(&view);
    }
  }
  std::int64_t lost = 0;
  for (const auto& [key, views] : by_revision) {
    const auto revision = revisions.At(key);
    for (const View* view : views) lost += DifferingIds(revision->ids, view->id);
  }
  measures->lost = lost;
}

}  // namespace seam
