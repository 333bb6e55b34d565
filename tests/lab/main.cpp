/// seam-lab: sessions of the real server and clients in virtual time, compared and swept.
/// docs/lab.md.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/codec/version_line.h"
#include "common/net/impair.h"
#include "common/sync/method.h"
#include "tests/lab/commands.h"

namespace {

using namespace seam;

CLI::App* DefineRun(CLI::App& app, RunCommand& c) {
  CLI::App* run = app.add_subcommand("run", "record one session in virtual time");
  SessionSettings& s = c.settings;
  run->add_option("SCENE", s.scene, "scene file, or the name of a scene")->required();
  run->add_option("-o,--output", c.log, "LCM log to write")->required();
  run->add_option("--mode", s.mode, "oracle | central | strict | buffer");
  run->add_option("--reconcile", s.reconcile, "rule for mode buffer (default rollback)");
  run->add_option("--predict", s.predict, "of mode central's clients: own | all (default all)");
  run->add_option("--impair", s.impair, "network, both directions: a profile's name or a list");
  run->add_option("--seed", s.seed, "of network and bots")->check(CLI::Range(0, 1000000000));
  run->add_option("--send-hz", s.send_hz, "state messages per second")
      ->check(CLI::Range(1, kSendHzMax));
  run->add_option("--duration", s.duration_s, "seconds after tick 0 (0: the scene's own)")
      ->check(CLI::Range(0.0, kDurationMax));
  run->add_option("--players", s.players, "the first so many join, the others are absent (0: all)")
      ->check(CLI::Range(0, kPlayersMax));
  run->add_option("--publish", s.publish,
                  "of server and clients: all (default), own, none or auto");
  run->add_option("--drive", s.drive, "script | bot")->check(CLI::IsMember({"script", "bot"}));
  run->add_option("--smooth", c.smooth,
                  "hide corrections in the view: on | off | rate in 1/s, 1 to 60 (on: 10)")
      ->check(CLI::IsMember({"on", "off"}) | CLI::Range(kSmoothRateMin, kSmoothRateMax));
  run->add_option("--set", c.set, "KEY=VALUE of the scene: solver.substeps=2 (repeatable)")
      ->allow_extra_args(false);
  run->add_option("--buffer", c.buffer_m, "width of the buffer zone, m (as --set buffer=M)");
  run->add_option("--input-delay", c.input_delay_ticks,
                  "ticks from an input to its acting (as --set input_delay=N)")
      ->check(CLI::Range(0, kInputDelayTicksMax));
  run->add_flag("--force", c.force, "overwrite the log");
  run->add_flag("!--no-floor", c.floor, "do not measure the run and its floor");
  return run;
}

CLI::App* DefineCheck(CLI::App& app, CheckCommand& c) {
  CLI::App* check = app.add_subcommand("check", "what a scene says that is surely not meant");
  check->add_option("SCENES", c.scenes, "scene files, or names of scenes")->required();
  check->add_option("-o,--output", c.picture, "draw the scene into this PNG");
  check->add_flag("--force", c.force, "overwrite the PNG");
  return check;
}

CLI::App* DefineDivergence(CLI::App& app, DivergenceCommand& c) {
  CLI::App* divergence = app.add_subcommand(
      "first-divergence", "where two recordings' views differ first (status 1), or equal (0)");
  divergence->add_option("A", c.log_a, "an LCM log")->required();
  divergence->add_option("B", c.log_b, "an LCM log of the same scene")->required();
  divergence->add_option("--peer", c.peer, "compare this peer's views alone")
      ->check(CLI::Range(0, 31));
  divergence->add_flag("--common", c.common, "leave out views that only one of them has");
  return divergence;
}

CLI::App* DefineSweep(CLI::App& app, SweepCommand& c) {
  CLI::App* sweep = app.add_subcommand("sweep", "run and measure all combinations of settings");
  sweep->add_option("FILE", c.file, "what to vary (TOML; docs/lab.md)")->required();
  sweep->add_option("-o,--output", c.table, "CSV table to write, or to complete")->required();
  sweep->add_option("--jobs", c.jobs, "runs at a time (default: one a core)")
      ->check(CLI::Range(1, 256));
  sweep->add_flag("--force", c.force, "begin the table anew");
  sweep->add_flag("--quiet", c.quiet, "no progress line");
  return sweep;
}

CLI::App* DefinePhysics(CLI::App& app, PhysicsCommand& c) {
  CLI::App* physics =
      app.add_subcommand("physics", "solver settings on the hard cases, or on your own scenes");
  physics->add_option("SCENES", c.scenes, "your own: judged by their exact(t) (docs/lab.md)");
  physics->add_option("--seconds", c.seconds, "simulated of SCENES (default: the scene's, 60 most)")
      ->check(CLI::Range(0.1, kDurationMax));
  physics->add_option("--cases", c.cases, "names (default: all)")->delimiter(',');
  physics->add_option("--grid", c.grid, "quick | report | full")
      ->check(CLI::IsMember({"quick", "report", "full"}));
  physics->add_option("-o,--output", c.table, "CSV table to write, or to complete");
  physics->add_option("--scenes", c.folder, "folder of the hard scenes (default: scenes/hard)");
  physics->add_option("--jobs", c.jobs, "runs at a time (default: one a core)")
      ->check(CLI::Range(1, 256));
  physics->add_flag("--force", c.force, "begin the table anew");
  physics->add_flag("--quiet", c.quiet, "no progress line");
  return physics;
}

void DefineTuneGait(CLI::App& tune, TuneGaitCommand& c) {
  CLI::App* gait = tune.add_subcommand("gait", "search a character's gains by CMA-ES");
  gait->add_option("OBJECTIVE", c.objective, "what to search (TOML; docs/lab.md)")->required();
  gait->add_option("-o,--output", c.output, "gains file to put the result into");
  gait->add_option("--jobs", c.jobs, "trials at a time (default: one a core)")
      ->check(CLI::Range(1, 256));
  gait->add_option("--generations", c.generations, "instead of the objective's; 0: tables only")
      ->check(CLI::Range(0, 100000));
  gait->add_option("--seed", c.seed, "instead of the objective's")->check(CLI::Range(0, 1000000));
}

CLI::App* DefineTune(CLI::App& app, TuneCommand& c, TuneGaitCommand& gait) {
  CLI::App* tune = app.add_subcommand("tune", "the cheapest solver setting below an error");
  DefineTuneGait(*tune, gait);
  const CLI::Option* scene =
      tune->add_option("SCENE", c.scene, "scene file, or the name of a scene");
  const CLI::Option* error =
      tune->add_option("--error", c.error, "most error: a hard case's own measure, else RMS metres")
          ->check(CLI::Range(0.0, 1e9));
  // Required, but not of `tune gait`.
  tune->callback([tune, scene, error] {
    if (tune->get_subcommands().empty() && scene->empty()) throw CLI::RequiredError("SCENE");
    if (tune->get_subcommands().empty() && error->empty()) throw CLI::RequiredError("--error");
  });
  tune->add_flag("--keep-hz", c.keep_hz, "leave tick_hz as it is");
  tune->add_option("--seconds", c.seconds, "simulated (default: the case's; else up to 10)")
      ->check(CLI::Range(0.1, kDurationMax));
  tune->add_option("--budget", c.budget_s, "CPU seconds of its runs, predicted (default: 120)")
      ->check(CLI::Range(0.001, 1e6));
  tune->add_option("--case", c.hard, "the hard case, where a scene has several");
  return tune;
}

CLI::App* DefineOverhead(CLI::App& app, OverheadCommand& c) {
  CLI::App* overhead = app.add_subcommand("overhead", "what a step costs beside Box2D alone");
  overhead->add_option("SCENES", c.scenes, "scene files (default: four of scenes, two hard ones)");
  overhead->add_option("-o,--output", c.table, "CSV table to write, or to complete");
  overhead->add_option("--repeats", c.repeats, "of which the least counts")
      ->check(CLI::Range(1, 1000));
  overhead->add_flag("--force", c.force, "begin the table anew");
  return overhead;
}

CLI::App* DefineBenches(CLI::App& app, const char* name, const char* what, BenchCommand& c) {
  CLI::App* benches = app.add_subcommand(name, what);
  benches->add_option("NAMES", c.benches, "which (default: all)");
  benches->add_option("-o,--output", c.folder, "folder for a CSV and a Markdown table each");
  benches->add_flag("--quick", c.quick, "smaller and fewer");
  return benches;
}

CLI::App* DefineFairness(CLI::App& app, FairnessCommand& c) {
  CLI::App* fairness =
      app.add_subcommand("fairness", "a mirrored crash between a near and a far player");
  fairness->add_option("-o,--output", c.table, "CSV table to write, or to complete")->required();
  fairness->add_option("--scene", c.scene, "two players' cars that meet (default: headon)");
  fairness->add_option("--methods", c.methods, "strict, buffer/fade, ... (default: all)")
      ->delimiter(',');
  fairness->add_option("--near", c.near_path, "the near player's network, either way");
  fairness->add_option("--far", c.far_path, "the far player's network, either way");
  fairness->add_option("--seeds", c.seeds, "from 1, each both ways round (default: 8)")
      ->check(CLI::Range(1, 1000));
  fairness->add_option("--jobs", c.jobs, "runs at a time (default: one a core)")
      ->check(CLI::Range(1, 256));
  fairness->add_flag("--force", c.force, "begin the table anew");
  fairness->add_flag("--quiet", c.quiet, "no progress line");
  return fairness;
}

CLI::App* DefineTitles(CLI::App& app, TitlesCommand& c) {
  CLI::App* titles = app.add_subcommand("titles", "do the scenes do what their titles say?");
  titles->add_option("SCENES", c.scenes, "names (default: all that have a sentence)");
  titles->add_option("-o,--output", c.table, "CSV table to write, or to complete")->required();
  titles->add_option("--impair", c.networks, "profile's name or list; repeatable (default: 4g)")
      ->allow_extra_args(false);
  titles->add_option("--seeds", c.seeds, "from 1 (default: 10)")->check(CLI::Range(1, 10000));
  titles->add_option("--jobs", c.jobs, "runs at a time (default: one a core)")
      ->check(CLI::Range(1, 256));
  titles->add_flag("--force", c.force, "begin the table anew");
  titles->add_flag("--quiet", c.quiet, "no progress line");
  return titles;
}

CLI::App* DefineLoad(CLI::App& app, LoadCommand& c) {
  CLI::App* load = app.add_subcommand("load", "what sessions cost the server and a client");
  load->add_option("SCENES", c.scenes, "scene files or names")->required();
  load->add_option("-o,--output", c.table, "CSV table to write, or to complete")->required();
  load->add_option("--methods", c.methods, "buffer, central/own, ... (default: both sides)")
      ->delimiter(',');
  load->add_option("--impair", c.network, "profile's name or list (default: demo)");
  load->add_option("--drive", c.drive, "script | bot")->check(CLI::IsMember({"script", "bot"}));
  load->add_option("--seconds", c.seconds, "after tick 0 (default: the scene's own)")
      ->check(CLI::Range(0.0, kDurationMax));
  load->add_option("--seeds", c.seeds, "from 1 (default: 1)")->check(CLI::Range(1, 10000));
  load->add_option("--jobs", c.jobs, "runs at a time (default: 1; more blur CPU times)")
      ->check(CLI::Range(1, 256));
  load->add_flag("--force", c.force, "begin the table anew");
  load->add_flag("--quiet", c.quiet, "no progress line");
  return load;
}

CLI::App* DefineHandOver(CLI::App& app, HandOverCommand& c) {
  CLI::App* hand_over = app.add_subcommand("hand-over", "how long changes of authority take");
  hand_over->add_option("SCENES", c.scenes, "scene files or names")->required();
  hand_over->add_option("-o,--output", c.table, "CSV table to write, or to complete")->required();
  hand_over->add_option("--players", c.players, "the first so many join (default: all)")
      ->check(CLI::Range(0, kPlayersMax));
  hand_over->add_option("--impair", c.network, "profile's name or list (default: demo)");
  hand_over->add_option("--drive", c.drive, "script | bot")
      ->check(CLI::IsMember({"script", "bot"}));
  hand_over->add_option("--seconds", c.seconds, "after tick 0 (default: the scene's own)")
      ->check(CLI::Range(0.0, kDurationMax));
  hand_over->add_option("--seeds", c.seeds, "from 1 (default: 1)")->check(CLI::Range(1, 10000));
  hand_over->add_option("--jobs", c.jobs, "runs at a time (default: 1)")->check(CLI::Range(1, 256));
  hand_over->add_flag("--force", c.force, "begin the table anew");
  hand_over->add_flag("--quiet", c.quiet, "no progress line");
  return hand_over;
}

CLI::App* DefineReport(CLI::App& app, ReportCommand& c) {
  CLI::App* report = app.add_subcommand("report", "plots and tables of what was swept, as a page");
  report->add_option("DATA", c.data, "folder of CSV tables (default out/report/data)");
  report->add_option("-o,--output", c.out, "folder to write (default out/report)");
  report->add_option("--sweeps", c.sweeps, "folder of the sweeps' files, to be named");
  report->add_option("--markdown", c.markdown, "fill the tables into this page of the docs");
  report->add_flag("--png", c.png, "plots as PNG, not SVG");
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  RunCommand run;
  CheckCommand check;
  DivergenceCommand divergence;
  SweepCommand sweep;
  PhysicsCommand physics;
  TuneCommand tune;
  TuneGaitCommand gait;
  OverheadCommand overhead;
  BenchCommand world, relief;
  FairnessCommand fairness;
  TitlesCommand titles;
  LoadCommand load;
  HandOverCommand hand_over;
  ReportCommand report;
  // The subcommands, each with what it runs.
  std::vector<std::pair<const CLI::App*, std::function<int()>>> commands;
  const auto define = [&](CLI::App& app) {
    app.require_subcommand(1);
    commands = {{DefineRun(app, run), [&] { return RunLog(run); }},
                {DefineCheck(app, check), [&] { return RunCheck(check); }},
                {DefineDivergence(app, divergence), [&] { return FirstDivergence(divergence); }},
                {DefineSweep(app, sweep), [&] { return RunSweep(sweep); }},
                {DefinePhysics(app, physics), [&] { return RunPhysics(physics); }},
                {DefineTune(app, tune, gait),
                 [&] { return gait.objective.empty() ? RunTune(tune) : RunTuneGait(gait); }},
                {DefineOverhead(app, overhead), [&] { return RunOverhead(overhead); }},
                {DefineBenches(app, "world", "features of a scene beside their baselines", world),
                 [&] { return RunWorld(world); }},
                {DefineBenches(app, "relief", "what distribution takes off the server", relief),
                 [&] { return RunRelief(relief); }},
                {DefineFairness(app, fairness), [&] { return RunFairnessTable(fairness); }},
                {DefineTitles(app, titles), [&] { return RunTitles(titles); }},
                {DefineLoad(app, load), [&] { return RunLoad(load); }},
                {DefineHandOver(app, hand_over), [&] { return RunHandOver(hand_over); }},
                {DefineReport(app, report), [&] { return RunReport(report); }}};
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
      if (app->parsed()) return command();
    }
    return 2;
  });
}
