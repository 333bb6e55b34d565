#pragma once
/// A probe measures whole sessions: `seam-lab COMMAND SCENES -o TABLE` runs one session for each
/// combination of scenes and axes and writes the probe's named values of each. docs/lab.md says how
/// to add one.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/lab/experiment/experiment.h"
#include "tests/lab/experiment/values.h"
#include "tests/lab/session.h"

namespace seam {

/// The values of a probe's flags; a probe has its own defaults, and uses some of them.
struct ProbeOptions {
  std::vector<std::string> scenes;  ///< files or names
  std::string scene;                ///< of a probe that takes one
  std::vector<std::string> methods = {"buffer"};
  std::vector<std::string> attacks;   ///< none: all
  std::string network = "demo";       ///< of --impair
  std::vector<std::string> networks;  ///< of a probe whose --impair is repeatable
  std::string near_path, far_path;    ///< networks of a near and of a far player
  std::string drive = "script";       ///< script | bot
  std::string views = "shown";        ///< shown | hidden: the server's
  int players = 0;                    ///< the first so many of a scene's join; 0: all
  double seconds = 0;                 ///< after tick 0; 0: the scene's own
  int seeds = 1;                      ///< from 1
  TableFlags output;
};

/// Adds --impair (one network), --drive, --seconds and --seeds (one by default).
void AddSessionFlags(Command& command, ProbeOptions& options);

/// One session to run.
struct ProbeRun {
  SessionSettings settings;
  std::shared_ptr<const Scene> scene;      ///< as read from its file
  std::map<std::string, std::string> key;  ///< the text of each key column
};

/// One thing that varies, a column of the key.
struct ProbeAxis {
  std::string column;
  std::function<std::vector<std::string>(const ProbeOptions&, const Scene&)> values;
  /// Puts a value into the settings; nullptr: only the key has it.
  std::function<void(const std::string& value, SessionSettings*)> set = nullptr;
};

ProbeAxis MethodAxis();
ProbeAxis ViewsAxis();
ProbeAxis DriveAxis();
ProbeAxis NetworkAxis();
ProbeAxis PlayersAxis();
ProbeAxis SeedAxis();

struct Probe {
  std::string command;
  std::string about;  ///< one line of help
  /// Adds the flags in the order of --help.
  std::function<void(Command&, ProbeOptions&)> flags;
  ProbeOptions defaults;
  /// The columns of the key: version, scene, scene_hash and those of the axes, in any order.
  std::vector<std::string> key;
  std::vector<ProbeAxis> axes;  ///< the slowest first; scenes are slower still
  Values columns;               ///< names of the values; their texts do not matter
  /// Runs one session and measures it. Throws OperatorError for a session that says nothing: it
  /// leaves no row.
  std::function<Values(const ProbeRun&)> measure;
  /// Completes the settings of a scene by the word that the operator gave. May be empty.
  std::function<void(const std::string& word, ProbeRun*)> prepare = nullptr;
  /// Prints a summary of the table. Returns an exit status. May be empty.
  std::function<int(const std::string& table)> summary = nullptr;
};

/// Checks all runs, then completes the table. Returns the exit status: 1: some runs failed (and
/// left no row), or a signal came. Throws OperatorError, with nothing written, for options that are
/// wrong.
int RunProbe(const Probe& probe, const ProbeOptions& options);

}  // namespace seam
