/// seam-lab: sessions of the real server and clients in virtual time, compared and swept.
/// docs/lab.md.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/base/limits.h"
#include "common/codec/version_line.h"
#include "common/net/impair.h"
#include "common/record/damage.h"
#include "common/sync/method.h"
#include "server/edits/edit_line.h"
#include "tests/lab/commands.h"
#include "tests/lab/experiment/probes.h"
#include "tests/lab/schema/scene_schema.h"

namespace {

using namespace seam;

Command* DefineRun(Command& app, RunCommand& c) {
  Command* run = &app.Add("run", "record one session in virtual time");
  SessionSettings& s = c.settings;
  run->Option("SCENE", s.scene, "scene file, or the name of a scene").Required();
  run->Option("-o,--output", c.log, "LCM log to write").Required();
  run->Option("--mode", s.mode, "oracle | central | strict | buffer");
  run->Option("--reconcile", s.reconcile, "rule for mode buffer (default rollback)");
  run->Option("--predict", s.predict, "of mode central's clients: own | all (default all)");
  run->Option("--impair", s.impair, "network, both directions: a profile's name or a list");
  run->Option("--seed", s.seed, "of network and bots").Range(0, 1000000000);
  run->Option("--send-hz", s.send_hz, "state messages per second").Range(1, kSendHzMax);
  run->Option("--duration", s.duration_s, "seconds after tick 0 (0: the scene's own)")
      .Range(0.0, kDurationMax);
  run->Option("--players", s.players, "the first so many join, the others are absent (0: all)")
      .Range(0, kPlayersMax);
  run->Option("--publish", s.publish, "of server and clients: all (default), own, none or auto");
  run->Option("--drive", s.drive, "script | bot").OneOf({"script", "bot"});
  run->Option("--smooth", c.smooth,
              "hide corrections in the view: on | off | rate in 1/s, 1 to 60 (on: 10)")
      .OneOfOrRange({"on", "off"}, kSmoothRateMin, kSmoothRateMax);
  run->Option("--set", c.set, "KEY=VALUE of the scene: solver.substeps=2 (repeatable)")
      .OneValueEach();
  run->Option("--buffer", c.buffer_m, "width of the buffer zone, m (as --set buffer=M)");
  run->Option("--input-delay", c.input_delay_ticks,
              "ticks from an input to its acting (as --set input_delay=N)")
      .Range(0, kInputDelayTicksMax);
  run->Option("--show-age", c.show_age_ticks,
              "show others' bodies at most so many ticks ago (as --set show_age=N)")
      .Range(0, kShowAgeTicksMax);
  run->Switch("--force", c.force, "overwrite the log");
  run->Switch("!--no-floor", c.floor, "do not measure the run and its floor");
  return run;
}

Command* DefineCheck(Command& app, CheckCommand& c) {
  Command* check = &app.Add("check", "what a scene says that is surely not meant");
  check->Option("SCENES", c.scenes, "scene files, or names of scenes").Required();
  check->Option("-o,--output", c.picture, "draw the scene into this PNG");
  check->Switch("--force", c.force, "overwrite the PNG");
  return check;
}

Command* DefineSchema(Command& app, std::vector<std::string>& scenes) {
  Command* schema = &app.Add("schema", "a JSON schema of scene files, for editors, to stdout");
  schema->Option("SCENES", scenes, "scenes from which types are learned (all found by name)");
  return schema;
}

Command* DefineDivergence(Command& app, DivergenceCommand& c) {
  Command* divergence = &app.Add(
      "first-divergence", "where two recordings' views differ first (status 1), or equal (0)");
  divergence->Option("A", c.log_a, "an LCM log").Required();
  divergence->Option("B", c.log_b, "an LCM log of the same scene").Required();
  divergence->Option("--peer", c.peer, "compare this peer's views alone").Range(0, kPeersMax - 1);
  divergence->Switch("--common", c.common, "leave out views that only one of them has");
  return divergence;
}

Command* DefineReplay(Command& app, ReplayCommand& c) {
  Command* replay =
      &app.Add("replay", "do a room again from its log, and compare each tick with the recorded");
  replay->Option("LOG", c.log, "an LCM log of --record, --state or run").Required();
  replay->Option("--session", c.session, "of a log with several sessions: number or id");
  return replay;
}

Command* DefineChaos(Command& app, ChaosCommand& c) {
  Command* chaos = &app.Add(
      "chaos", "sessions with faults of clients, networks and the server; invariants hold?");
  chaos->Option("--seeds", c.seeds, "sessions").Range(1, 100000000);
  chaos->Option("--first", c.first, "seed of the first one").Range(0, 1000000000);
  chaos->Option("--seconds", c.seconds, "of each; the last 10 are without faults")
      .Range(12.0, 3600.0);
  chaos->Option("--scene", c.scenes, "by name in scenes/ (default: all small ones)")
      .CommaSeparated();
  chaos->Option("--jobs", c.jobs, "sessions at a time").Range(1, 1024);
  chaos->Switch("--all", c.all, "print the seeds that hold, too");
  return chaos;
}

Command* DefineResume(Command& app, ResumeCommand& c) {
  Command* resume = &app.Add("resume", "go on with a recorded room from a tick, with an edit");
  resume->Option("LOG", c.log, "an LCM log of --record, --state or run").Required();
  resume->Option("--tick", c.tick, "the last tick that is as it was")
      .Range(1, 2000000000)
      .Required();
  resume->Option("--for", c.for_s, "seconds after it (default: as long as the log)")
      .Range(0.0, 1e5);
  resume->Option("--edit", c.edits, EditLineHelp()).OneValueEach();
  resume->Option("-o,--output", c.out, "log to write: the whole room, with the new part");
  resume->Option("--session", c.session, "of a log with several sessions: number or id");
  resume->Switch("--force", c.force, "overwrite the log");
  return resume;
}

Command* DefineSweep(Command& app, SweepCommand& c) {
  Command* sweep = &app.Add("sweep", "run and measure all combinations of settings");
  sweep->Option("FILE", c.file, "what to vary (TOML; docs/lab.md)").Required();
  AddTableFlag(*sweep, c.output).Required();
  AddRunFlags(*sweep, c.output);
  sweep->Option("--shard", c.output.shard, "I/N: run one of N shards, into a table in folder -o");
  sweep->Option("--have", c.output.have, "leave out rows that tables like PATTERN have");
  return sweep;
}

Command* DefineMerge(Command& app, MergeCommand& c) {
  Command* merge = &app.Add("merge", "make one table of a sweep's shards");
  merge->Option("FILE", c.file, "the sweep file").Required();
  merge->Option("TABLES", c.tables, "the shards' tables").Required();
  merge->Option("-o,--output", c.whole, "CSV table to write").Required();
  merge->Switch("--partial", c.partial, "write it although rows are missing");
  merge->Switch("--force", c.force, "overwrite it");
  return merge;
}

Command* DefineVerify(Command& app, VerifyCommand& c) {
  Command* verify = &app.Add("verify", "run drawn rows of a sweep's table again, and compare");
  verify->Option("FILE", c.file, "the sweep file").Required();
  verify->Option("TABLE", c.table, "its table").Required();
  verify->Option("--share", c.share_percent, "rows to run again, % (default: 1)")
      .Range(0.0001, 100.0);
  verify->Option("--seed", c.seed, "draws the rows (default: 1)");
  verify->Option("--jobs", c.jobs, "runs at a time (default: one a core)").Range(1, 256);
  verify->Switch("--quiet", c.quiet, "no progress line");
  return verify;
}

Command* DefinePhysics(Command& app, PhysicsCommand& c) {
  Command* physics =
      &app.Add("physics", "solver settings on the hard cases, or on your own scenes");
  physics->Option("SCENES", c.scenes, "your own: judged by their exact(t) (docs/lab.md)");
  physics->Option("--seconds", c.seconds, "simulated of SCENES (default: the scene's, 60 most)")
      .Range(0.1, kDurationMax);
  physics->Option("--cases", c.cases, "names (default: all)").CommaSeparated();
  physics->Option("--grid", c.grid, "quick | report | full").OneOf({"quick", "report", "full"});
  AddTableFlag(*physics, c.output);
  physics->Option("--scenes", c.folder, "folder of the hard scenes (default: scenes/hard)");
  AddRunFlags(*physics, c.output);
  return physics;
}

void DefineTuneGait(Command& tune, TuneGaitCommand& c) {
  Command* gait = &tune.Add("gait", "search a character's gains by CMA-ES");
  gait->Option("OBJECTIVE", c.objective, "what to search (TOML; docs/lab.md)").Required();
  gait->Option("-o,--output", c.output, "gains file to put the result into");
  gait->Option("--jobs", c.jobs, "trials at a time (default: one a core)").Range(1, 256);
  gait->Option("--generations", c.generations, "instead of the objective's; 0: tables only")
      .Range(0, 100000);
  gait->Option("--seed", c.seed, "instead of the objective's").Range(0, 1000000);
}

Command* DefineTune(Command& app, TuneCommand& c, TuneGaitCommand& gait) {
  Command* tune = &app.Add("tune", "the cheapest solver setting below an error");
  DefineTuneGait(*tune, gait);
  const Flag scene = tune->Option("SCENE", c.scene, "scene file, or the name of a scene");
  const Flag error =
      tune->Option("--error", c.error, "most error: a hard case's own measure, else RMS metres")
          .Range(0.0, 1e9);
  tune->RequireWithoutCommand({scene, error});  // not of `tune gait`
  tune->Switch("--keep-hz", c.keep_hz, "leave tick_hz as it is");
  tune->Option("--seconds", c.seconds, "simulated (default: the case's; else up to 10)")
      .Range(0.1, kDurationMax);
  tune->Option("--budget", c.budget_s, "CPU seconds of its runs, predicted (default: 120)")
      .Range(0.001, 1e6);
  tune->Option("--case", c.hard, "the hard case, where a scene has several");
  return tune;
}

Command* DefineOverhead(Command& app, OverheadCommand& c) {
  Command* overhead = &app.Add("overhead", "what a step costs beside Box2D alone");
  overhead->Option("SCENES", c.scenes, "scene files (default: four of scenes, two hard ones)");
  AddTableFlag(*overhead, c.output);
  overhead->Option("--repeats", c.repeats, "of which the least counts").Range(1, 1000);
  overhead->Switch("--force", c.output.force, "begin the table anew");
  return overhead;
}

Command* DefineBenches(Command& app, const char* name, const char* what, BenchCommand& c) {
  Command* benches = &app.Add(name, what);
  benches->Option("NAMES", c.benches, "which (default: all)");
  benches->Option("-o,--output", c.folder, "folder for a CSV and a Markdown table each");
  benches->Switch("--quick", c.quick, "smaller and fewer");
  return benches;
}

Command* DefineProbe(Command& app, const Probe& probe, ProbeOptions& options) {
  Command* command = &app.Add(probe.command, probe.about);
  probe.flags(*command, options);
  return command;
}

Command* DefineReport(Command& app, ReportCommand& c) {
  Command* report = &app.Add("report", "plots and tables of what was swept, as a page");
  report->Option("DATA", c.data, "folder of CSV tables (default out/report/data)");
  report->Option("-o,--output", c.out, "folder to write (default out/report)");
  report->Option("--sweeps", c.sweeps, "folder of the sweeps' files, to be named");
  report->Option("--markdown", c.markdown, "fill the tables into this page of the docs");
  report->Switch("--png", c.png, "plots as PNG, not SVG");
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  RunCommand run;
  CheckCommand check;
  std::vector<std::string> schema_scenes;
  DivergenceCommand divergence;
  ReplayCommand replay;
  ResumeCommand resume;
  ChaosCommand chaos;
  SweepCommand sweep;
  MergeCommand merge;
  VerifyCommand verify;
  PhysicsCommand physics;
  TuneCommand tune;
  TuneGaitCommand gait;
  OverheadCommand overhead;
  BenchCommand world, relief;
  std::vector<ProbeOptions> probe_options;
  for (const Probe& probe : Probes()) probe_options.push_back(probe.defaults);
  ReportCommand report;
  // The subcommands, each with what it runs.
  std::vector<std::pair<const Command*, std::function<int()>>> commands;
  const auto define = [&](Command& app) {
    app.RequireCommand();
    commands = {{DefineRun(app, run), [&] { return RunLog(run); }},
                {DefineCheck(app, check), [&] { return RunCheck(check); }},
                {DefineSchema(app, schema_scenes), [&] { return PrintSchema(schema_scenes); }},
                {DefineDivergence(app, divergence), [&] { return FirstDivergence(divergence); }},
                {DefineReplay(app, replay), [&] { return RunReplay(replay); }},
                {DefineResume(app, resume), [&] { return RunResume(resume); }},
                {DefineChaos(app, chaos), [&] { return RunChaosSeeds(chaos); }},
                {DefineSweep(app, sweep), [&] { return RunSweep(sweep); }},
                {DefineMerge(app, merge), [&] { return RunMerge(merge); }},
                {DefineVerify(app, verify), [&] { return RunVerify(verify); }},
                {DefinePhysics(app, physics), [&] { return RunPhysics(physics); }},
                {DefineTune(app, tune, gait),
                 [&] { return gait.objective.empty() ? RunTune(tune) : RunTuneGait(gait); }},
                {DefineOverhead(app, overhead), [&] { return RunOverhead(overhead); }},
                {DefineBenches(app, "world", "features of a scene beside their baselines", world),
                 [&] { return RunWorld(world); }},
                {DefineBenches(app, "relief", "what distribution takes off the server", relief),
                 [&] { return RunRelief(relief); }}};
    for (std::size_t i = 0; i < Probes().size(); ++i) {
      commands.emplace_back(DefineProbe(app, Probes()[i], probe_options[i]),
                            [&, i] { return RunProbe(Probes()[i], probe_options[i]); });
    }
    commands.emplace_back(DefineReport(app, report), [&] { return RunReport(report); });
  };
  const ProgramText text{"seam-lab",
                         "seam-lab: sessions of the real server and clients in virtual time",
                         VersionLine("seam-lab"),
                         "",
                         {{"SCENE", SceneNames()},
                          {"SCENES", SceneNames()},
                          {"--impair", ProfileNames()},
                          {"--reconcile", ReconcilerNames()}}};
  return RunCommandLine(text, argc, argv, define, [&] {
    for (const auto& [app, command] : commands) {
      if (app->chosen()) return StatusAfterReading(command());
    }
    return 2;
  });
}
