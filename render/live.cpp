// Frames of what the LCM bus brings, as it comes: from a session that runs or lcm-logplayer.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "common/base/check.h"
#include "common/record/bus.h"
#include "render/canvas.h"
#include "render/commands.h"
#include "render/load.h"
#include "render/palette.h"
#include "render/png_writer.h"
#include "render/sequence.h"

namespace seam {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kQuiet_s = 2;        ///< the end of a session
constexpr double kFirstWait_s = 30;   ///< for its beginning, unless --seconds says otherwise
constexpr double kWindow_s = 10;      ///< the strip's axis, and what is kept in memory
constexpr double kBehind_s = 0.5;     ///< frames further behind the bus than this are skipped

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Forgets what no frame will show any more.
void Prune(Recording* recording, std::int64_t before_tick) {
  for (auto& [peer, views] : recording->views)
    while (views.size() > 1 && views.begin()->first < before_tick) views.erase(views.begin());
  auto& impacts = recording->impacts;
  impacts.erase(std::remove_if(impacts.begin(), impacts.end(),
                               [&](const Impacts& i) { return i.tick < before_tick; }),
                impacts.end());
  recording->states.clear();
  recording->inputs.clear();
  recording->grants.clear();
  recording->events.clear();
}

class LiveRenderer {
 public:
  explicit LiveRenderer(const RenderOptions& options)
      : options_(options), folder_(options.out, options.force), builder_(options.room) {
    if (!options.oracle.empty()) oracle_ = LoadOracle(options.oracle);
    const Font probe(1, "", options.fonts);   // fails now, not in the middle of a session
  }

  void Add(const std::string& channel, ByteView message) {
    if (builder_.Add(channel, message)) last_heard_ = Clock::now();
  }

  bool heard() const { return playback_.has_value(); }
  double quiet_s() const { return Since(last_heard_); }
  int frames() const { return frames_; }
  int skipped() const { return skipped_; }
  const std::string& path() const { return folder_.path(); }

  /// Draws every frame that is due.
  void DrawDue() {
    if (!builder_.has_room() || builder_.recording().views.empty()) return;
    if (!playback_) Begin();
    // The view's newest tick; another peer's may be ahead of it.
    const auto views = builder_.recording().views.find(playback_->PeerOr(peer_));
    if (views == builder_.recording().views.end() || views->second.empty()) return;
    const double newest_s = static_cast<double>(views->second.rbegin()->first) /
                            playback_->tick_hz();
    if (newest_s < next_s_ - kWindow_s) next_s_ = newest_s;   // the log was started again
    while (next_s_ <= newest_s + 1e-9) {
      if (next_s_ < newest_s - kBehind_s) {
        ++skipped_;
      } else {
        DrawFrame();
      }
      next_s_ += 1.0 / options_.fps;
    }
    Prune(&builder_.recording(),
          static_cast<std::int64_t>((newest_s - kWindow_s) * playback_->tick_hz()));
  }

 private:
  void Begin() {
    playback_.emplace(&builder_.recording(), oracle_);
    peer_ = options_.peer;
    next_s_ = static_cast<double>(builder_.recording().views.begin()->second.begin()->first) /
              playback_->tick_hz();
    std::string texts = playback_->scene().title + playback_->recording().room.scene_name;
    for (const Player& player : playback_->scene().players) texts += player.name;
    font_.emplace(ScaleOf(options_.width_px, options_.height_px), texts, options_.fonts);
    canvas_ = MakeCanvas(*font_);
    list_.emplace(*font_);
    folder_.Prepare();
  }

  void DrawFrame() {
    playback_->MeasureTick(static_cast<std::int64_t>(playback_->TickAt(next_s_)));
    Page page = MakePage(*playback_, peer_);
    page.width_px = options_.width_px;
    page.height_px = options_.height_px;
    page.from_s = std::max(0.0, next_s_ - kWindow_s);
    page.to_s = page.from_s + kWindow_s;
    DrawPage(*list_, page, next_s_);
    canvas_->Draw(*list_, kPaper, &image_);
    WritePng(folder_.FramePath(frames_++), image_);
  }

  const RenderOptions& options_;
  OutputFolder folder_;
  RecordingBuilder builder_;
  std::optional<Oracle> oracle_;
  std::optional<Playback> playback_;
  std::optional<Font> font_;
  std::unique_ptr<Canvas> canvas_;
  std::optional<DrawList> list_;
  Image image_;
  int peer_ = 0;
  double next_s_ = 0;
  int frames_ = 0, skipped_ = 0;
  Clock::time_point last_heard_ = Clock::now();
};

}  // namespace

void RenderLive(const RenderOptions& options) {
  LiveRenderer live(options);
  Bus bus(options.lcm_url);
  bus.Subscribe("SEAM\\..*", [&live](const std::string& channel, std::int64_t, ByteView message) {
    live.Add(channel, message);
  });
  const Clock::time_point start = Clock::now();
  const double wait_s = options.seconds > 0 ? options.seconds : kFirstWait_s;
  while (true) {
    bus.Poll(20000);
    live.DrawDue();
    if (options.seconds > 0 && Since(start) > options.seconds) break;
    if (live.heard() && live.quiet_s() > kQuiet_s) break;
    if (!live.heard() && Since(start) > wait_s) break;
  }
  if (!live.heard()) throw OperatorError("heard no session on the bus: is anything publishing?");
  std::fprintf(stderr, "%d frames in %s, %d skipped to keep up\n", live.frames(),
               live.path().c_str(), live.skipped());
}

}  // namespace seam
