#include "render/manifest.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/base/json_text.h"
#include "common/codec/version_line.h"
#include "common/record/damage.h"
#include "common/record/segments/log_segments.h"
#include "render/panel_note.h"
#include "render/playback/peer_report.h"

namespace seam {
namespace {

/// Returns the 64-bit FNV-1a hash of the bytes of a file, or of all segments of a log.
std::string HashOf(const std::string& path) {
  std::uint64_t hash = Fnv1a("", 0);
  for (const LogSegment& segment : ListSegments(LogNamed(path))) {
    std::ifstream file(segment.path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
    hash = Fnv1a(bytes.data(), bytes.size(), hash);
  }
  return fmt::format("fnv1a-64:{:016x}", hash);
}

std::string NameOf(const std::string& path) { return std::filesystem::path(path).filename(); }

const char* NameOf(CameraWish::Kind kind) {
  switch (kind) {
    case CameraWish::Kind::kFit: return "fit";
    case CameraWish::Kind::kScene: return "scene";
    case CameraWish::Kind::kFixed: return "fixed";
    case CameraWish::Kind::kFollow: return "follow";
  }
  return "";
}

/// Formats a number, or null.
template <class Known>
std::string NumberOrNull(const Known& value) {
  return value ? fmt::format("{:.6g}", static_cast<double>(*value)) : "null";
}

/// Returns the figures and notes of each panel at a moment, as JSON.
std::string PanelsJson(const Page& page, double now_s) {
  std::string text;
  for (const Panel& panel : page.panels) {
    const double tick = panel.playback->TickAt(now_s);
    const PeerReport report = ReportOf(panel.playback->recording(), panel.peer, tick);
    const ViewNote note = NoteOf(panel, now_s);
    const auto reported = [](double value) {
      return value < 0 ? std::nullopt : std::optional<double>(value);
    };
    text += fmt::format(
        "{}{{\"error_m\": {}, \"round_trip_ms\": {}, \"jitter_ms\": {}, \"loss_percent\": {}, "
        "\"view_age_ms\": {}, \"corrections\": {}}}",
        text.empty() ? "" : ", ", NumberOrNull(panel.playback->ErrorAt(panel.error_peer, tick)),
        NumberOrNull(reported(report.rtt_us / 1e3)), NumberOrNull(note.jitter_ms),
        NumberOrNull(reported(report.loss_percent)), NumberOrNull(note.age_ms),
        NumberOrNull(note.corrections));
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> AboutPictures(const RenderOptions& options,
                                                               const Page& page) {
  std::string source;
  for (const std::string& log : options.logs) {
    source += (source.empty() ? "" : ", ") + NameOf(log) + " " + HashOf(log);
  }
  std::string views;
  for (const Panel& panel : page.panels) views += "; " + panel.caption;
  return {{"Software", VersionLine("seam-render")},
          {"Title", page.title},
          {"Source", source},
          {"Description", page.subtitle + views}};
}

void WriteManifest(const RenderOptions& options, const Page& page,
                   const std::vector<double>& times_s, const OutputFolder& folder) {
  std::string text = "{\n  \"software\": " + JsonText(VersionLine("seam-render")) + ",\n";
  text += "  \"title\": " + JsonText(page.title) + ",\n  \"logs\": [";
  for (const std::string& log : options.logs) {
    text += (&log == &options.logs.front() ? "" : ", ") + std::string("{\"name\": ") +
            JsonText(NameOf(log)) + ", \"hash\": " + JsonText(HashOf(log)) + "}";
  }
  text += "],\n  \"damage\": [";
  std::string damage;
  const Recording* last = nullptr;  // panels of one recording stand together
  for (const Panel& panel : page.panels) {
    if (std::exchange(last, &panel.playback->recording()) == &panel.playback->recording()) continue;
    for (const std::string& line : DamageLines(*last)) {
      damage += (damage.empty() ? "" : ", ") + JsonText(panel.playback->Label() + ": " + line);
    }
  }
  text += damage + "],\n  \"panels\": [";
  for (const Panel& panel : page.panels) {
    text += (&panel == &page.panels.front() ? "" : ", ") + JsonText(panel.caption);
  }
  text += fmt::format(
      "],\n  \"size_px\": [{}, {}],\n  \"fps\": {},\n  \"speed\": {:g},\n  \"camera\": {},\n"
      "  \"frames\": [\n",
      page.width_px, page.height_px, options.fps, options.speed,
      JsonText(NameOf(options.camera.kind)));
  const Playback& first = *page.panels.front().playback;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const WorldBox box = page.camera != nullptr ? page.camera->At(times_s[i]) : WorldBox();
    text += fmt::format(
        "    {{\"file\": {}, \"time_s\": {:.6f}, \"tick\": {:.3f}, \"box_m\": [{:.3f}, {:.3f}, "
        "{:.3f}, {:.3f}], \"panels\": [{}]}}{}\n",
        JsonText(NameOf(folder.FramePath(static_cast<int>(i)))), times_s[i],
        first.TickAt(times_s[i]), box.min.x(), box.min.y(), box.max.x(), box.max.y(),
        PanelsJson(page, times_s[i]), i + 1 < times_s.size() ? "," : "");
  }
  text += "  ]\n}\n";
  const std::string path = folder.path() + "/" + kManifestName;
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OperatorError(path + ": " + std::strerror(errno));
}

}  // namespace seam
