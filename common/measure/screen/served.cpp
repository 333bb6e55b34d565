/// Inputs that came too late for the server of mode central, and clients' views against its own.

#include <algorithm>

#include "common/measure/mean_square.h"
#include "common/measure/pose.h"
#include "common/measure/screen/screen.h"
#include "common/sync/method.h"

namespace seam {
namespace {

struct Arrived {
  std::int64_t us = 0;  // on the server's clock
  Input input;
};
using ArrivedByTick = std::map<std::int64_t, Arrived>;

ArrivedByTick ArrivalsOf(const std::map<std::int64_t, Inputs>& messages) {
  ArrivedByTick arrivals;
  for (const auto& [first_tick, message] : messages) {
    for (std::size_t i = 0; i < message.drive.size(); ++i) {
      const Input input{message.drive[i], message.lift[i], message.buttons[i]};
      Arrived& arrived =
          arrivals
              .try_emplace(first_tick + static_cast<std::int64_t>(i), Arrived{message.utime, input})
              .first->second;
      arrived.us = std::min(arrived.us, message.utime);
    }
  }
  return arrivals;
}

/// Returns the input that the server held when it made the tick at `stepped_us`.
Input HeldAt(const ArrivedByTick& arrivals, std::int64_t tick, std::int64_t stepped_us) {
  for (auto at = arrivals.lower_bound(tick); at != arrivals.begin();) {
    --at;
    if (at->second.us <= stepped_us) return at->second.input;
  }
  return {};
}

std::int64_t CountLate(const Recording& recording, const std::map<std::int64_t, View>& server) {
  std::int64_t late = 0;
  for (const auto& [player, messages] : recording.inputs) {
    const ArrivedByTick arrivals = ArrivalsOf(messages);
    for (const auto& [tick, arrived] : arrivals) {
      const auto stepped = server.find(tick);
      if (stepped == server.end() || arrived.us <= stepped->second.utime) continue;
      late += HeldAt(arrivals, tick, stepped->second.utime) == arrived.input ? 0 : 1;
    }
  }
  return late;
}

double SquaredFrom(const View& view, std::size_t i, const View& server, std::size_t k,
                   Screen& screen) {
  const Extent& extent = screen.extents.Of(view.revision, view.id[i]);
  const double d =
      extent.Displacement(DoublePose(StateIn(view, i)), DoublePose(StateIn(server, k)));
  return d * d;
}

}  // namespace

void MeasureServed(const Recording& recording, Screen& screen, Measures* measures) {
  const Policy& policy = PolicyOf(recording.room);
  const auto server = recording.views.find(0);
  if (server == recording.views.end()) return;
  if (policy.StampsInputs(0)) measures->inputs_late = 0;
  if (!policy.RunsAhead()) return;
  measures->inputs_late = CountLate(recording, server->second);
  MeanSquare others;
  for (const auto& [peer, views] : recording.views) {
    for (auto at = views.begin(); peer != 0 && at != views.end(); ++at) {
      const View& view = at->second;
      const auto truth = server->second.find(at->first);
      if (truth == server->second.end()) continue;
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const int k = IndexOf(truth->second, view.id[i]);
        if (k < 0 || screen.own.Has(view, i)) continue;
        others.Add(SquaredFrom(view, i, truth->second, static_cast<std::size_t>(k), screen));
      }
    }
  }
  measures->error_served_m = others.Root();
}

}  // namespace seam
