#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/cheat.h"
#include "tests/lab/experiment/probes.h"

namespace seam {
namespace {

Values AttackValues(const AttackOutcome& o, int tick_hz) {
  const bool acted = o.acted_tick >= 0;
  const double acted_s =
      acted ? static_cast<double>(o.acted_tick - o.first_tick) / static_cast<double>(tick_hz) : -1;
  return Judged("", {Count("lies", o.lies),
                     Decimals("acted_s", acted_s, 2),
                     {"step", ToString(static_cast<TrustStep>(o.step))},
                     {"others_step", ToString(static_cast<TrustStep>(o.others_step))},
                     Decimals("score", static_cast<double>(o.highest_score), 2),
                     Count("refused", o.refused),
                     Decimals("won", static_cast<double>(o.won), 1),
                     Decimals("hurt", static_cast<double>(o.hurt), 1),
                     Count("broken", o.broken)});
}

Values MeasureAttack(const ProbeRun& run) {
  ClusterConfig config = Configure(run.settings);
  // Shown, the server simulates all that somebody can see.
  config.keep = run.key.at("views") == "shown";
  return AttackValues(RunAttack(config, run.key.at("attack")), run.scene->solver.tick_hz);
}

void AddAttackFlags(Command& attack, ProbeOptions& options) {
  attack.Option("SCENES", options.scenes, "scene files or names").Required();
  AddTableFlag(attack, options.output).Required();
  attack.Option("--attack", options.attacks,
                "none | silence | x1.2 ...; repeatable (default: all)");
  attack.Option("--method", options.methods, "buffer | strict ...; repeatable (default: buffer)");
  attack.Option("--views", options.views, "shown: the server simulates all bodies; hidden: few")
      .OneOf({"shown", "hidden"});
  AddSessionFlags(attack, options);
  AddRunFlags(attack, options.output, "runs at a time (default: 1)");
}

ProbeAxis AttackAxis() {
  return {"attack", [](const ProbeOptions& options, const Scene&) {
            return options.attacks.empty() ? AttackNames() : options.attacks;
          }};
}

}  // namespace

Probe AttackProbe() {
  Probe probe;
  probe.command = "attack";
  probe.about = "what does a client that lies win?";
  probe.flags = AddAttackFlags;
  probe.defaults.output.jobs = 1;
  probe.key = {"version", "scene", "scene_hash", "attack", "method",
               "views",   "drive", "network",    "seed"};
  probe.axes = {AttackAxis(), MethodAxis(), ViewsAxis(), DriveAxis(), NetworkAxis(), SeedAxis()};
  probe.columns = AttackValues({}, 1);
  probe.measure = MeasureAttack;
  return probe;
}

}  // namespace seam
