#include "render/playback/marks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace seam {
namespace {

constexpr float kShownMin = 1.0f;        ///< m/s; weaker ones would clutter a stack
constexpr float kGroundShownMin = 3.0f;  ///< m/s, against anchored bodies
constexpr double kSameMeeting_s = 0.35;  ///< impulses of a pair within this are one contact
constexpr float kNear_m = 3.0f;          ///< of several marks this near each other one is kept
constexpr std::size_t kMarksMax = 5;     ///< at a time
constexpr float kStronger = 1.5f;  ///< a new mark within kSameMeeting_s if stronger by this factor

struct Push {
  double tick = 0;
  std::pair<int, int> pair;
  Mark mark;
};

/// Keeps the strongest marks, and only one of several near each other in position and time.
std::vector<Mark> Thinned(std::vector<Mark> marks, double same_ticks) {
  std::stable_sort(marks.begin(), marks.end(),
                   [](const Mark& a, const Mark& b) { return a.dv > b.dv; });
  std::vector<Mark> kept;
  for (const Mark& mark : marks) {
    const bool near_another = std::any_of(kept.begin(), kept.end(), [&](const Mark& other) {
      return (mark.point - other.point).norm() < kNear_m &&
             std::abs(mark.tick - other.tick) < same_ticks;
    });
    if (!near_another && kept.size() < kMarksMax) kept.push_back(mark);
  }
  return kept;
}

}  // namespace

std::vector<Mark> MarksBefore(const Recording& recording, int peer, double tick, double span) {
  const double same = kSameMeeting_s * recording.room.tick_hz;
  std::vector<Push> pushes;
  for (const Impacts& impacts : recording.impacts) {
    const auto at = static_cast<double>(impacts.tick);
    if (impacts.peer != peer || at > tick || at <= tick - span - same) continue;
    for (std::size_t i = 0; i < impacts.dv.size(); ++i)
      pushes.push_back({at,
                        {std::min<int>(impacts.id_a[i], impacts.id_b[i]),
                         std::max<int>(impacts.id_a[i], impacts.id_b[i])},
                        {at, {impacts.x[i], impacts.y[i]}, impacts.dv[i]}});
  }
  std::stable_sort(pushes.begin(), pushes.end(),
                   [](const Push& a, const Push& b) { return a.tick < b.tick; });
  std::vector<Mark> marks;
  std::map<std::pair<int, int>, Mark> last;  // by pair, marked or not
  for (const Push& push : pushes) {
    const bool ground = push.pair.first < 0;
    const auto before = last.find(push.pair);
    const bool again = before != last.end() && push.tick - before->second.tick <= same &&
                       push.mark.dv < kStronger * before->second.dv;
    // A contact keeps the strength of its strongest impulse, so that its echoes are not marked.
    Mark kept = push.mark;
    if (again) kept.dv = std::max(kept.dv, before->second.dv);
    last[push.pair] = kept;
    if (again || push.mark.dv < (ground ? kGroundShownMin : kShownMin)) continue;
    if (push.tick > tick - span) marks.push_back(push.mark);
  }
  return Thinned(std::move(marks), same);
}

}  // namespace seam
