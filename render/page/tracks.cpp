#include "render/page/tracks.h"

#include <cmath>

#include "common/measure/screen/path.h"
#include "common/base/json_text.h"

namespace seam {
namespace {

/// Samples without a gap: [begin, end).
struct Span {
  std::size_t begin = 0, end = 0;
};

std::vector<Span> SpansOf(const std::vector<TrackSample>& samples) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i].tick != samples[i - 1].tick + 1) spans.push_back({i, i});
    spans.back().end = i + 1;
  }
  return spans;
}

void PutColumn(PageBytes* out, const std::vector<TrackSample>& samples,
               const std::vector<Span>& spans, double TrackSample::*field) {
  for (const Span& span : spans) {
    std::vector<std::int64_t> values;
    for (std::size_t i = span.begin; i < span.end; ++i)
      values.push_back(Thousandths(samples[i].*field));
    PutSecondDifferences(out, values);
  }
}

std::int64_t ErrorUnits(double error_m) {
  return error_m < 0 ? 0 : 1 + std::llround(std::min(error_m, 1e6) / kPageErrorUnit_m);
}

void PutTrack(PageBytes* out, const std::vector<TrackSample>& samples, std::int64_t first_tick,
              bool views) {
  const std::vector<Span> spans = SpansOf(samples);
  PutUnsigned(out, spans.size());
  std::int64_t end = first_tick;
  for (const Span& span : spans) {
    PutSigned(out, samples[span.begin].tick - end);
    PutUnsigned(out, span.end - span.begin);
    end = samples[span.end - 1].tick + 1;
  }
  for (const auto field : {&TrackSample::x, &TrackSample::y, &TrackSample::angle})
    PutColumn(out, samples, spans, field);
  if (!views) return;
  std::vector<std::int64_t> owners, errors, ages;
  for (const TrackSample& sample : samples) {
    owners.push_back(3 * sample.authority + sample.role);
    errors.push_back(ErrorUnits(sample.error_m));
    ages.push_back(std::llround(sample.age / kPageAgeUnit));
  }
  PutRuns(out, owners);
  PutFirstDifferences(out, errors);
  PutFirstDifferences(out, ages);
}

}  // namespace

Tracks TracksOf(const std::map<std::int64_t, View>& views, const Oracle* oracle) {
  Tracks tracks;
  for (const auto& [tick, view] : views) {
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      TrackSample sample{
          tick,         view.x[i], view.y[i],          view.angle[i], view.authority[i],
          view.role[i], -1,        double{view.age[i]}};
      const auto truth =
          oracle != nullptr ? oracle->AtMoment(MomentShown(view, i), view.id[i]) : std::nullopt;
      if (truth) {
        sample.error_m = std::hypot(sample.x - double{truth->position.x()},
                                    sample.y - double{truth->position.y()});
      }
      tracks[view.id[i]].push_back(sample);
    }
  }
  return tracks;
}

Tracks TruthOf(const Recording& recording, const Oracle& oracle) {
  Tracks tracks;
  for (const PartId id : ShownIds(recording)) {
    for (std::int64_t tick = recording.first_tick; tick <= recording.last_tick; ++tick) {
      const std::optional<BodyState> state = oracle.At(tick, id);
      if (!state) continue;
      tracks[id].push_back(
          {tick, state->position.x(), state->position.y(), state->angle, 0, 0, -1, 0});
    }
  }
  return tracks;
}

PageBytes EncodeTracks(const Tracks& tracks, std::int64_t first_tick, std::int64_t last_tick,
                       const std::function<int(std::int64_t)>& world_at, bool views) {
  PageBytes out;
  PutSigned(&out, first_tick);
  PutUnsigned(&out, static_cast<std::uint64_t>(last_tick - first_tick + 1));
  std::vector<std::int64_t> worlds;
  for (std::int64_t tick = first_tick; tick <= last_tick; ++tick) worlds.push_back(world_at(tick));
  PutRuns(&out, worlds);
  PutUnsigned(&out, tracks.size());
  for (const auto& [id, samples] : tracks) {
    PutSigned(&out, id);
    PutTrack(&out, samples, first_tick, views);
  }
  return out;
}

}  // namespace seam
