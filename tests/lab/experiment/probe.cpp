#include "tests/lab/experiment/probe.h"

#include <fmt/format.h>

#include "common/base/bytes.h"
#include "common/base/find_scene.h"
#include "common/sync/method.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

/// The run of a scene with what the options say of all runs.
ProbeRun RunOfScene(const Probe& probe, const ProbeOptions& options, const std::string& word) {
  ProbeRun run;
  run.settings.drive = options.drive;
  run.settings.duration_s = options.seconds;
  if (probe.prepare) probe.prepare(word, &run);
  run.settings.scene = FindScene(word);
  run.scene = std::make_shared<Scene>(LoadSceneWith(run.settings.scene, {}));
  const std::string& text = run.scene->text;
  run.key["version"] = kLabVersion;
  run.key["scene_hash"] = fmt::format("{:016x}", Fnv1a(text.data(), text.size()));
  run.key.emplace("scene", run.scene->name);  // unless the probe has its own name for it
  return run;
}

/// Appends `run` with every combination of the values of axes[axis...].
void AddCombinations(const Probe& probe, const ProbeOptions& options, std::size_t axis,
                     ProbeRun run, std::vector<ProbeRun>* runs) {
  if (axis == probe.axes.size()) {
    Configure(run.settings, *run.scene);  // throws what is wrong with them
    runs->push_back(std::move(run));
    return;
  }
  const ProbeAxis& varied = probe.axes[axis];
  for (const std::string& value : varied.values(options, *run.scene)) {
    if (varied.set) varied.set(value, &run.settings);
    run.key[varied.column] = value;
    AddCombinations(probe, options, axis + 1, run, runs);
  }
}

Values KeyOf(const Probe& probe, const ProbeRun& run) {
  Values key;
  for (const std::string& column : probe.key) key.push_back({column, run.key.at(column)});
  return key;
}

}  // namespace

void AddSessionFlags(Command& command, ProbeOptions& options) {
  command.Option("--impair", options.network, "profile's name or list (default: demo)");
  command.Option("--drive", options.drive, "script | bot").OneOf({"script", "bot"});
  command.Option("--seconds", options.seconds, "after tick 0 (default: the scene's own)")
      .Range(0.0, kDurationMax);
  command.Option("--seeds", options.seeds, "from 1 (default: 1)").Range(1, 10000);
}

ProbeAxis MethodAxis() {
  return {"method", [](const ProbeOptions& options, const Scene&) { return options.methods; },
          [](const std::string& value, SessionSettings* settings) {
            const MethodNames names = SplitMethod(value);
            settings->mode = names.mode;
            settings->reconcile = names.reconcile;
            settings->predict = names.predict;
          }};
}

ProbeAxis ViewsAxis() {
  return {"views", [](const ProbeOptions& options, const Scene&) {
            return std::vector<std::string>{options.views};
          }};
}

ProbeAxis DriveAxis() {
  return {"drive", [](const ProbeOptions& options, const Scene&) {
            return std::vector<std::string>{options.drive};
          }};
}

ProbeAxis NetworkAxis() {
  return {"network",
          [](const ProbeOptions& options, const Scene&) {
            return options.networks.empty() ? std::vector<std::string>{options.network}
                                            : options.networks;
          },
          [](const std::string& value, SessionSettings* settings) { settings->impair = value; }};
}

ProbeAxis PlayersAxis() {
  return {"players",
          [](const ProbeOptions& options, const Scene&) {
            return std::vector<std::string>{std::to_string(options.players)};
          },
          [](const std::string& value, SessionSettings* settings) {
            settings->players = std::stoi(value);
          }};
}

ProbeAxis SeedAxis() {
  return {"seed",
          [](const ProbeOptions& options, const Scene&) {
            std::vector<std::string> seeds;
            for (int seed = 1; seed <= options.seeds; ++seed) seeds.push_back(std::to_string(seed));
            return seeds;
          },
          [](const std::string& value, SessionSettings* settings) {
            settings->seed = std::stoll(value);
          }};
}

int RunProbe(const Probe& probe, const ProbeOptions& options) {
  std::vector<ProbeRun> runs;
  const std::vector<std::string> one = {options.scene};
  for (const std::string& word : options.scene.empty() ? options.scenes : one) {
    AddCombinations(probe, options, 0, RunOfScene(probe, options, word), &runs);
  }
  Experiment experiment;
  experiment.value_columns = CsvColumns(probe.columns);
  experiment.key_columns = CsvRow(probe.key);
  for (const ProbeRun& run : runs) experiment.keys.push_back(CsvRow(KeyOf(probe, run)));
  experiment.measure = [&](std::size_t row) { return CsvRow(probe.measure(runs[row])); };
  const int status = CompleteTable(experiment, options.output);
  const int judged = probe.summary ? probe.summary(options.output.table) : 0;
  return status != 0 ? status : judged;
}

}  // namespace seam
