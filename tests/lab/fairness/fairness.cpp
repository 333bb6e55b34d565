#include "tests/lab/fairness/fairness.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/check.h"
#include "common/measure/oracle.h"
#include "common/scene/assembly.h"
#include "tests/lab/fairness/lagging_net.h"
#include "tests/lab/fairness/mirrored_script.h"

namespace seam {
namespace {

/// Seconds from the crash: where the velocity before it and after it is taken.
constexpr double kBeforeFrom = -0.2, kBeforeTo = -0.1, kAfterFrom = 0.4, kAfterTo = 0.5;
/// A crash: so much of the closing speed is gone within a tick, and there was so much, m/s.
constexpr double kCrashShare = 0.5, kClosingMin = 5;
/// The two players' shares in the oracle are equal to this, or it is no mirrored crash.
constexpr double kMirrorTolerance = 0.02;

/// A player's car.
struct Car {
  PartId body = -1;   // assembly id
  double mass = 0;    // of its mechanism, kg
  double toward = 1;  // x direction in which the other car is
};

std::array<Car, 2> FindCars(const Scene& scene) {
  if (scene.players.size() != 2) throw OperatorError(scene.name + ": fairness is for two players");
  const Composition c = Compose(scene);
  std::array<Car, 2> cars;
  std::array<float, 2> x{};
  for (const std::size_t p : {0u, 1u}) {
    const PartId vehicle = scene.players[p].vehicle;
    if (vehicle < 0) throw OperatorError(scene.name + ": each player needs a vehicle");
    const auto of_part = [&c](PartId part) -> const Assembly& {
      const int assembly = c.assembly_of_part[static_cast<std::size_t>(part)];
      return c.assemblies[static_cast<std::size_t>(assembly)];
    };
    const Assembly& body = of_part(vehicle);
    cars[p].body = body.id;
    x[p] = scene.parts[static_cast<std::size_t>(vehicle)].position.x();
    for (const Part& part : scene.parts) {
      const bool own = !part.anchored && of_part(part.id).mechanism == body.mechanism;
      if (own) cars[p].mass += static_cast<double>(PartMass(part));
    }
  }
  cars[0].toward = x[0] < x[1] ? 1 : -1;
  cars[1].toward = -cars[0].toward;
  return cars;
}

/// Where one body is along x at a tick; nullopt where that is not known.
using Path = std::function<std::optional<double>(std::int64_t)>;

/// Mean velocity between two ticks, m/s.
std::optional<double> Velocity(const Path& path, std::int64_t from, std::int64_t to, double h) {
  const std::optional<double> a = path(from), b = path(to);
  if (!a || !b) return std::nullopt;
  return (*b - *a) / (static_cast<double>(to - from) * h);
}

std::optional<double> Momentum(const Path& path, const Car& car, std::int64_t crash, double h) {
  const auto at = [crash, h](double seconds) { return crash + std::llround(seconds / h); };
  const std::optional<double> before = Velocity(path, at(kBeforeFrom), at(kBeforeTo), h);
  const std::optional<double> after = Velocity(path, at(kAfterFrom), at(kAfterTo), h);
  if (!before || !after) return std::nullopt;
  return car.mass * car.toward * (*before - *after);
}

Path InOracle(const Oracle& oracle, PartId body) {
  return [&oracle, body](std::int64_t tick) -> std::optional<double> {
    const std::optional<BodyState> state = oracle.At(tick, body);
    if (!state) return std::nullopt;
    return static_cast<double>(state->position.x());
  };
}

Path InView(const Recording& recording, int peer, PartId body) {
  return [&recording, peer, body](std::int64_t tick) -> std::optional<double> {
    const auto views = recording.views.find(peer);
    if (views == recording.views.end()) return std::nullopt;
    const auto view = views->second.find(tick);
    if (view == views->second.end()) return std::nullopt;
    const auto& ids = view->second.id;
    const auto found = std::lower_bound(ids.begin(), ids.end(), body);
    if (found == ids.end() || *found != body) return std::nullopt;
    return static_cast<double>(view->second.x[static_cast<std::size_t>(found - ids.begin())]);
  };
}

/// Fills crash and closing_mps: the tick in which most of the closing speed is lost.
void FindCrash(const Oracle& oracle, const std::array<Car, 2>& cars, FairnessResult* result) {
  const auto closing = [&](std::int64_t tick) -> std::optional<double> {
    const auto a = oracle.At(tick, cars[0].body), b = oracle.At(tick, cars[1].body);
    if (!a || !b) return std::nullopt;
    return cars[0].toward * static_cast<double>(a->velocity.x() - b->velocity.x());
  };
  double most = 0;
  const auto last = oracle.first_tick + static_cast<std::int64_t>(oracle.ticks.size()) - 1;
  for (std::int64_t tick = oracle.first_tick + 1; tick <= last; ++tick) {
    const std::optional<double> before = closing(tick - 1), after = closing(tick);
    if (!before || !after || *before - *after <= most) continue;
    most = *before - *after;
    result->crash = tick;
    result->closing_mps = *before;
  }
  if (result->closing_mps < kClosingMin || most < kCrashShare * result->closing_mps) {
    result->invalid = "the cars did not meet";
  }
}

}  // namespace

FairnessResult JudgeFairness(const Recording& recording, int near) {
  const Scene scene = ParseScene(recording.room.scene_text, recording.room.scene_name);
  const std::array<Car, 2> cars = FindCars(scene);
  const double h = 1.0 / recording.room.tick_hz;
  const Oracle oracle = ComputeOracle(recording);
  FairnessResult result;
  FindCrash(oracle, cars, &result);
  if (!result.invalid.empty()) return result;
  std::array<double, 2> truth{};
  for (const std::size_t side : {0u, 1u}) {
    const std::size_t player =
        side == 0 ? static_cast<std::size_t>(near) : static_cast<std::size_t>(1 - near);
    const Car& car = cars[player];
    const auto of = [&](const Path& path) { return Momentum(path, car, result.crash, h); };
    const std::optional<double> in_oracle = of(InOracle(oracle, car.body));
    const std::optional<double> own = of(InView(recording, static_cast<int>(player) + 1, car.body));
    const std::optional<double> server = of(InView(recording, 0, car.body));
    if (!in_oracle || !own || !server) {
      result.invalid = "views about the crash are missing";
      return result;
    }
    truth[side] = *in_oracle;
    result.own_ns[side] = *own;
    result.server_ns[side] = *server;
  }
  result.oracle_ns = (truth[0] + truth[1]) / 2;
  if (std::abs(truth[1] - truth[0]) > kMirrorTolerance * std::abs(result.oracle_ns)) {
    result.invalid = "the crash is not mirrored in the oracle";
  }
  return result;
}

FairnessResult RunFairness(const FairnessRun& run) {
  SEAM_ASSERT(run.near == 0 || run.near == 1);
  SessionSettings session = run.session;
  session.impair = "perfect";
  ClusterConfig config = Configure(session);
  if (run.random) {
    const Scene scene = ParseScene(config.scene_text, session.scene);
    const double seconds = session.duration_s > 0 ? session.duration_s : scene.duration_s;
    config.scene_text = WithMirroredBots(scene, session.seed, seconds);
  }
  FindProfile(run.near_path);
  FindProfile(run.far_path);
  config.client_net = [&run](std::size_t player, std::unique_ptr<Net> net) {
    const bool is_near = player == static_cast<std::size_t>(run.near);
    // Each player's path has a seed of its own.
    const auto seed = static_cast<std::uint64_t>(run.session.seed) * 2 + player;
    return std::make_unique<LaggingNet>(std::move(net), is_near ? run.near_path : run.far_path,
                                        seed);
  };
  Recording recording;
  RequireScripts(RunSession(config, &recording));
  return JudgeFairness(recording, run.near);
}

}  // namespace seam
