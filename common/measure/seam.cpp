/// The seam: distance of a peer's displayed pose from the authority's at the same tick. Does not
/// use the oracle, so chaos does not affect it.

#include "common/measure/mean_square.h"
#include "common/measure/parts.h"

namespace seam {
namespace {

using Views = std::map<std::int64_t, View>;

/// Displayed position minus the authority's.
struct Distance {
  Eigen::Vector2d d{0, 0};             // m
  int revision = 0, of_authority = 0;  // revisions of the two views
};

/// Compares body `i` of a view with the authority's view of the same tick. nullopt when the peer
/// has authority itself, or the authority's view is missing or does not claim the body (where
/// bodies change: the body that has the part).
std::optional<Distance> Apart(const Recording& recording, int peer, const View& view, std::size_t i,
                              const RevisionHistory* revisions) {
  const int authority = view.authority[i];
  if (authority == peer) return std::nullopt;
  const auto views = recording.views.find(authority);
  if (views == recording.views.end()) return std::nullopt;
  const View* own = FindView(views->second, view.tick);
  if (own == nullptr) return std::nullopt;
  const int k = IndexOf(*own, view.id[i]);
  std::size_t index = 0;
  std::optional<BodyState> theirs;
  if (k >= 0) {
    index = static_cast<std::size_t>(k);
    theirs = StateIn(*own, index);
  } else if (revisions != nullptr) {
    theirs = revisions->InView(*own, view.id[i], &index);
  }
  if (!theirs || own->authority[index] != authority) return std::nullopt;
  return Distance{Eigen::Vector2d(double{view.x[i]} - double{theirs->position.x()},
                                  double{view.y[i]} - double{theirs->position.y()}),
                  view.revision, own->revision};
}

std::optional<Distance> ApartAt(const Recording& recording, int peer, const Views& views,
                                std::int64_t tick, PartId id, const RevisionHistory* revisions) {
  const View* view = FindView(views, tick);
  const int i = view == nullptr ? -1 : IndexOf(*view, id);
  if (i < 0) return std::nullopt;
  return Apart(recording, peer, *view, static_cast<std::size_t>(i), revisions);
}

}  // namespace

void MeasureSeam(const Recording& recording, const RevisionHistory* revisions, Measures* measures) {
  const double h = TickSeconds(recording);
  const auto same = [&](const Distance& a, const Distance& b, PartId id) {
    return revisions == nullptr || (revisions->SameBody(a.revision, b.revision, id) &&
                                    revisions->SameBody(a.of_authority, b.of_authority, id));
  };
  MeanSquare apart, jerk;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const auto now = Apart(recording, peer, view, i, revisions);
        if (!now) continue;
        apart.Add(now->d.squaredNorm());
        const PartId id = view.id[i];
        const auto before = ApartAt(recording, peer, views, tick - 1, id, revisions);
        const auto earlier = ApartAt(recording, peer, views, tick - 2, id, revisions);
        if (!before || !earlier) continue;
        if (!same(*now, *before, id) || !same(*before, *earlier, id)) continue;
        jerk.Add((now->d - 2 * before->d + earlier->d).squaredNorm() / (h * h * h * h));
      }
    }
  }
  measures->seam_rms_m = apart.Root();
  measures->seam_stutter_mps2 = jerk.Root();
}

}  // namespace seam
