#include "render/draw/draw_ghosts.h"

#include <cmath>

namespace seam {

void VisitTruth(const Playback& playback, const DrawnRevision& revision, const Moment& moment,
                const GhostVisitor& visit) {
  if (!playback.has_oracle()) return;
  for (const BodyShapes& body : revision.moving) {
    const auto shown = playback.Find(moment, body.id);
    const std::optional<Pose> pose = shown ? std::optional<Pose>(shown->pose) : std::nullopt;
    const double tick = shown ? shown->tick : moment.tick;
    const auto whole = static_cast<std::int64_t>(std::floor(tick));
    if (body.parts.size() == 1 || playback.oracle().Together(whole, body.parts)) {
      const auto truth = playback.Truth(body.id, tick);
      if (truth) visit(body, *truth, pose);
      continue;
    }
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
      const auto truth = playback.Truth(body.parts[k], tick);
      if (!truth) continue;
      BodyShapes one;
      one.id = body.id;
      one.parts = {body.parts[k]};
      one.outlines = {body.outlines[k]};
      one.places = {body.places[k]};
      one.reach = body.reach;
      visit(one, FrameBehind(*truth, body.places[k]), pose);
    }
  }
}

}  // namespace seam
