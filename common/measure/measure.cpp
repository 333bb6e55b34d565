#include "common/measure/measure.h"

#include <algorithm>

#include "common/measure/parts.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/screen.h"
#include "common/scene/assembly.h"

namespace seam {
namespace {

/// Returns the masses of the watched parts' moving assemblies, by id, kg.
std::map<PartId, double> StruckMasses(const Scene& scene, const Composition& composition,
                                      const WatchCollision& watch) {
  std::map<PartId, double> masses;
  for (const PartId struck : watch.struck) {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(struck)];
    const Assembly& assembly = composition.assemblies[static_cast<std::size_t>(index)];
    if (assembly.anchored) continue;
    double mass = 0;
    for (const PartId part : assembly.parts) {
      mass += double{PartMass(scene.parts[static_cast<std::size_t>(part)])};
    }
    masses[assembly.id] = mass;
  }
  return masses;
}

/// Returns the mean rebound of the watched collisions that can be measured.
std::optional<double> MeanRebound(const Recording& recording, const Oracle& oracle,
                                  const Scene& scene, const Composition& composition) {
  double sum = 0;
  int count = 0;
  for (const WatchCollision& watch : scene.watch) {
    const auto masses = StruckMasses(scene, composition, watch);
    const std::optional<double> rebound = Rebound(recording, oracle, masses, watch.around_tick);
    if (!rebound) continue;
    sum += *rebound;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace

double TickSeconds(const Recording& recording) { return 1.0 / std::max(1, recording.room.tick_hz); }

Measures Measure(const Recording& recording, const Oracle& oracle) {
  Measures measures;
  MeasureError(recording, oracle, &measures);
  measures.rest_ticks = RestTicks(recording, oracle);
  measures.jitter_rest_mps = RestJitter(recording, oracle);
  MeasureCost(recording, &measures);
  std::map<PartId, int> mechanisms;
  std::optional<RevisionHistory> revisions;
  if (!recording.room.scene_text.empty()) {
    const Scene scene = RecordedScene(recording.room);
    revisions.emplace(scene, recording);
    const Composition& composition = revisions->At(0)->composition();
    for (const Assembly& assembly : composition.assemblies) {
      if (assembly.mechanism >= 0) mechanisms[assembly.id] = assembly.mechanism;
    }
    measures.rebound = MeanRebound(recording, oracle, scene, composition);
    MeasureDisplayed(recording, oracle, *revisions, &measures);
    MeasureChanges(recording, *revisions, &measures);
    MeasureKinetic(recording, oracle, *revisions, &measures);
  }
  Screen screen(recording, revisions ? &*revisions : nullptr);
  MeasurePointError(recording, oracle, screen, &measures);
  MeasureServed(recording, screen, &measures);
  MeasureScreens(recording, oracle, revisions ? &*revisions : nullptr, screen, &measures);
  const RevisionHistory* changing = revisions && revisions->change() ? &*revisions : nullptr;
  MeasureSmoothness(recording, oracle, changing, &measures);
  MeasureSeam(recording, changing, &measures);
  MeasureHandover(recording, mechanisms, &measures, changing);
  return measures;
}

}  // namespace seam
