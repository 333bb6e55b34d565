#include "common/measure/revisions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "common/measure/pose.h"
#include "common/scene/mass.h"
#include "common/scene/scene.h"
#include "common/sync/edits/edit_order.h"

namespace seam {
namespace {

/// Greatest number of cached revisions; one of a thousand parts takes half a megabyte. Others are
/// computed again when needed.
constexpr std::size_t kRevisionsMax = 64;
/// Greatest accepted edit number: kNumbersSlack and kNumbersPerEdit for each recorded edit. Bounds
/// the list, since a damaged number may be two thousand million. A log lacks a few edits, not most.
constexpr std::size_t kNumbersSlack = 65536, kNumbersPerEdit = 16;

/// A scene with the text and the name that it was parsed from.
struct ParsedScene {
  std::string text, name;
  Scene scene;
};

bool ChangesBodies(const Edit& edit) {
  return edit.As<std::monostate>() == nullptr && edit.As<PushEdit>() == nullptr &&
         edit.As<SeatEdit>() == nullptr;
}

}  // namespace

Scene RecordedScene(const Room& room) {
  thread_local std::optional<ParsedScene> last;
  if (!last || last->text != room.scene_text || last->name != room.scene_name) {
    last.reset();  // unless this one parses
    Scene scene = ParseScene(room.scene_text, room.scene_name + ".toml");
    last = ParsedScene{room.scene_text, room.scene_name, std::move(scene)};
  }
  return last->scene;
}

SceneRevision::SceneRevision(Topology made)
    : topology(std::move(made)), moving(MovingIndices(composition())) {
  for (const Assembly& assembly : composition().assemblies) {
    if (!assembly.anchored) ids.push_back(assembly.id);
  }
}

int SceneRevision::AssemblyOf(PartId part) const {
  const std::vector<int>& all = composition().assembly_of_part;
  const bool known = part >= 0 && static_cast<std::size_t>(part) < all.size();
  return known ? all[static_cast<std::size_t>(part)] : -1;
}

BodyState StateOfPart(const Scene& scene, const Assembly& assembly, PartId part,
                      const BodyState& body) {
  if (part == assembly.id) return body;
  const Part& own = scene.parts[static_cast<std::size_t>(part)];
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  const Eigen::Vector2d place = ToRootFrame(own, root, Eigen::Vector2d(0, 0));
  BodyState state = body;
  state.position = RootFrame(body).ToWorld(place).cast<float>();
  state.angle = static_cast<float>(double{body.angle} + double{own.angle} - double{root.angle});
  return state;
}

RevisionHistory::RevisionHistory(const Scene& scene, std::vector<Edit> edits)
    : edits_(std::move(edits)) {
  keys_.push_back(0);
  for (std::size_t n = 0; n < edits_.size(); ++n) {
    keys_.push_back(ChangesBodies(edits_[n]) ? static_cast<int>(n) + 1 : keys_.back());
  }
  revisions_[0] = std::make_shared<const SceneRevision>(Topology(scene));
}

RevisionHistory::RevisionHistory(const Scene& scene, const Recording& recording)
    : RevisionHistory(scene, EditsOf(recording)) {}

RevisionHistory::~RevisionHistory() = default;

int RevisionHistory::Key(int edits) const {
  const int last = static_cast<int>(keys_.size()) - 1;
  return keys_[static_cast<std::size_t>(std::clamp(edits, 0, last))];
}

std::shared_ptr<const SceneRevision> RevisionHistory::At(int edits) const {
  const int key = Key(edits);
  const std::lock_guard<std::mutex> lock(mutex_);
  auto place = revisions_.upper_bound(key);
  --place;  // 0 is always there
  if (place->first == key) return place->second;
  Topology topology = place->second->topology;
  topology.Apply({edits_.begin() + place->first, edits_.begin() + key});
  auto made = std::make_shared<const SceneRevision>(std::move(topology));
  revisions_[key] = made;
  if (revisions_.size() > kRevisionsMax) {
    auto farthest = std::next(revisions_.begin());
    if (std::abs(revisions_.rbegin()->first - key) > std::abs(farthest->first - key)) {
      farthest = std::prev(revisions_.end());
    }
    revisions_.erase(farthest);
  }
  return made;
}

bool RevisionHistory::SameBody(int edits_a, int edits_b, PartId id) const {
  if (Key(edits_a) == Key(edits_b)) return true;
  const auto a = At(edits_a), b = At(edits_b);
  const int of_a = a->AssemblyOf(id), of_b = b->AssemblyOf(id);
  if (of_a < 0 || of_b < 0) return false;
  const Assembly& one = a->composition().assemblies[static_cast<std::size_t>(of_a)];
  const Assembly& other = b->composition().assemblies[static_cast<std::size_t>(of_b)];
  return one.id == other.id && one.anchored == other.anchored && one.parts == other.parts;
}

std::optional<BodyState> RevisionHistory::InView(const View& view, PartId part,
                                                 std::size_t* index) const {
  int i = IndexOf(view, part);
  if (i >= 0) {
    *index = static_cast<std::size_t>(i);
    return StateIn(view, *index);
  }
  if (!change()) return std::nullopt;
  const auto revision = At(view.revision);
  const int of = revision->AssemblyOf(part);
  if (of < 0) return std::nullopt;
  const Assembly& assembly = revision->composition().assemblies[static_cast<std::size_t>(of)];
  i = IndexOf(view, assembly.id);
  if (i < 0) return std::nullopt;
  *index = static_cast<std::size_t>(i);
  return StateOfPart(revision->scene(), assembly, part, StateIn(view, *index));
}

std::vector<Edit> EditsOf(const Recording& recording) {
  std::vector<Edit> edits;
  const std::size_t most = kNumbersSlack + kNumbersPerEdit * recording.edits.size();
  for (const auto& [number, order] : recording.edits) {
    if (number < 0 || static_cast<std::size_t>(number) >= most) continue;
    edits.resize(static_cast<std::size_t>(number) + 1);
    edits.back() = ToEdit(order);
  }
  return edits;
}

const View* FindView(const std::map<std::int64_t, View>& views, std::int64_t tick) {
  const auto found = views.find(tick);
  return found == views.end() ? nullptr : &found->second;
}

int IndexOf(const View& view, PartId id) {
  const auto found = std::lower_bound(view.id.begin(), view.id.end(), id);
  if (found == view.id.end() || *found != id) return -1;
  return static_cast<int>(found - view.id.begin());
}

BodyState StateIn(const View& view, std::size_t i) {
  return BodyState{{view.x[i], view.y[i]}, view.angle[i], {view.vx[i], view.vy[i]}, view.spin[i]};
}

double MomentShown(const View& view, std::size_t i) {
  return static_cast<double>(view.tick) - double{view.age[i]};
}

std::int64_t TickShown(const View& view, std::size_t i) {
  return std::llround(MomentShown(view, i));
}

}  // namespace seam
