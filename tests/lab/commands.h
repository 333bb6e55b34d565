#pragma once
/// The commands of seam-lab, without those of probes (tests/lab/experiment/probes.h). Each returns
/// the program's exit status. Throws OperatorError, with nothing written, for mistakes that the
/// operator can correct.

#include <optional>
#include <string>
#include <vector>

#include "tests/lab/experiment/experiment.h"
#include "tests/lab/session.h"

namespace seam {

struct RunCommand {
  SessionSettings settings;
  std::string smooth = "on";             ///< on | off | a rate, 1/s
  std::string log;                       ///< file to write
  bool force = false;                    ///< overwrite it
  std::vector<std::string> set;          ///< --set, each one or several with ';' between them
  std::optional<double> buffer_m;        ///< --buffer
  std::optional<int> input_delay_ticks;  ///< --input-delay
  std::optional<int> show_age_ticks;     ///< --show-age
  bool floor = true;                     ///< also measure, and compute the floor
};

/// Records a session and prints its simulated and wall seconds in one line, and its error beside
/// the floor in another.
int RunLog(const RunCommand& command);

struct CheckCommand {
  std::vector<std::string> scenes;  ///< files or names
  std::string picture;              ///< PNG to draw the one scene into; empty: none
  bool force = false;               ///< overwrite it
};

/// Prints likely mistakes in the scenes, "FILE:LINE: ..." each, and draws one scene by seam-render.
/// 0: nothing was found, or drawn; 1: something was.
int RunCheck(const CheckCommand& command);

struct DivergenceCommand {
  std::string log_a, log_b;
  int peer = -1;        ///< -1: all
  bool common = false;  ///< only the views that both have
};

/// Prints the first difference of two recordings' views. 0: equal; 1: they differ.
int FirstDivergence(const DivergenceCommand& command);

struct ReplayCommand {
  std::string log, session;
};

/// Does a room again from its log alone, and compares each tick with what was recorded. 0: equal;
/// 1: prints the first tick that differs.
int RunReplay(const ReplayCommand& command);

struct ResumeCommand {
  std::string log, session, out;
  int tick = -1;
  double for_s = 0;                ///< 0: as long as the log
  std::vector<std::string> edits;  ///< see ParseEditLine
  bool force = false;
};

/// Does a room again up to a tick, and goes on from there: with an edit by itself, with the
/// recorded inputs alone; else as recorded. 0; 1: a tick that should be as recorded is not.
int RunResume(const ResumeCommand& command);

struct ChaosCommand {
  int seeds = 20, jobs = 1;
  std::int64_t first = 1;
  double seconds = 60;
  std::vector<std::string> scenes;  ///< empty: the small ones of scenes/
  bool all = false;                 ///< print the seeds that hold, too
};

/// Runs sessions with faults of clients, networks and the server; prints the seeds that break an
/// invariant. 1: some do.
int RunChaosSeeds(const ChaosCommand& command);

struct SweepCommand {
  std::string file;  ///< sweep file: parameters to vary (docs/lab.md)
  TableFlags output;
};

/// Runs every combination that the table does not have yet. 1: some runs failed (and left no row),
/// or a signal came.
int RunSweep(const SweepCommand& command);

struct MergeCommand {
  std::string file;                 ///< sweep file of the whole table
  std::vector<std::string> tables;  ///< of its shards
  std::string whole;                ///< CSV file to write
  bool partial = false;             ///< write it although rows are missing
  bool force = false;               ///< overwrite it
};

/// Writes the table that one process would have written. 1: rows are missing, and nothing is
/// written unless `partial`. Throws OperatorError when a table is of another sweep or build, or two
/// tables disagree.
int RunMerge(const MergeCommand& command);

struct VerifyCommand {
  std::string file, table;   ///< a sweep file, and its table
  double share_percent = 1;  ///< of the rows to run again; at least one row
  std::int64_t seed = 1;     ///< draws them
  int jobs = 0;              ///< runs at a time; 0: as many as there are cores
  bool quiet = false;        ///< no progress line
};

/// Runs drawn rows again and compares all but times. 1: some differ, or a signal came.
int RunVerify(const VerifyCommand& command);

struct PhysicsCommand {
  std::vector<std::string> scenes;  ///< files or names: cases of the user's own
  double seconds = 0;               ///< of those; 0: each scene's duration, 60 at most
  std::vector<std::string> cases;   ///< names of hard cases; empty: all, if there are no scenes
  std::string grid = "report";      ///< quick | report | full
  std::string folder = "scenes/hard";
  /// An empty table, which needs scenes: out/physics/NAMES/physics.csv, and the plots beside it.
  TableFlags output;
};

/// Runs the hard cases, or the scenes, with the stock setting, their own, and others; prints a
/// table, and of scenes the front. 1: some runs failed (and left no row), or a signal came.
int RunPhysics(const PhysicsCommand& command);

struct TuneCommand {
  std::string scene;      ///< a file
  double error = 0;       ///< limit for the error, in the unit of the measure
  bool keep_hz = false;   ///< tick_hz stays as the scene has it
  double seconds = 0;     ///< horizon; 0: the case's, or 10 s or the scene's duration
  double budget_s = 120;  ///< predicted CPU seconds of the search's runs
  std::string hard;       ///< the hard case by name; empty: found by the file's name
};

/// Prints the cheapest solver setting that the search finds below `error`. 1: none is.
int RunTune(const TuneCommand& command);

struct TuneGaitCommand {
  std::string objective;  ///< file with the search objective (TOML; docs/lab.md)
  std::string output;     ///< gains file to put the result into; empty: none
  int jobs = 0;           ///< trials at a time; 0: as many as there are cores
  int generations = -1;   ///< -1: the objective's
  int seed = -1;          ///< -1: the objective's
};

/// Searches gains that make an ability better and prints the results of training and held-out
/// starts. 1: a signal came: prints the best gains so far, and writes nothing.
int RunTuneGait(const TuneGaitCommand& command);

struct OverheadCommand {
  std::vector<std::string> scenes = {
      "scenes/wall.toml",   "scenes/stack.toml",           "scenes/crossing.toml",
      "scenes/cradle.toml", "scenes/hard/pyramid-20.toml", "scenes/hard/thousand.toml"};
  int repeats = 5;
  TableFlags output;  ///< one job; an empty table: none
};

/// Prints the cost of World::Step beside the engine alone. 1: they end differently, or a signal.
int RunOverhead(const OverheadCommand& command);

struct BenchCommand {
  std::vector<std::string> benches;  ///< names; empty: all
  std::string folder;                ///< for a CSV and a Markdown table each; empty: none
  bool quick = false;                ///< smaller and fewer
};

/// Prints cost and error of a scene's features beside their baselines. 1: a signal came.
int RunWorld(const BenchCommand& command);
/// Prints the load that distribution takes off the server, and its cost, beside their bars. 1: a
/// signal came.
int RunRelief(const BenchCommand& command);

struct ReportCommand {
  std::string data = "out/report/data";     ///< folder of the tables
  std::string out = "out/report";           ///< folder to write
  std::string sweeps = "tests/lab/sweeps";  ///< where the sweeps' files are, to be named
  std::string markdown;                     ///< a page of the docs to fill in; "": none
  bool png = false;                         ///< not SVG
};

/// Draws and tabulates the tables' content: index.html, plots/, tables/.
int RunReport(const ReportCommand& command);

}  // namespace seam
