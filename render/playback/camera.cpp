#include "render/playback/camera.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {
namespace {

constexpr double kSamplesPerSecond = 30;
constexpr double kSmooth_s = 0.12;  ///< standard deviation of the smoothing in time
constexpr float kMargin = 0.06f;    ///< of the box, on each side
constexpr float kLeast_m = 1.5f;    ///< the smallest height and width that are shown
constexpr float kAlone = 3;         ///< box around a single body, in multiples of its size
constexpr float kMoved_m = 0.1f;    ///< bodies that move less are not fitted
constexpr float kTurned_rad = 0.3f;

/// Visits the poses of each body in the oracle and in the view.
template <class Visit>
void ForEachPose(const CameraView& view, const std::set<PartId>* only, double s, Visit visit) {
  const Playback& playback = *view.playback;
  const double tick = playback.TickAt(s);
  const Moment moment = playback.MomentAt(playback.PeerOr(view.peer), tick);
  const auto revision = playback.RevisionOf(moment);
  for (const BodyShapes& body : revision->moving) {
    if (only != nullptr && only->count(body.id) == 0) continue;
    if (const auto truth = playback.Truth(body.id, tick)) visit(body, *truth, 0);
    if (const auto shown = playback.Find(moment, body.id)) visit(body, shown->pose, 1);
  }
}

std::vector<double> Samples(double from_s, double to_s) {
  std::vector<double> times;
  const auto count = static_cast<int>(std::ceil((to_s - from_s) * kSamplesPerSecond)) + 1;
  for (int i = 0; i < count; ++i) times.push_back(from_s + i / kSamplesPerSecond);
  return times;
}

/// Smooths boxes by a Gaussian in time, and enlarges a box where smoothing would cut off more than
/// the margin.
std::vector<WorldBox> Smoothed(const std::vector<WorldBox>& raw) {
  const double sigma = kSmooth_s * kSamplesPerSecond;
  const int reach = static_cast<int>(std::ceil(2 * sigma));
  const int count = static_cast<int>(raw.size());
  std::vector<WorldBox> smooth;
  for (int i = 0; i < count; ++i) {
    Vec2 min(0, 0), max(0, 0);
    float sum = 0;
    // The same number of neighbours on both sides; otherwise the ends would be pulled inwards.
    const int near = std::min({reach, i, count - 1 - i});
    for (int k = -near; k <= near; ++k) {
      const auto weight = static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma)));
      min += weight * raw[static_cast<std::size_t>(i + k)].min;
      max += weight * raw[static_cast<std::size_t>(i + k)].max;
      sum += weight;
    }
    WorldBox box{min / sum, max / sum};
    const Vec2 spare = 0.8f * kMargin * box.size();
    const WorldBox& must = raw[static_cast<std::size_t>(i)];
    box.min = box.min.cwiseMin(must.min + spare);
    box.max = box.max.cwiseMax(must.max - spare);
    smooth.push_back(box);
  }
  return smooth;
}

WorldBox SceneBox(const Scene& scene) { return {scene.camera.min, scene.camera.max}; }

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

}  // namespace

void WorldBox::Add(const Vec2& p, float radius) {
  min = min.cwiseMin(p - Vec2(radius, radius));
  max = max.cwiseMax(p + Vec2(radius, radius));
}

void WorldBox::Add(const BodyShapes& body, const Pose& pose) {
  const Frame2 frame(pose);
  for (const Outline& outline : body.outlines)
    for (const Vec2& p : outline.points) Add(frame(p), outline.radius);
}

void WorldBox::Add(const WorldBox& other) {
  min = min.cwiseMin(other.min);
  max = max.cwiseMax(other.max);
}

std::set<PartId> MovingBodies(const std::vector<CameraView>& views, double from_s, double to_s) {
  std::set<PartId> moving;
  for (const CameraView& view : views) {
    std::map<std::pair<PartId, int>, Pose> first;
    for (const double s : Samples(from_s, to_s)) {
      ForEachPose(view, nullptr, s, [&](const BodyShapes& body, const Pose& pose, int which) {
        const auto [known, fresh] = first.emplace(std::pair(body.id, which), pose);
        if (fresh) return;
        const Pose& before = known->second;
        const bool turned = !body.round && std::abs(pose.angle - before.angle) > kTurned_rad;
        if (turned || (pose.position - before.position).norm() > kMoved_m) moving.insert(body.id);
      });
    }
  }
  return moving;
}

WorldBox BoxOf(const std::vector<CameraView>& views, const std::set<PartId>& bodies, double s) {
  WorldBox box;
  for (const CameraView& view : views) {
    ForEachPose(view, &bodies, s,
                [&](const BodyShapes& body, const Pose& pose, int) { box.Add(body, pose); });
  }
  return box;
}

CameraPath::CameraPath(const std::vector<CameraView>& views, const CameraWish& wish, double from_s,
                       double to_s)
    : from_s_(from_s), zoom_(wish.zoom) {
  const Scene& scene = views.front().playback->scene();
  const WorldBox own = SceneBox(scene);
  const std::vector<double> times = Samples(from_s, to_s);
  PartId followed = scene.camera.follow;
  Vec2 size = own.size();
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
    boxes_ = {own};
    return;
  }
  const std::set<PartId> bodies =
      wish.bodies.empty() ? MovingBodies(views, from_s, to_s) : wish.bodies;
  for (const double s : times) {
    WorldBox box = BoxOf(views, bodies, s);
    // A body flung out of the scene's box must not make the rest of the picture tiny.
    if (!box.empty() && wish.bodies.empty()) {
      const WorldBox cut{box.min.cwiseMax(own.min), box.max.cwiseMin(own.max)};
      if (!cut.empty() && cut.min.y() < cut.max.y()) box = cut;
    }
    boxes_.push_back(box);
  }
  FillHoles(&boxes_, own);
  boxes_ = Smoothed(boxes_);
  for (WorldBox& box : boxes_) {
    const float around = bodies.size() == 1 ? kAlone : 1 + 2 * kMargin;
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
