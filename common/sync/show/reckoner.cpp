#include "common/sync/show/reckoner.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// Speeds that closing may always add, m/s and rad/s: the extrapolation is off by more.
constexpr float kClosingSpeed = 2, kClosingSpin = 2;

/// Returns the arm from a body's origin to its centre of mass; zero for most bodies.
Vec2 ArmOf(const MassPoint& mass, float angle) {
  if (mass.centre == Vec2(0, 0)) return Vec2(0, 0);
  return Turned(mass.centre, angle);
}

}  // namespace

/// Newest state of a body, with its centre of mass.
struct Reckoner::Heard {
  int body = -1;
  MassPoint mass;
  BodyState state;
  std::int64_t tick = 0;
  Vec2 centre{0, 0};
};

/// Common motion of the bodies' centres, as of one rigid body.
struct Reckoner::Common {
  Vec2 centre{0, 0}, velocity{0, 0};
  Vec2 acceleration{0, 0};
  float spin = 0;
};

Reckoner::Reckoner(const World& world, const Snapshots& snapshots, const JointCloser& joints)
    : world_(world), snapshots_(snapshots), joints_(joints) {}
Reckoner::~Reckoner() = default;

Reckoner::Common Reckoner::CommonOf(const std::vector<Heard>& heard, const Snapshots& snapshots,
                                    float dt) {
  Common common;
  float mass = 0;
  for (const Heard& h : heard) {
    mass += h.mass.mass;
    common.centre += h.mass.mass * h.centre;
    common.velocity += h.mass.mass * h.state.velocity;
    common.acceleration += h.mass.mass * snapshots.Acceleration(h.body, h.tick, dt);
  }
  common.centre /= mass;
  common.velocity /= mass;
  common.acceleration /= mass;
  // The body hardest to turn adds its own spin; without it, centres close to each other would give
  // a random spin. Wheels do not add theirs: they spin by themselves.
  const auto root = std::max_element(
      heard.begin(), heard.end(),
      [](const Heard& a, const Heard& b) { return a.mass.inertia < b.mass.inertia; });
  float moment = root->mass.inertia * root->state.spin, inertia = root->mass.inertia;
  for (const Heard& h : heard) {
    const Vec2 arm = h.centre - common.centre;
    moment += h.mass.mass * Cross(arm, h.state.velocity);
    inertia += h.mass.mass * arm.squaredNorm();
  }
  common.spin = inertia > 0 ? moment / inertia : 0;
  return common;
}

void Reckoner::Begin(std::int64_t next) {
  next_ = next;
  const auto bodies = static_cast<std::size_t>(world_.body_count());
  done_.assign(world_.composition().mechanisms.size(), false);
  paths_.heard.resize(bodies);
  paths_.here.resize(bodies);
  paths_.there.resize(bodies);
  paths_.speed.resize(bodies);
  if (revision_ == world_.topology().revision()) return;
  revision_ = world_.topology().revision();
  flown_.assign(bodies, Flown{});
}

const Reckoner::Paths& Reckoner::Reckoned(int body) {
  const int m = world_.mechanism(body);
  if (!done_[static_cast<std::size_t>(m)]) {
    done_[static_cast<std::size_t>(m)] = true;
    Reckon(m);
  }
  return paths_;
}

void Reckoner::Reckon(int mechanism) {
  // Bodies with the newest tick move as one. Bodies with older states move singly: the common
  // motion at that time is not known any more. So do bodies of an anchored mechanism: the anchor
  // takes their momentum.
  std::int64_t newest = -1;
  const bool free = !joints_.anchored(mechanism);
  for (const int body : joints_.bodies(mechanism)) {
    newest = std::max(newest, snapshots_.newest_tick(body));
  }
  const int first = joints_.bodies(mechanism).front();
  if (free && joints_.bodies(mechanism).size() == 1 && newest >= 0 && snapshots_.falls(first)) {
    return Fly(first);
  }
  together_.clear();
  for (const int body : joints_.bodies(mechanism)) {
    const auto i = static_cast<std::size_t>(body);
    if (!snapshots_.has(body)) {
      paths_.here[i] = paths_.there[i] = world_.Read(body);
    } else if (!free || snapshots_.newest_tick(body) != newest) {
      paths_.here[i] = snapshots_.Extrapolate(body, next_ - 1, world_.dt(), kReckonShownMax);
      paths_.there[i] = snapshots_.Extrapolate(body, next_, world_.dt(), kReckonShownMax);
    } else {
      Heard h{body, world_.mass_point(body), snapshots_.newest(body), newest, Vec2(0, 0)};
      h.centre = h.state.position + ArmOf(h.mass, h.state.angle);
      together_.push_back(h);
    }
  }
  if (!together_.empty()) {
    const Common common = CommonOf(together_, snapshots_, world_.dt());
    MoveOn(common, newest, next_ - 1, &paths_.here);
    MoveOn(common, newest, next_, &paths_.there);
  }
  for (const int body : joints_.bodies(mechanism)) {
    paths_.speed[static_cast<std::size_t>(body)] = SpeedOf(body);
  }
  if (joints_.jointed(mechanism)) CloseJoints(mechanism);
}

void Reckoner::Fly(int body) {
  const auto i = static_cast<std::size_t>(body);
  paths_.here[i] = FlownTo(body, next_ - 1);
  const int ahead = IsPresent(world_.activity(body)) ? 1 : kShownEvery;
  const BodyState& then = FlownTo(body, next_ - 1 + ahead);
  const float seconds = static_cast<float>(ahead) * world_.dt();
  BodyState &here = paths_.here[i], &there = paths_.there[i];
  there = then;
  PathSpeed& speed = paths_.speed[i];
  speed.velocity = (then.position - here.position) / seconds;
  speed.spin = (then.angle - here.angle) / seconds;
  there.position = here.position + world_.dt() * speed.velocity;
  there.angle = here.angle + world_.dt() * speed.spin;
}

const BodyState& Reckoner::FlownTo(int body, std::int64_t tick) {
  Flown& flown = flown_[static_cast<std::size_t>(body)];
  const std::int64_t heard = snapshots_.newest_tick(body);
  const BodyState& newest = snapshots_.newest(body);
  const auto most = static_cast<std::int64_t>(kReckonShownMax / world_.dt());
  tick = std::clamp(tick, heard, heard + most);
  const bool known = flown.heard == heard && flown.at <= tick && flown.from == newest.position;
  if (!known) flown = {heard, heard, newest.position, newest};
  const float seconds = static_cast<float>(tick - flown.at) * world_.dt();
  if (tick > flown.at) flown.state = world_.AfterFlight(body, flown.state, seconds);
  flown.at = tick;
  return flown.state;
}

PathSpeed Reckoner::SpeedOf(int body) const {
  const auto i = static_cast<std::size_t>(body);
  const BodyState &here = paths_.here[i], &there = paths_.there[i];
  const Vec2 velocity = (there.position - here.position) / world_.dt();
  return {velocity, (there.angle - here.angle) / world_.dt()};
}

void Reckoner::CloseJoints(int mechanism) {
  const std::vector<int>& bodies = joints_.bodies(mechanism);
  open_.clear();
  for (const int body : bodies) open_.push_back(paths_.speed[static_cast<std::size_t>(body)]);
  for (const int body : bodies) {
    BodyState& from = paths_.heard[static_cast<std::size_t>(body)];
    from = snapshots_.has(body) ? snapshots_.newest(body) : world_.Read(body);
  }
  joints_.CloseMovedOn(mechanism, paths_.heard, &paths_.here);
  joints_.CloseMovedOn(mechanism, paths_.heard, &paths_.there);
  if (!IsMotion(mechanism)) return;
  for (const int body : bodies) paths_.speed[static_cast<std::size_t>(body)] = SpeedOf(body);
}

/// Returns true if the speeds that closing has added can come from the bodies' motion against each
/// other, or against the anchor.
bool Reckoner::IsMotion(int mechanism) const {
  const std::vector<int>& bodies = joints_.bodies(mechanism);
  Vec2 common(0, 0);
  float mass = 0;
  for (std::size_t i = 0; i < bodies.size() && !joints_.anchored(mechanism); ++i) {
    common += world_.mass(bodies[i]) * open_[i].velocity;
    mass += world_.mass(bodies[i]);
  }
  if (mass > 0) common /= mass;
  float fastest = 0, fastest_spin = 0;
  for (const PathSpeed& open : open_) {
    fastest = std::max(fastest, (open.velocity - common).norm());
    fastest_spin = std::max(fastest_spin, std::fabs(open.spin));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const PathSpeed closed = SpeedOf(bodies[i]);
    const float added = (closed.velocity - open_[i].velocity).norm();
    const float added_spin = std::fabs(closed.spin - open_[i].spin);
    if (added > kClosingSpeed + 2 * fastest) return false;
    if (added_spin > kClosingSpin + 2 * fastest_spin) return false;
  }
  return true;
}

/// Extrapolates all bodies in together_.
void Reckoner::MoveOn(const Common& common, std::int64_t newest, std::int64_t tick,
                      std::vector<BodyState>* states) const {
  const float forward = snapshots_.Forward(newest, tick, world_.dt(), kReckonShownMax);
  const Rotation<float> turn(common.spin * forward);
  const Vec2 gained = SpeedGained(common.acceleration, forward);
  const Vec2 centre =
      common.centre + forward * common.velocity + ShiftGained(common.acceleration, forward);
  for (const Heard& h : together_) {
    const Vec2 arm = h.centre - common.centre;
    const Vec2 own = h.state.velocity - common.velocity - common.spin * Vec2(-arm.y(), arm.x());
    BodyState& state = (*states)[static_cast<std::size_t>(h.body)];
    state = h.state;
    state.angle += forward * h.state.spin;
    state.position = centre + turn(Vec2(arm + forward * own)) - ArmOf(h.mass, state.angle);
    state.velocity = common.velocity + gained + turn(Vec2(h.state.velocity - common.velocity));
  }
}

}  // namespace seam
