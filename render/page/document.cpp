#include "render/page/document.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "common/base/json_text.h"
#include "common/base/version.h"
#include "common/record/damage.h"
#include "common/record/loss_timeline.h"
#include "render/canvas/palette.h"
#include "render/page/assets.h"
#include "render/page/events.h"
#include "render/page/gzip.h"
#include "render/page/series.h"
#include "render/page/strands.h"
#include "render/page/tracks.h"
#include "render/page/worlds.h"
#include "render/playback/peer_colour.h"

namespace seam {
namespace {

constexpr double kStutterUnit_mps2 = 1e-2;

/// Concatenated sections; equal ones are stored once.
class Sections {
 public:
  /// Adds a section, and returns its place as "[offset,length]".
  std::string Add(const PageBytes& section) {
    const auto [place, added] = known_.emplace(section, bytes_.size());
    if (added) bytes_.insert(bytes_.end(), section.begin(), section.end());
    return fmt::format("[{},{}]", place->second, section.size());
  }
  const PageBytes& bytes() const { return bytes_; }

 private:
  PageBytes bytes_;
  std::map<PageBytes, std::size_t> known_;
};

/// Returns [tick, round trip us, loss ppm, bytes in, bytes out] as counted by the peer.
std::string StatsJson(const Recording& recording, int peer) {
  std::vector<std::string> rows;
  const auto found = recording.stats.find(peer);
  if (found == recording.stats.end()) return "[]";
  for (const Stats& s : found->second)
    rows.push_back(
        fmt::format("[{},{},{},{},{}]", s.tick, s.rtt_us, s.loss_ppm, s.bytes_in, s.bytes_out));
  return JsonList(rows);
}

std::string ViewJson(const Playback& playback, int peer, PageWorlds* worlds,
                     const PageSeries& stutter, const PageSeries& path, Sections* sections) {
  const Recording& recording = playback.recording();
  const auto& views = recording.views.at(peer);
  const auto world_at = [&](std::int64_t tick) {
    const auto view = views.find(tick);
    return view == views.end() ? -1 : worlds->IndexOf(view->second.revision);
  };
  const Oracle* oracle = playback.has_oracle() ? &playback.oracle() : nullptr;
  std::string json = fmt::format(
      R"({{"peer":{},"name":{},"tracks":{},"stats":{})", peer, JsonText(playback.PeerName(peer)),
      sections->Add(EncodeTracks(TracksOf(views, oracle), recording.first_tick, recording.last_tick,
                                 world_at, true)),
      StatsJson(recording, peer));
  const auto add = [&](const char* name, const PageSeries& series, double unit) {
    const auto found = series.find(peer);
    if (found != series.end())
      json += fmt::format(R"(,"{}":{})", name, sections->Add(EncodeSeries(found->second, unit)));
  };
  add("stutter", stutter, kStutterUnit_mps2);
  add("path", path, kPageErrorUnit_m);
  const PageBytes strands = EncodeStrands(playback, peer);
  if (!strands.empty()) json += fmt::format(R"(,"strands":{})", sections->Add(strands));
  return json + "}";
}

std::string ColourJson(Colour colour) {
  return fmt::format("\"#{:02x}{:02x}{:02x}\"", colour.r, colour.g, colour.b);
}

/// Returns [peer, colour] for each peer with a player that has a colour in the scene.
std::string ColoursJson(const Playback& playback) {
  std::vector<std::string> colours;
  for (const int peer : playback.peers()) {
    const Colour colour = ColourOf(playback, peer);
    if (colour == PeerColour(peer)) continue;
    colours.push_back(fmt::format("[{},{}]", peer, ColourJson(colour)));
  }
  return JsonList(colours);
}

/// Returns [kind, channel, first tick, last tick, lost]; a bounded number of rows.
std::string LossesJson(const PageRun& run) {
  constexpr std::size_t kLossesMax = 5000;
  const Recording& recording = run.playback->recording();
  std::vector<std::string> rows;
  const double hz = run.playback->tick_hz();
  const std::vector<Loss> losses =
      run.path.empty() ? FindLosses(recording) : FindLosses(run.path, recording);
  for (const Loss& loss : losses) {
    if (rows.size() == kLossesMax) break;
    rows.push_back(fmt::format("[{},{},{},{},{}]", JsonText(LossKind(loss.kind)),
                               JsonText(loss.channel), std::llround(loss.from_s * hz),
                               std::llround(loss.to_s * hz), loss.lost));
  }
  return JsonList(rows);
}

std::string RunJson(const PageRun& run, Sections* sections) {
  const Playback& playback = *run.playback;
  const Recording& recording = playback.recording();
  std::optional<PageWorlds> own;
  PageWorlds& worlds = run.live != nullptr ? *run.live->worlds : own.emplace(playback);
  PageSeries stutter, path;
  std::string truth = "null";
  if (playback.has_oracle()) {
    const Oracle& oracle = playback.oracle();
    stutter = StutterByTick(recording, playback.scene(), oracle);
    path = PathErrorByTick(recording, playback.scene(), oracle);
    truth = sections->Add(EncodeTracks(
        TruthOf(recording, oracle), recording.first_tick, recording.last_tick,
        [](std::int64_t) { return 0; }, false));
  }
  std::vector<std::string> views, events;
  for (const int peer : playback.peers())
    views.push_back(ViewJson(playback, peer, &worlds, stutter, path, sections));
  for (const PageEvent& event : run.live != nullptr ? *run.live->events : EventsOf(playback))
    events.push_back(EventJson(event));
  std::vector<std::string> damage;
  for (const std::string& line : DamageLines(recording)) {
    if (run.live == nullptr) damage.push_back(JsonText(line));
  }
  const Room& room = recording.room;
  const std::string drawn = worlds.Json();
  const PageBytes world_section(drawn.begin(), drawn.end());
  return fmt::format(
      R"({{"name":{},"label":{},"scene":{},"title":{},"network":{},"hz":{},"first":{},"last":{},)"
      R"("truth":{},"world":{},"bricks":{},"views":{},"events":{},"colours":{},"losses":{},)"
      R"("damage":{}}})",
      JsonText(run.name), JsonText(playback.Label()), JsonText(room.scene_name),
      JsonText(playback.scene().title), JsonText(room.impair), playback.tick_hz(),
      recording.first_tick, recording.last_tick, truth, sections->Add(world_section),
      sections->Add(EncodeBricks(playback)), JsonList(views), JsonList(events),
      ColoursJson(playback), run.live != nullptr ? "[]" : LossesJson(run), JsonList(damage));
}

/// Returns the colours of pictures, so that a page and a picture of a run look alike. Heat: from
/// 1 mm to 1 m in equal steps of the logarithm.
std::string PaletteJson() {
  std::vector<std::string> peers, runs, heat;
  for (int i = 0; i <= 3 * kPeerHues; ++i) peers.push_back(ColourJson(PeerColour(i)));
  for (int i = 0; i < 10; ++i) runs.push_back(ColourJson(RunColour(i)));
  for (int i = 0; i <= 15; ++i)
    heat.push_back(ColourJson(HeatColour(std::pow(10.0f, static_cast<float>(i) / 5 - 3))));
  return fmt::format(R"({{"peers":{},"runs":{},"heat":{}}})", JsonList(peers), JsonList(runs),
                     JsonList(heat));
}

/// Replaces {{name}} in the template by `value`.
void Fill(std::string* text, const std::string& name, const std::string& value) {
  const std::string mark = "{{" + name + "}}";
  const std::size_t at = text->find(mark);
  if (at != std::string::npos) text->replace(at, mark.size(), value);
}

std::string Html(const std::string& policy, const std::string& script, const std::string& data) {
  std::string html = PageTemplate();
  Fill(&html, "policy", policy);
  Fill(&html, "style", PageStyle());
  Fill(&html, "script", script);
  Fill(&html, "data", data);
  return html;
}

}  // namespace

PageBytes PageData(const std::vector<PageRun>& runs) {
  Sections sections;
  std::vector<std::string> list;
  for (const PageRun& run : runs) list.push_back(RunJson(run, &sections));
  const std::string head = fmt::format(
      R"({{"version":{},"error_unit":{},"age_unit":{},"stutter_unit":{},"colours":{},"runs":{}}})",
      JsonText(kVersion), kPageErrorUnit_m, kPageAgeUnit, kStutterUnit_mps2, PaletteJson(),
      JsonList(list));
  PageBytes data;
  for (int shift = 0; shift < 32; shift += 8)
    data.push_back(static_cast<std::uint8_t>(head.size() >> shift & 0xff));
  data.insert(data.end(), head.begin(), head.end());
  data.insert(data.end(), sections.bytes().begin(), sections.bytes().end());
  return data;
}

std::string PageHtml(const std::vector<PageRun>& runs) {
  return Html("", PageScript(), Base64(Gzip(PageData(runs))));
}

std::string LivePageHtml() { return Html("; connect-src 'self'", LivePageScript(), ""); }

}  // namespace seam
