#include "render/live_renderer.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "common/codec/codec.h"
#include "render/canvas/palette.h"
#include "render/canvas/png_writer.h"
#include "render/frame.h"
#include "render/load.h"

namespace seam {
namespace {

constexpr double kBehind_s = 0.5;  ///< frames further behind the bus than this are skipped

/// Removes data before a tick, which no frame will show any more.
void Prune(Recording* recording, std::int64_t before_tick) {
  for (auto& [peer, views] : recording->views)
    while (views.size() > 1 && views.begin()->first < before_tick) views.erase(views.begin());
  for (auto& [peer, strands] : recording->strands)
    while (!strands.empty() && strands.begin()->first < before_tick) strands.erase(strands.begin());
  auto& impacts = recording->impacts;
  impacts.erase(std::remove_if(impacts.begin(), impacts.end(),
                               [&](const Impacts& i) { return i.tick < before_tick; }),
                impacts.end());
  for (auto& [peer, stats] : recording->stats)
    if (stats.size() > 8) stats.erase(stats.begin(), stats.end() - 8);
  recording->states.clear();
  recording->inputs.clear();
  recording->grants.clear();
  recording->events.clear();
}

}  // namespace

LiveRenderer::LiveRenderer(const RenderOptions& options)
    : options_(options), folder_(options.out, options.force), builder_(options.room) {
  if (!options.oracle.empty()) truth_ = LoadOracle(options.oracle);
  const Font probe(1, "", options.fonts);  // fails now, not in the middle of a session
}

bool LiveRenderer::IsStray(std::int64_t tick) {
  if (!ticks_.IsStray(tick)) return false;
  ++dropped_;
  if (!ticks_.restarted()) return true;
  builder_ = RecordingBuilder(options_.room);  // its room is repeated every second
  Restart();
  return true;
}

void LiveRenderer::Restart() {
  playback_.reset();
  ticks_ = StrayTicks();
}

bool LiveRenderer::Add(const std::string& channel, ByteView message) {
  const AnyMessage any = Decode(message);
  const View* const view = std::get_if<View>(&any);
  const std::optional<std::int64_t> session = builder_.session();
  const bool of_shown = view != nullptr && builder_.has_room() && view->session == session;
  if (of_shown && IsStray(view->tick)) return true;
  const bool added = builder_.Add(channel, message);
  if (builder_.session() != session) Restart();
  return added;
}

void LiveRenderer::DrawDue() {
  if (!builder_.has_scene() || builder_.recording().views.empty()) return;
  if (!playback_) Begin();
  // The displayed peer's newest tick; another peer's may be ahead of it.
  const auto views = builder_.recording().views.find(playback_->PeerOr(options_.peer));
  if (views == builder_.recording().views.end() || views->second.empty()) return;
  const double newest_s = static_cast<double>(views->second.rbegin()->first) / playback_->tick_hz();
  const double behind_s = newest_s - kBehind_s - next_s_;
  if (behind_s > 0) {
    const double frames = std::ceil(behind_s * options_.fps);
    skipped_ += static_cast<int>(std::min(frames, 1e6));
    next_s_ += frames / options_.fps;
  }
  for (; next_s_ <= newest_s + 1e-9; next_s_ += 1.0 / options_.fps) DrawFrame();
  Prune(&builder_.recording(),
        static_cast<std::int64_t>((newest_s - kLiveWindow_s) * playback_->tick_hz()));
}

void LiveRenderer::Begin() {
  std::optional<Oracle> oracle;
  if (truth_) {
    RequireOracleOf(truth_->room, truth_->path, builder_.recording().room,
                    "the session on the bus");
    oracle = truth_->oracle;
  }
  playback_.emplace(&builder_.recording(), std::move(oracle));
  next_s_ = static_cast<double>(builder_.recording().views.begin()->second.begin()->first) /
            playback_->tick_hz();
  std::string texts = playback_->scene().title + playback_->recording().room.scene_name;
  for (const Player& player : playback_->scene().players) texts += player.name;
  list_.reset();
  font_.emplace(ScaleOf(options_.width_px, options_.height_px), texts, options_.fonts);
  canvas_ = MakeCanvas(*font_);
  list_.emplace(*font_);
  if (!prepared_) folder_.Prepare();
  prepared_ = true;
}

void LiveRenderer::DrawFrame() {
  playback_->MeasureTick(static_cast<std::int64_t>(playback_->TickAt(next_s_)));
  Page page = MakePage(*playback_, options_.peer);
  page.width_px = options_.width_px;
  page.height_px = options_.height_px;
  page.strip_from_s = std::max(0.0, next_s_ - kLiveWindow_s);
  page.strip_to_s = page.strip_from_s + kLiveWindow_s;
  DrawPage(*list_, page, next_s_);
  canvas_->Draw(*list_, kPaper, &image_);
  WritePng(folder_.FramePath(frames_++), image_);
}

}  // namespace seam
