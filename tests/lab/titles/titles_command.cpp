#include <fmt/format.h>

#include <cstdio>

#include "common/base/bytes.h"
#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "common/measure/table.h"
#include "tests/lab/commands.h"
#include "tests/lab/report/sessions/titles_section.h"
#include "tests/lab/rows.h"
#include "tests/lab/scene_settings.h"
#include "tests/lab/titles/titles.h"

namespace seam {
namespace {

const char* const kKeyHeader = "version,scene,scene_hash,network,seed";
constexpr int kKeyColumns = 5;

/// What one session showed: nothing, or what it lacked.
std::string Missed(const SessionSettings& settings, const Title& title) {
  Recording recording;
  RunSession(Configure(settings), &recording);
  return MissedBy(title, recording);
}

}  // namespace

int RunTitles(const TitlesCommand& command) {
  std::vector<const Title*> titles;
  for (const std::string& scene : command.scenes) titles.push_back(&TitleOf(scene));
  if (titles.empty()) {
    for (const Title& title : Titles()) titles.push_back(&title);
  }
  std::vector<SessionSettings> runs;
  std::vector<const Title*> of_run;
  std::vector<std::string> keys;
  for (const Title* title : titles) {
    SessionSettings settings;
    settings.scene = FindScene(title->scene);
    settings.players = title->players;
    const Scene scene = LoadSceneWith(settings.scene, {});
    const auto hash = Fnv1a(scene.text.data(), scene.text.size());
    for (const std::string& network : command.networks) {
      settings.impair = network;
      Configure(settings, scene);  // throws what is wrong with the network
      for (int seed = 1; seed <= command.seeds; ++seed) {
        settings.seed = seed;
        runs.push_back(settings);
        of_run.push_back(title);
        keys.push_back(fmt::format("{},{},{:016x},{},{}", kLabVersion, title->scene, hash,
                                   CsvField(network), seed));
      }
    }
  }
  SweepTable table(command.table, std::string(kKeyHeader) + ",valid,sentence,missed", kKeyColumns,
                   keys, command.force);
  StopOnSignals();
  RowMaker maker;
  maker.make = [&](std::size_t row) {
    return keys[row] + ",," + CsvField(of_run[row]->sentence) + "," +
           CsvField(Missed(runs[row], *of_run[row]));
  };
  const RowsDone done = MakeRows(keys, MissingRows(table, keys.size()), maker, JobsOr(command.jobs),
                                 command.quiet, &table);
  const int status = PrintRows(command.table, table, keys.size(), done);
  const TextTable shown =
      TitlesTable(CsvTable::Load(command.table), "seam-lab titles -o " + command.table);
  std::printf("\n%s\n\n%s", shown.title.c_str(), Markdown(shown).c_str());
  return status;
}

}  // namespace seam
