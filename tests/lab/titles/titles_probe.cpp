#include <cstdio>

#include "tests/lab/experiment/probes.h"
#include "tests/lab/report/sessions/titles_section.h"
#include "tests/lab/titles/titles.h"

namespace seam {
namespace {

/// `missed`: empty, or the first claim that a session did not keep.
Values TitleValues(const std::string& sentence, const std::string& missed) {
  return Judged("", {{"sentence", sentence}, {"missed", missed}});
}

Values MeasureTitle(const ProbeRun& run) {
  const Title& title = TitleOf(run.key.at("scene"));
  Recording recording;
  RequireScripts(RunSession(Configure(run.settings), &recording));
  return TitleValues(title.sentence, MissedBy(title, recording));
}

int PrintTitles(const std::string& path) {
  const TextTable shown = TitlesTable(CsvTable::Load(path), "seam-lab titles -o " + path);
  std::printf("\n%s\n\n%s", shown.title.c_str(), Markdown(shown).c_str());
  return 0;
}

void AddTitlesFlags(Command& titles, ProbeOptions& options) {
  titles.Option("SCENES", options.scenes, "names (default: all that have a sentence)");
  AddTableFlag(titles, options.output).Required();
  titles.Option("--impair", options.networks, "profile's name or list; repeatable (default: 4g)")
      .OneValueEach();
  titles.Option("--seeds", options.seeds, "from 1 (default: 10)").Range(1, 10000);
  AddRunFlags(titles, options.output);
}

}  // namespace

Probe TitlesProbe() {
  Probe probe;
  probe.command = "titles";
  probe.about = "do the scenes do what their titles say?";
  probe.flags = AddTitlesFlags;
  for (const Title& title : Titles()) probe.defaults.scenes.emplace_back(title.scene);
  probe.defaults.networks = {"4g"};
  probe.defaults.seeds = 10;
  probe.key = {"version", "scene", "scene_hash", "network", "seed"};
  probe.axes = {NetworkAxis(), SeedAxis()};
  probe.columns = TitleValues("", "");
  probe.measure = MeasureTitle;
  probe.prepare = [](const std::string& word, ProbeRun* run) {
    run->settings.players = TitleOf(word).players;
  };
  probe.summary = PrintTitles;
  return probe;
}

}  // namespace seam
