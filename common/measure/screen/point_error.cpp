/// Point error: the largest displacement of a point of a body between displayed and oracle's pose,
/// for other players' bodies and own bodies in clients' views, and for the server's view.

#include <cmath>

#include "common/measure/mean_square.h"
#include "common/measure/screen/screen.h"

namespace seam {

void MeasurePointError(const Recording& recording, const Oracle& oracle, Screen& screen,
                       Measures* measures) {
  MeanSquare others, own, server;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const std::optional<BodyState> truth = oracle.At(tick, view.id[i]);
        if (!truth) continue;
        const Extent& extent = screen.extents.Of(view.revision, view.id[i]);
        const double d = extent.Displacement(DoublePose(StateIn(view, i)), DoublePose(*truth));
        MeanSquare& kind = peer == 0 ? server : screen.own.Has(view, i) ? own : others;
        kind.Add(d * d);
      }
    }
  }
  measures->error_others_m = others.Root();
  measures->error_own_m = own.Root();
  measures->error_server_m = server.Root();
}

}  // namespace seam
