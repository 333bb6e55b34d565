#include "render/playback/camera.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {
namespace {

constexpr double kSmooth_s = 0.12;  ///< standard deviation of the smoothing in time
constexpr float kMargin = 0.06f;    ///< of the box, on each side
constexpr float kLeast_m = 1.5f;    ///< the smallest height and width that are shown
constexpr float kAlone = 3;         ///< box around a single mechanism, in multiples of its size
/// A picture without [camera] is at most so many times as large as a typical mechanism, except for
/// leading bodies. Larger: the mechanisms become specks; smaller: more of what moves is cut off.
constexpr float kAreaPerMechanism = 40;

constexpr double kSigma = kSmooth_s * kSamplesPerSecond;  ///< in samples
const int kReach = static_cast<int>(std::ceil(2 * kSigma));

/// Returns the boxes' means by a Gaussian in time.
std::vector<WorldBox> Mean(const std::vector<WorldBox>& raw) {
  const int count = static_cast<int>(raw.size());
  std::vector<WorldBox> means;
  for (int i = 0; i < count; ++i) {
    Vec2 min(0, 0), max(0, 0);
    float sum = 0;
    // The same number of neighbours on both sides; otherwise the ends would be pulled inwards.
    const int near = std::min({kReach, i, count - 1 - i});
    for (int k = -near; k <= near; ++k) {
      const auto weight = static_cast<float>(std::exp(-0.5 * k * k / (kSigma * kSigma)));
      min += weight * raw[static_cast<std::size_t>(i + k)].min;
      max += weight * raw[static_cast<std::size_t>(i + k)].max;
      sum += weight;
    }
    means.push_back({min / sum, max / sum});
  }
  return means;
}

/// Smooths boxes in time, and enlarges a box where smoothing would cut off more than the margin.
/// What is added begins before and ends after that moment, itself smooth: a mean of the largest
/// additions around.
std::vector<WorldBox> Smoothed(const std::vector<WorldBox>& raw) {
  std::vector<WorldBox> smooth = Mean(raw), lacks, added;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const Vec2 spare = 0.8f * kMargin * smooth[i].size();
    lacks.push_back({(raw[i].min + spare - smooth[i].min).cwiseMin(0.0f),
                     (raw[i].max - spare - smooth[i].max).cwiseMax(0.0f)});
  }
  const int count = static_cast<int>(raw.size());
  for (int i = 0; i < count; ++i) {
    WorldBox most{Vec2(0, 0), Vec2(0, 0)};
    for (int k = std::max(0, i - kReach); k <= std::min(count - 1, i + kReach); ++k) {
      most.min = most.min.cwiseMin(lacks[static_cast<std::size_t>(k)].min);
      most.max = most.max.cwiseMax(lacks[static_cast<std::size_t>(k)].max);
    }
    added.push_back(most);
  }
  added = Mean(added);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    smooth[i].min += added[i].min;
    smooth[i].max += added[i].max;
  }
  return smooth;
}

/// Returns the part with a name, or the vehicle of the player with that name.
PartId PartNamed(const Scene& scene, const std::string& name) {
  for (const Part& part : scene.parts) {
    if (part.name == name) return part.id;
  }
  for (const Player& player : scene.players) {
    if (player.name == name && player.vehicle >= 0) return player.vehicle;
  }
  std::vector<std::string> known;
  for (const Part& part : scene.parts) known.push_back(part.name);
  for (const Player& player : scene.players) {
    if (player.vehicle >= 0) known.push_back(player.name);
  }
  throw OperatorError("--follow " + name + ": the scene has no such part or vehicle" +
                      DidYouMean(name, known));
}

/// Returns the position of a part, in the oracle if known, else in the view.
std::optional<Vec2> PlaceOf(const CameraView& view, PartId part, double s) {
  const Playback& playback = *view.playback;
  const double tick = playback.TickAt(s);
  if (const auto truth = playback.Truth(part, tick)) return truth->position;
  const Moment moment = playback.MomentAt(playback.PeerOr(view.peer), tick);
  if (const auto shown = playback.FindPart(moment, part)) return shown->position;
  return std::nullopt;
}

/// Fills empty boxes from their neighbours, with `otherwise` if all are empty.
void FillHoles(std::vector<WorldBox>* boxes, const WorldBox& otherwise) {
  WorldBox last = otherwise;
  for (const WorldBox& box : *boxes) {
    if (box.empty()) continue;
    last = box;
    break;
  }
  for (WorldBox& box : *boxes) {
    if (box.empty()) box = last;
    last = box;
  }
}

/// Returns the median of the mechanisms' longer sides at a moment, m; 0 without any.
float TypicalMechanism(const CameraView& view, const std::set<PartId>& bodies, double s) {
  const Playback& playback = *view.playback;
  const Moment moment = playback.MomentAt(playback.PeerOr(view.peer), playback.TickAt(s));
  const Composition& made = playback.WorldOf(moment)->composition();
  std::map<int, WorldBox> boxes;
  ForEachPose(view, &bodies, s, [&](const BodyShapes& body, const Pose& pose, int) {
    const int assembly = made.assembly_of_part[static_cast<std::size_t>(body.id)];
    if (assembly < 0) return;
    boxes[made.assemblies[static_cast<std::size_t>(assembly)].mechanism].Add(body, pose);
  });
  std::vector<float> sides;
  for (const auto& [mechanism, box] : boxes) sides.push_back(box.size().maxCoeff());
  if (sides.empty()) return 0;
  const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
  std::nth_element(sides.begin(), middle, sides.end());
  return *middle;
}

/// Returns whole mechanisms: the bodies, and all that are jointed to them at a moment.
std::vector<std::set<PartId>> MechanismsOf(const CameraView& view, const std::set<PartId>& bodies,
                                           double s) {
  const Playback& playback = *view.playback;
  const Moment moment = playback.MomentAt(playback.PeerOr(view.peer), playback.TickAt(s));
  const auto world = playback.WorldOf(moment);
  const Composition& made = world->composition();
  std::map<int, std::set<PartId>> whole;
  for (const PartId body : bodies) {
    const int index = world->AssemblyOf(body);
    const int mechanism =
        index < 0 ? -1 : made.assemblies[static_cast<std::size_t>(index)].mechanism;
    if (mechanism < 0) continue;
    for (const int member : made.mechanisms[static_cast<std::size_t>(mechanism)].assemblies)
      whole[mechanism].insert(made.assemblies[static_cast<std::size_t>(member)].id);
  }
  std::vector<std::set<PartId>> mechanisms;
  for (auto& [mechanism, members] : whole) mechanisms.push_back(std::move(members));
  return mechanisms;
}

/// The bodies of a picture that fits what moves in a scene without [camera], and its limits.
class FreeFit {
 public:
  FreeFit(const std::vector<CameraView>& views, double from_s, double to_s)
      : views_(views),
        leading_(LeadingBodies(views, from_s, to_s)),
        bodies_(MovingBodies(views, from_s, to_s)) {
    bodies_.insert(leading_.begin(), leading_.end());
    most_m_ = kAreaPerMechanism * TypicalMechanism(views.front(), bodies_, from_s);
  }
  const std::set<PartId>& bodies() const { return bodies_; }

  /// Returns the box at a moment. It is cut off where it would be larger than kAreaPerMechanism
  /// around the leading bodies, or around the median body if there are none.
  WorldBox At(double s) const {
    WorldBox box = BoxOf(views_, bodies_, s);
    WorldBox window = BoxOf(views_, leading_, s);
    if (box.empty()) return box;
    const Vec2 middle = window.empty() ? MedianPlace(s) : window.centre();
    window.Add(middle, most_m_ / 2);
    box.min = box.min.cwiseMax(window.min);
    box.max = box.max.cwiseMin(window.max);
    return box;
  }

 private:
  Vec2 MedianPlace(double s) const {
    std::vector<Vec2> places;
    for (const CameraView& view : views_) {
      ForEachPose(view, &bodies_, s, [&](const BodyShapes&, const Pose& pose, int) {
        places.push_back(pose.position);
      });
    }
    const auto half = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    Vec2 median(0, 0);
    for (int axis = 0; axis < 2; ++axis) {
      std::nth_element(places.begin(), half, places.end(),
                       [axis](const Vec2& a, const Vec2& b) { return a[axis] < b[axis]; });
      median[axis] = (*half)[axis];
    }
    return median;
  }

  const std::vector<CameraView>& views_;
  const std::set<PartId> leading_;
  std::set<PartId> bodies_;
  float most_m_ = 0;
};

}  // namespace

WorldBox ActionArea(const std::vector<CameraView>& views, double from_s, double to_s) {
  const Camera& camera = views.front().playback->scene().camera;
  const WorldBox own{camera.min, camera.max};
  if (camera.given) return own;
  const FreeFit fit(views, from_s, to_s);
  WorldBox area;
  for (const double s : SampleTimes(from_s, to_s)) area.Add(fit.At(s));
  return area.empty() ? own : area;
}

CameraPath::CameraPath(const std::vector<CameraView>& views, const CameraWish& wish, double from_s,
                       double to_s)
    : from_s_(from_s), zoom_(wish.zoom) {
  const Scene& scene = views.front().playback->scene();
  const WorldBox own{scene.camera.min, scene.camera.max};
  const std::vector<double> times = SampleTimes(from_s, to_s);
  PartId followed = scene.camera.follow;
  Vec2 size = scene.camera.max - scene.camera.min;
  if (wish.kind == CameraWish::Kind::kFollow) {
    followed = PartNamed(scene, wish.part);
    if (wish.height > 0) size *= wish.height / size.y();
  }
  if (wish.kind == CameraWish::Kind::kFixed) {
    const Vec2 half = Vec2(wish.height * size.x() / size.y(), wish.height) / 2;
    boxes_ = {{wish.centre - half, wish.centre + half}};
    return;
  }
  if (followed >= 0) {
    for (const double s : times) {
      const std::optional<Vec2> place = PlaceOf(views.front(), followed, s);
      WorldBox box;
      if (place) box = {*place - size / 2, *place + size / 2};
      boxes_.push_back(box);
    }
    FillHoles(&boxes_, own);
    boxes_ = Smoothed(boxes_);
    return;
  }
  if (wish.kind == CameraWish::Kind::kScene) {
    boxes_ = {ActionArea(views, from_s, to_s)};
    return;
  }
  std::set<PartId> bodies = wish.bodies;
  const auto mechanisms = MechanismsOf(views.front(), bodies, (from_s + to_s) / 2);
  for (const std::set<PartId>& whole : mechanisms) bodies.insert(whole.begin(), whole.end());
  if (bodies.empty() && !scene.camera.given) {
    const FreeFit fit(views, from_s, to_s);
    bodies = fit.bodies();
    for (const double s : times) boxes_.push_back(fit.At(s));
  } else {
    if (bodies.empty()) bodies = MovingBodies(views, from_s, to_s);
    for (const double s : times) {
      WorldBox box = BoxOf(views, bodies, s);
      // A body flung out of the scene's box must not make the rest of the picture tiny.
      if (!box.empty() && wish.bodies.empty()) {
        const WorldBox cut{box.min.cwiseMax(own.min), box.max.cwiseMin(own.max)};
        if (!cut.empty() && cut.min.y() < cut.max.y()) box = cut;
      }
      boxes_.push_back(box);
    }
  }
  FillHoles(&boxes_, own);
  boxes_ = Smoothed(boxes_);
  for (WorldBox& box : boxes_) {
    const bool alone = bodies.size() == 1 || mechanisms.size() == 1;
    const float around = alone ? kAlone : 1 + 2 * kMargin;
    const Vec2 wanted = (box.size() * around).cwiseMax(Vec2(kLeast_m, kLeast_m));
    const Vec2 centre = box.centre();
    box = {centre - wanted / 2, centre + wanted / 2};
  }
}

WorldBox CameraPath::At(double s) const {
  const auto last = static_cast<double>(boxes_.size() - 1);
  const double place = std::clamp((s - from_s_) * kSamplesPerSecond, 0.0, last);
  const auto i = static_cast<std::size_t>(place);
  const auto share = static_cast<float>(place - static_cast<double>(i));
  const WorldBox& a = boxes_[i];
  const WorldBox& b = boxes_[std::min(i + 1, boxes_.size() - 1)];
  const WorldBox box{a.min + share * (b.min - a.min), a.max + share * (b.max - a.max)};
  const Vec2 half = box.size() / 2 / zoom_, centre = box.centre();
  return {centre - half, centre + half};
}

}  // namespace seam
