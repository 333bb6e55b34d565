#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "render/commands.h"
#include "render/compared.h"
#include "render/load.h"
#include "render/output.h"
#include "render/page/document.h"

namespace seam {
namespace {

/// A log with its playback, which lacks the measures that only pictures show.
struct PageLog {
  explicit PageLog(LoadedLog log)
      : recording(std::move(log.recording)), playback(&recording, std::move(log.oracle)) {}
  const Recording recording;
  const Playback playback;
};

void WriteText(const std::string& path, const std::string& text) {
  std::FILE* file = OpenPlainFile(path, FileUse::kReplace);
  if (file == nullptr) throw OperatorError(path + ": cannot be written");
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) throw OperatorError(path + ": disk full?");
}

}  // namespace

void RenderReviewPage(const RenderOptions& options) {
  CheckOutputFile(options.out, ".html", options.force, ReadBy(options));
  const std::int64_t begin_us = SteadyClockUs();
  std::vector<std::unique_ptr<PageLog>> logs;
  std::vector<PageRun> runs;
  ProgressCount count("page", "recordings", static_cast<std::int64_t>(options.logs.size()));
  for (std::size_t i = 0; i < options.logs.size(); ++i) {
    const std::string& path = options.logs[i];
    count(static_cast<std::int64_t>(i));
    logs.push_back(std::make_unique<PageLog>(LoadLog(options, i)));
    const std::string name =
        std::filesystem::path(path).stem().string() + SessionSuffix(logs.back()->recording);
    runs.push_back({name, &logs.back()->playback, path});
  }
  std::vector<const Playback*> compared;
  for (const auto& log : logs) compared.push_back(&log->playback);
  RequireOneScene(options.logs, compared);
  const std::string html = PageHtml(runs);
  WriteText(options.out, html);
  count.End();
  std::fprintf(stderr, "%s: %zu %s, %.0f kB, made in %.1f s\n", options.out.c_str(), runs.size(),
               runs.size() == 1 ? "run" : "runs", static_cast<double>(html.size()) / 1000,
               static_cast<double>(SteadyClockUs() - begin_us) * 1e-6);
}

}  // namespace seam
