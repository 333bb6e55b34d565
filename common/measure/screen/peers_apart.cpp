#include "common/measure/screen/peers_apart.h"

#include <iterator>

#include "common/measure/mean_square.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/extent.h"

namespace seam {
namespace {

/// Adds the bodies of two views of one tick; both list them ascending by id.
void AddPair(const View& one, const View& other, Extents* extents, MeanSquare* apart) {
  if (one.revision != other.revision) return;
  std::size_t j = 0;
  for (std::size_t i = 0; i < one.id.size(); ++i) {
    while (j < other.id.size() && other.id[j] < one.id[i]) ++j;
    if (j == other.id.size()) return;
    if (other.id[j] != one.id[i]) continue;
    const double d = extents->Of(one.revision, one.id[i])
                         .Displacement(DoublePose(StateIn(one, i)), DoublePose(StateIn(other, j)));
    apart->Add(d * d);
  }
}

}  // namespace

std::optional<double> PeersApart(const Recording& recording) {
  std::optional<RevisionHistory> revisions;
  if (!recording.room.scene_text.empty()) {
    revisions.emplace(RecordedScene(recording.room), recording);
  }
  Extents extents(revisions ? &*revisions : nullptr);
  MeanSquare apart;
  for (auto one = recording.views.begin(); one != recording.views.end(); ++one) {
    for (auto other = std::next(one); other != recording.views.end(); ++other) {
      for (const auto& [tick, view] : one->second) {
        const auto found = other->second.find(tick);
        if (found != other->second.end()) AddPair(view, found->second, &extents, &apart);
      }
    }
  }
  return apart.Root();
}

}  // namespace seam
