#include "render/playback/playback.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/measure/revisions.h"
#include "common/scene/bricks.h"
#include "common/scene/player_colours.h"
#include "common/sync/method.h"
#include "common/topology/feather_blast.h"

namespace seam {
namespace {

/// Returns the body's index in a view, or npos.
std::size_t PlaceOf(const View& view, PartId id) {
  const int i = IndexOf(view, id);
  return i < 0 ? std::string::npos : static_cast<std::size_t>(i);
}

/// Greatest number of revisions with cached shapes.
constexpr std::size_t kDrawnRevisionsMax = 64;

Pose PoseIn(const View& view, std::size_t i) { return {{view.x[i], view.y[i]}, view.angle[i]}; }

Pose Blend(const Pose& a, const Pose& b, float blend) {
  return {a.position + blend * (b.position - a.position), a.angle + blend * (b.angle - a.angle)};
}

/// Views further apart than this are a gap in the recording and not interpolated, ticks.
constexpr std::int64_t kGapTicksMax = 12;

Scene SceneOf(const Recording& recording) { return RecordedScene(recording.room); }

}  // namespace

Playback::Playback(Recording recording, std::optional<Oracle> oracle)
    : recording_(std::make_shared<const Recording>(std::move(recording))),
      scene_(SceneOf(*recording_)),
      oracle_(std::move(oracle)) {
  Prepare();
  if (oracle_) MeasureErrors();
}

Playback::Playback(Recording recording, Scene scene, std::optional<Oracle> oracle)
    : recording_(std::make_shared<const Recording>(std::move(recording))),
      scene_(std::move(scene)),
      oracle_(std::move(oracle)) {
  Prepare();
  if (oracle_) MeasureErrors();
}

Playback::Playback(const Recording* growing, std::optional<Oracle> oracle)
    : recording_(std::shared_ptr<const Recording>(), growing),
      scene_(SceneOf(*growing)),
      oracle_(std::move(oracle)) {
  Prepare();
}

void Playback::Prepare() {
  player_colours_ = PlayerColours(scene_);
  const auto given = [](const std::string& colour) { return !colour.empty(); };
  if (std::none_of(player_colours_.begin(), player_colours_.end(), given)) player_colours_.clear();
  revisions_ = std::make_shared<KnownRevisions>();
  const auto revision = AllRevisions().At(0);
  if (!scene_.bricks.empty()) bricks_ = std::make_shared<FeatherStore>(scene_.bricks);
  revisions_->first = Drawn(revision);
  imposed_.emplace(scene_, Compose(scene_));
}

const RevisionHistory& Playback::AllRevisions() const {
  if (revisions_->all == nullptr || revisions_->edits != recording_->edits.size()) {
    revisions_->all = std::make_unique<RevisionHistory>(scene_, *recording_);
    revisions_->edits = recording_->edits.size();
    revisions_->drawn.clear();
  }
  return *revisions_->all;
}

std::shared_ptr<const DrawnRevision> Playback::Drawn(
    const std::shared_ptr<const SceneRevision>& revision) const {
  auto drawn =
      std::make_shared<DrawnRevision>(seam::RevisionOf(revision->scene(), revision->composition()));
  drawn->bricks = bricks_;
  const bool freed = !FreedBricks(scene_.bricks, revision->scene().parts).empty();
  // The topology's own store lives as long as its revision.
  if (freed) drawn->bricks = {revision, &revision->topology.BricksLeft()};
  return drawn;
}

std::shared_ptr<const DrawnRevision> Playback::RevisionAfter(int edits) const {
  const RevisionHistory& all = AllRevisions();
  const int key = all.Key(edits);
  if (key == 0) return revisions_->first;
  const auto known = revisions_->drawn.find(key);
  if (known != revisions_->drawn.end()) return known->second;
  if (revisions_->drawn.size() >= kDrawnRevisionsMax)
    revisions_->drawn.erase(revisions_->drawn.begin());
  const auto drawn = Drawn(all.At(key));
  revisions_->drawn[key] = drawn;
  return drawn;
}

std::shared_ptr<const DrawnRevision> Playback::RevisionOf(const Moment& moment) const {
  return RevisionAfter(moment.before == nullptr ? 0 : moment.before->revision);
}

std::shared_ptr<const SceneRevision> Playback::WorldOf(const Moment& moment) const {
  return AllRevisions().At(moment.before == nullptr ? 0 : moment.before->revision);
}

void Playback::MeasureErrors() {
  measures_ = Measure(*recording_, *oracle_);
  error_first_tick_ = measures_->first_tick;
  Keep(-1, *measures_);
  // A peer's curve is the measure of a recording with this peer's views alone.
  for (const auto& [peer, views] : recording_->views) {
    Recording alone;
    alone.views[peer] = views;
    alone.first_tick = recording_->first_tick;
    alone.last_tick = recording_->last_tick;
    alone.room.tick_hz = recording_->room.tick_hz;
    const Measures own = recording_->views.size() == 1 ? *measures_ : Measure(alone, *oracle_);
    Keep(peer, own);
    if (own.view_age_ms) view_ages_ms_[peer] = *own.view_age_ms;
  }
}

/// True if a measure compared views at the tick. Otherwise its error is 0, and a picture must not
/// show that as no error.
bool Playback::Compared(int peer, std::int64_t tick) const {
  if (oracle_->ids.empty() || !oracle_->At(tick, oracle_->ids.front())) return false;
  for (const auto& [from, views] : recording_->views)
    if ((peer < 0 || from == peer) && views.count(tick) > 0) return true;
  return false;
}

/// Copies a measure's errors by tick to a peer's.
void Playback::Keep(int peer, const Measures& measures) {
  std::vector<double>& errors = errors_[peer];
  for (std::size_t i = 0; i < measures.shown_error_by_tick_m.size(); ++i) {
    const std::int64_t tick = measures.first_tick + static_cast<std::int64_t>(i);
    if (tick < error_first_tick_ || !Compared(peer, tick)) continue;
    const auto place = static_cast<std::size_t>(tick - error_first_tick_);
    if (place >= errors.size()) errors.resize(place + 1, std::numeric_limits<double>::quiet_NaN());
    errors[place] = measures.shown_error_by_tick_m[i];
  }
}

double Playback::first_s() const { return static_cast<double>(recording_->first_tick) / tick_hz(); }

double Playback::last_s() const {
  return static_cast<double>(std::max(recording_->last_tick, recording_->first_tick)) / tick_hz();
}

std::vector<int> Playback::peers() const {
  std::vector<int> peers;
  for (const auto& [peer, views] : recording_->views)
    if (!views.empty()) peers.push_back(peer);
  return peers;
}

int Playback::PeerOr(int peer) const {
  const std::vector<int> all = peers();
  if (std::find(all.begin(), all.end(), peer) != all.end()) return peer;
  return all.empty() ? -1 : all.front();
}

int Playback::PlayerOf(int peer) const {
  // A peer drives a player if it has authority over the player's own vehicle in its last view. A
  // vehicle without an owner does not count: authority over it goes by region.
  const auto owned = [this](const BodyShapes& body) {
    return std::any_of(body.parts.begin(), body.parts.end(), [&](PartId part) {
      const int owner = scene_.parts[static_cast<std::size_t>(part)].owner;
      return owner >= 0 && owner == body.owner_player;
    });
  };
  const auto views = recording_->views.find(peer);
  if (peer <= 0 || views == recording_->views.end() || views->second.empty()) return -1;
  const View& last = views->second.rbegin()->second;
  const auto revision = RevisionAfter(last.revision);
  for (const BodyShapes& body : revision->moving) {
    const std::size_t i = owned(body) ? PlaceOf(last, body.id) : std::string::npos;
    if (i != std::string::npos && last.authority[i] == peer) return body.owner_player;
  }
  // No vehicle found (a central server has them all): players join in the scene's order.
  return peer <= static_cast<int>(scene_.players.size()) ? peer - 1 : -1;
}

const std::string& Playback::PartName(PartId part) const {
  static const std::string none;
  const bool known = part >= 0 && static_cast<std::size_t>(part) < scene_.parts.size();
  return known ? scene_.parts[static_cast<std::size_t>(part)].name : none;
}

std::string Playback::PeerName(int peer) const {
  if (peer == 0) return policy().IsOracle() ? "oracle" : "server";
  const int player = PlayerOf(peer);
  const std::string number = "peer " + std::to_string(peer);
  if (player < 0) return number;
  const std::string& name = scene_.players[static_cast<std::size_t>(player)].name;
  return name.empty() ? number : name + " (" + number + ")";
}

std::string Playback::Method() const {
  const Room& room = recording_->room;
  const std::string variant = VariantOf(room);
  return variant.empty() ? room.mode : room.mode + " · " + variant;
}

Moment Playback::MomentAt(int peer, double tick) const {
  Moment moment;
  moment.tick = tick;
  const auto found = recording_->views.find(peer);
  if (found == recording_->views.end()) return moment;
  const auto& views = found->second;
  auto after = views.upper_bound(static_cast<std::int64_t>(std::floor(tick)));
  if (after == views.begin()) return moment;
  const auto before = std::prev(after);
  moment.before = &before->second;
  moment.after = moment.before;
  if (after == views.end() || after->first - before->first > kGapTicksMax) return moment;
  moment.after = &after->second;
  moment.blend = static_cast<float>((tick - static_cast<double>(before->first)) /
                                    static_cast<double>(after->first - before->first));
  return moment;
}

std::optional<Shown> Playback::Find(const Moment& moment, PartId id) const {
  if (moment.before == nullptr) return std::nullopt;
  const std::size_t i = PlaceOf(*moment.before, id);
  if (i == std::string::npos) return std::nullopt;
  Shown shown;
  shown.pose = PoseIn(*moment.before, i);
  shown.role = moment.before->role[i];
  shown.authority = moment.before->authority[i];
  const std::size_t j = moment.blend > 0 ? PlaceOf(*moment.after, id) : std::string::npos;
  double age = double{moment.before->age[i]};
  if (j != std::string::npos) {
    shown.pose = Blend(shown.pose, PoseIn(*moment.after, j), moment.blend);
    age += double{moment.blend} * (double{moment.after->age[j]} - age);
  }
  shown.tick = moment.tick - age;
  return shown;
}

std::optional<Pose> Playback::FindPart(const Moment& moment, PartId part) const {
  const auto world = WorldOf(moment);
  const int of = world->AssemblyOf(part);
  if (of < 0) return std::nullopt;
  const Assembly& assembly = world->composition().assemblies[static_cast<std::size_t>(of)];
  const Part& own = world->scene().parts[static_cast<std::size_t>(part)];
  if (assembly.anchored) return Pose{own.position, own.angle};
  const std::optional<Shown> shown = Find(moment, assembly.id);
  if (!shown) return std::nullopt;
  BodyState body;
  body.position = shown->pose.position;
  body.angle = shown->pose.angle;
  const BodyState state = StateOfPart(world->scene(), assembly, part, body);
  return Pose{state.position, state.angle};
}

std::optional<Pose> Playback::Truth(PartId id, double tick) const {
  if (!oracle_) return std::nullopt;
  std::optional<BodyState> state = oracle_->AtMoment(tick, id);
  if (!state) state = oracle_->At(static_cast<std::int64_t>(std::floor(tick)), id);
  return state ? std::optional<Pose>(Pose{state->position, state->angle}) : std::nullopt;
}

Pose Playback::Anchored(const BodyShapes& body, double tick) const {
  if (body.imposed < 0) return body.start;
  const BodyState now = imposed_->At(body.imposed, tick);
  return {now.position, now.angle};
}

std::optional<double> Playback::ViewAgeMs(int peer) const {
  const auto found = view_ages_ms_.find(peer);
  return found == view_ages_ms_.end() ? std::nullopt : std::optional<double>(found->second);
}

void Playback::MeasureTick(std::int64_t tick) {
  if (!oracle_) return;
  Recording now;  // without the scene's text, so that only poses are measured
  now.first_tick = now.last_tick = tick;
  for (const auto& [peer, views] : recording_->views) {
    const auto view = views.find(tick);
    if (view != views.end()) now.views[peer][tick] = view->second;
  }
  if (errors_.empty()) error_first_tick_ = tick;
  Keep(-1, Measure(now, *oracle_));
  for (const auto& [peer, views] : now.views) {
    Recording alone = now;
    alone.views = {{peer, views}};
    Keep(peer, Measure(alone, *oracle_));
  }
}

double Playback::TickAt(double seconds) const {
  const double tick = seconds * tick_hz();
  const double whole = std::round(tick);
  return std::abs(tick - whole) < 1e-6 ? whole : tick;
}

const std::vector<double>& Playback::ErrorByTick(int peer) const {
  static const std::vector<double> none;
  const auto found = errors_.find(peer);
  return found == errors_.end() ? none : found->second;
}

std::optional<double> Playback::ErrorAt(int peer, double tick) const {
  const std::vector<double>& errors = ErrorByTick(peer);
  const auto i = static_cast<std::int64_t>(std::floor(tick)) - error_first_tick_;
  if (i < 0 || i >= static_cast<std::int64_t>(errors.size())) return std::nullopt;
  const double error = errors[static_cast<std::size_t>(i)];
  return std::isnan(error) ? std::nullopt : std::optional<double>(error);
}

}  // namespace seam
