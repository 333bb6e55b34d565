#include "common/measure/screen/screen.h"

#include "common/measure/parts.h"
#include "common/measure/screen/blows.h"
#include "common/measure/screen/noticed.h"
#include "common/measure/screen/overlaps.h"
#include "common/measure/screen/path_error.h"

namespace seam {
namespace {

double RadiusOf(const std::vector<const View*>& views, PartId id, Screen& screen) {
  for (const View* view : views) {
    if (view != nullptr && IndexOf(*view, id) >= 0) {
      return screen.extents.Of(view->revision, id).radius();
    }
  }
  return 0;
}

void Watch(int peer, PartId id, const ShownBody& body, BodySeconds* seconds) {
  const std::vector<std::int64_t> moving = MovingTicks(body);
  for (const std::int64_t tick : moving) seconds->Move(peer, id, tick);
  if (moving.empty()) return;
  for (const auto look : {WrongVelocities, Stops, Kinks}) {
    for (const std::int64_t tick : look(body)) seconds->Notice(peer, id, tick);
  }
}

}  // namespace

void MeasureScreens(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory* revisions, Screen& screen, Measures* measures) {
  const double h = TickSeconds(recording);
  const int hz = std::max(1, recording.room.tick_hz);
  std::map<int, std::vector<const View*>> views;
  for (const auto& [peer, of_peer] : recording.views) {
    if (peer >= 1) views[peer] = ViewsByTick(recording, peer);
  }
  if (views.empty()) return;
  const RevisionHistory* changing =
      revisions != nullptr && revisions->change() ? revisions : nullptr;
  PathErrors errors;
  Blows blows(h);
  BodySeconds seconds(recording.first_tick, hz);
  for (const PartId id : ShownIds(recording)) {
    const BodyPath truth = TruePath(recording, oracle, id);
    const double radius = RadiusOf(views.begin()->second, id, screen);
    blows.Begin(id, truth, radius);
    for (const auto& [peer, of_peer] : views) {
      const BodyPath shown = ShownPath(recording, of_peer, changing, id);
      const ViewAges ages(shown, truth, radius, hz);
      const ShownBody body{shown, truth, ages, radius, h};
      errors.Add(of_peer, truth, ages, id, screen);
      blows.Show(peer, body);
      Watch(peer, id, body, &seconds);
    }
  }
  blows.Notice(&seconds);
  if (revisions != nullptr) {
    NoticeLinks(recording, oracle, *revisions, &seconds);
    NoticeOverlaps(recording, oracle, *revisions, screen, &seconds, measures);
  }
  errors.Report(h, measures);
  measures->seen = seconds.Share();
}

}  // namespace seam
