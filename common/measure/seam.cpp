/// The seam itself: how far what a peer shows is from what the authority shows at the same tick.
/// The oracle is not asked, so chaos does not blur it.

#include <cmath>

#include "common/measure/parts.h"

namespace seam {
namespace {

using Views = std::map<std::int64_t, View>;

const View* Find(const Views& views, std::int64_t tick) {
  const auto found = views.find(tick);
  return found == views.end() ? nullptr : &found->second;
}

/// Displayed minus the authority's, m; nullopt when the peer has the authority itself, or the
/// authority's view of the tick is missing or does not claim the body.
std::optional<Eigen::Vector2d> Apart(const Recording& recording, int peer, const View& view,
                                     std::size_t i) {
  const int authority = view.authority[i];
  if (authority == peer) return std::nullopt;
  const auto views = recording.views.find(authority);
  if (views == recording.views.end()) return std::nullopt;
  const View* own = Find(views->second, view.tick);
  const int k = own == nullptr ? -1 : IndexOf(*own, view.id[i]);
  if (k < 0 || own->authority[static_cast<std::size_t>(k)] != authority) return std::nullopt;
  const auto index = static_cast<std::size_t>(k);
  return Eigen::Vector2d(double{view.x[i]} - double{own->x[index]},
                         double{view.y[i]} - double{own->y[index]});
}

std::optional<Eigen::Vector2d> ApartAt(const Recording& recording, int peer, const Views& views,
                                       std::int64_t tick, PartId id) {
  const View* view = Find(views, tick);
  const int i = view == nullptr ? -1 : IndexOf(*view, id);
  if (i < 0) return std::nullopt;
  return Apart(recording, peer, *view, static_cast<std::size_t>(i));
}

struct Mean {
  double sum = 0;
  std::int64_t count = 0;
  void Add(double square) {
    sum += square;
    ++count;
  }
  std::optional<double> Root() const {
    if (count == 0) return std::nullopt;
    return std::sqrt(sum / static_cast<double>(count));
  }
};

}  // namespace

void MeasureSeam(const Recording& recording, Measures* measures) {
  const double h = TickSeconds(recording);
  Mean apart, jerk;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const auto now = Apart(recording, peer, view, i);
        if (!now) continue;
        apart.Add(now->squaredNorm());
        const auto before = ApartAt(recording, peer, views, tick - 1, view.id[i]);
        const auto earlier = ApartAt(recording, peer, views, tick - 2, view.id[i]);
        if (!before || !earlier) continue;
        jerk.Add((*now - 2 * *before + *earlier).squaredNorm() / (h * h * h * h));
      }
    }
  }
  measures->seam_rms_m = apart.Root();
  measures->seam_stutter_mps2 = jerk.Root();
}

}  // namespace seam
