#include "render/page/worlds.h"

#include <fmt/format.h>

#include "common/base/json_text.h"
#include "common/scene/water.h"
#include "common/topology/feather_blast.h"
#include "render/draw/draw_bricks.h"
#include "render/playback/camera.h"
#include "render/playback/held_regions.h"

namespace seam {
namespace {

std::string Point(const Vec2& p) {
  return fmt::format("{},{}", Thousandths(double{p.x()}), Thousandths(double{p.y()}));
}

/// Returns [kind, radius, x, y, ...]; kind 0: polygon, 1: disc (centre, rim point), 2: chain of
/// ground, 3: line.
std::string OutlineJson(const Outline& outline) {
  const bool disc = outline.kind == ShapeKind::kCircle;
  const bool chain = outline.kind == ShapeKind::kChain;
  const int kind = disc ? 1 : chain ? 2 : IsLine(outline.kind) ? 3 : 0;
  std::string json = fmt::format("[{},{}", kind, disc ? Thousandths(double{outline.radius}) : 0);
  for (const Vec2& p : outline.points) json += "," + Point(p);
  return json + "]";
}

std::string BodyJson(const BodyShapes& body, const std::string& name) {
  std::vector<std::string> outlines, rim;
  for (const Outline& outline : body.outlines) outlines.push_back(OutlineJson(outline));
  for (const auto& edge : body.rim)
    rim.push_back("[" + Point(edge[0]) + "," + Point(edge[1]) + "]");
  return fmt::format(
      R"({{"id":{},"name":{},"player":{},"leads":{},"reach":{},"shapes":{},"rim":{}}})", body.id,
      JsonText(name), body.owner_player, body.leads, Thousandths(double{body.reach}),
      JsonList(outlines), JsonList(rim));
}

std::string JointJson(const DrawnJoint& joint) {
  return fmt::format("[{},{},{},{},{}]", joint.a, Point(joint.anchor_a), joint.b,
                     Point(joint.anchor_b), joint.rod ? 1 : 0);
}

std::string WatersJson(const Scene& scene) {
  std::vector<std::string> waters;
  for (const Water& water : scene.waters)
    waters.push_back(fmt::format("[{},{}]", Point(water.min), Point(water.max)));
  return JsonList(waters);
}

std::string RegionsJson(const Playback& playback) {
  std::vector<std::string> regions;
  for (const PageRegion& region : RegionsOfPage(playback)) {
    std::vector<std::string> corners;
    for (const Vec2& corner : region.corners) corners.push_back(Point(corner));
    regions.push_back(fmt::format(R"({{"peer":{},"zone":{},"name":{},"corners":{}}})", region.peer,
                                  region.zone, JsonText(region.name), JsonList(corners)));
  }
  return JsonList(regions);
}

/// Returns the poses of a kinematic body tick by tick: [x, y, angle, ...].
std::string MotionJson(const Playback& playback, const BodyShapes& body) {
  std::vector<std::string> numbers;
  const Recording& recording = playback.recording();
  for (std::int64_t tick = recording.first_tick; tick <= recording.last_tick; ++tick) {
    const Pose pose = playback.Anchored(body, static_cast<double>(tick));
    numbers.push_back(fmt::format("{},{}", Point(pose.position), Thousandths(double{pose.angle})));
  }
  return fmt::format(R"({{"id":{},"path":{}}})", body.id, JsonList(numbers));
}

/// Returns the bricks that blasts have freed so far: [left, bottom, width, height], units of 5 cm.
std::string HolesJson(const Scene& scene) {
  std::vector<std::string> holes;
  for (const Brick& brick : FreedBricks(scene.bricks, scene.parts)) {
    const BrickField& field = scene.bricks[static_cast<std::size_t>(brick.kind)];
    holes.push_back(fmt::format("[{},{},{},{}]", brick.x, brick.y, field.width, field.height));
  }
  return JsonList(holes);
}

}  // namespace

PageWorlds::PageWorlds(const Playback& playback) : playback_(playback) { IndexOf(0); }

int PageWorlds::Pool(const std::string& body) {
  const auto [place, added] = pooled_.emplace(body, static_cast<int>(bodies_.size()));
  if (added) bodies_.push_back(body);
  return place->second;
}

int PageWorlds::IndexOf(int edits) {
  const Recording& recording = playback_.recording();
  if (revisions_ == nullptr || edits_ != recording.edits.size()) {
    edits_ = recording.edits.size();
    revisions_ = std::make_unique<const RevisionHistory>(playback_.scene(), recording);
  }
  const int key = revisions_->Key(edits);
  const auto known = index_of_key_.find(key);
  if (known != index_of_key_.end()) return known->second;
  const auto revision = revisions_->At(key);
  const DrawnRevision drawn = RevisionOf(revision->scene(), revision->composition());
  std::vector<std::string> moving, anchored, joints;
  const auto pooled = [&](const BodyShapes& body) {
    return Pool(BodyJson(body, revision->scene().parts[static_cast<std::size_t>(body.id)].name));
  };
  for (const BodyShapes& body : drawn.moving) moving.push_back(std::to_string(pooled(body)));
  for (const BodyShapes& body : drawn.anchored) {
    anchored.push_back(fmt::format("[{},{},{}]", pooled(body), Point(body.start.position),
                                   Thousandths(double{body.start.angle})));
  }
  for (const DrawnJoint& joint : drawn.joints) joints.push_back(JointJson(joint));
  const int index = static_cast<int>(worlds_.size());
  index_of_key_[key] = index;
  worlds_.push_back(fmt::format(R"({{"moving":{},"anchored":{},"joints":{},"holes":{}}})",
                                JsonList(moving), JsonList(anchored), JsonList(joints),
                                HolesJson(revision->scene())));
  return index;
}

std::string PageWorlds::TakeNewJson() {
  const auto since = [](const std::vector<std::string>& all, std::size_t taken) {
    return JsonList({all.begin() + static_cast<std::ptrdiff_t>(taken), all.end()});
  };
  std::string json =
      fmt::format(R"({{"body":{},"bodies":{},"world":{},"worlds":{}}})", bodies_taken_,
                  since(bodies_, bodies_taken_), worlds_taken_, since(worlds_, worlds_taken_));
  bodies_taken_ = bodies_.size();
  worlds_taken_ = worlds_.size();
  return json;
}

std::string PageWorlds::Json() const {
  std::vector<std::string> motions;
  for (const BodyShapes& body : playback_.anchored())
    if (body.imposed >= 0) motions.push_back(MotionJson(playback_, body));
  const Scene& scene = playback_.scene();
  std::vector<CameraView> views;
  for (const int peer : playback_.peers()) views.push_back({&playback_, peer});
  const WorldBox area = ActionArea(views, playback_.first_s(), playback_.last_s());
  std::vector<std::string> vehicles;
  for (const PartId id : VehicleBodies(playback_)) vehicles.push_back(std::to_string(id));
  return fmt::format(R"({{"bodies":{},"worlds":{},"motions":{},"waters":{},)"
                     R"("regions":{},"held":{},"vehicles":{},"camera":[{},{}]}})",
                     JsonList(bodies_), JsonList(worlds_), JsonList(motions), WatersJson(scene),
                     RegionsJson(playback_),
                     RegionsAreHeld(playback_) ? Thousandths(double{kHeldMargin}) : 0,
                     JsonList(vehicles), Point(area.min), Point(area.max));
}

PageBytes EncodeBricks(const Playback& playback) {
  std::vector<std::int64_t> columns[4];
  const auto first = playback.RevisionAfter(0);  // bricks freed later are in the worlds' holes
  const FeatherStore* store = first->bricks.get();
  for (int cell = 0; store != nullptr && cell < store->cell_count(); ++cell) {
    for (const BrickBlock& b : BlocksOf(*store, cell)) {
      const BrickKind& kind = store->kinds()[static_cast<std::size_t>(b.kind)];
      const int block[4] = {b.x, b.y, b.columns * kind.width, b.rows * kind.height};
      for (int i = 0; i < 4; ++i) columns[i].push_back(block[i]);
    }
  }
  PageBytes out;
  PutUnsigned(&out, columns[0].size());
  for (const auto& column : columns) PutFirstDifferences(&out, column);
  return out;
}

}  // namespace seam
