#include "common/sync/rest/rest_watch.h"

#include <cmath>

#include "common/scene/saved/persist_state.h"

namespace seam {
namespace {

/// m. The engine lets a body sleep that creeps by 5 mm in its half second; a tall stack settles
/// more slowly than that for seconds.
constexpr float kStill = 0.001f, kCreep = 0.02f;
/// rad per metre of these distances: a corner of a 1 m box then moves as far by turning as by
/// shifting.
constexpr float kTurnWeight = 2;

}  // namespace

RestWatch::RestWatch(const World& world, const BodyTable& table)
    : world_(world), tracks_(table, BodyRule::kFresh) {
  StartAnew();
}

void RestWatch::StartAnew() {
  tracks_.Reset();
  for (int body = 0; body < world_.body_count(); ++body) {
    Track& track = tracks_[body];
    track.still = track.slow = {world_.Read(body), world_.tick()};
    track.looked = world_.tick();
  }
}

void RestWatch::Follow(const BodyState& now, float distance, Near* near) const {
  if ((now.position - near->pose.position).norm() <= distance &&
      std::fabs(now.angle - near->pose.angle) <= kTurnWeight * distance) {
    return;
  }
  *near = {now, world_.tick()};
}

void RestWatch::Look() {
  for (const int body : world_.present()) {
    Track& track = tracks_[body];
    if (track.looked != world_.tick() - 1) track.asleep_since = -1;  // it was not present
    track.looked = world_.tick();
    if (world_.awake(body)) {
      track.asleep_since = -1;
    } else if (track.asleep_since < 0) {
      track.asleep_since = world_.tick();
    }
    const BodyState now = world_.Read(body);
    Follow(now, kStill, &track.still);
    Follow(now, kCreep, &track.slow);
  }
}

void RestWatch::Persist(StateArchive& a) {
  a.Exactly(&tracks_, [&](Track* track) {
    a.Tick(&track->asleep_since);
    a.Tick(&track->looked);
    for (Near* near : {&track->still, &track->slow}) {
      seam::Persist(a, &near->pose);
      a.Tick(&near->since);
    }
  });
}

}  // namespace seam
