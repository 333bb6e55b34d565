#pragma once
/// Draws frames of a running session from its messages, independent of the bus.

#include <memory>
#include <optional>
#include <string>

#include "common/record/recording.h"
#include "render/canvas/canvas.h"
#include "render/load.h"
#include "render/options.h"
#include "render/output.h"
#include "render/playback/playback.h"
#include "render/playback/stray_ticks.h"

namespace seam {

/// Seconds of a session on the strip's axis, and kept in memory.
constexpr double kLiveWindow_s = 10;

/// Collects the messages of a session and draws its frames.
class LiveRenderer {
 public:
  /// Uses the options out, force, room, oracle, fonts, fps, size and view. Writes nothing yet.
  /// Throws OperatorError for an unusable folder, font or oracle.
  explicit LiveRenderer(const RenderOptions& options);

  /// Adds a message of the bus; returns false when it does not belong to the session. A view with a
  /// tick far from the newest is dropped as damaged; many in a row mean that the session restarted,
  /// as does the Room of another session.
  bool Add(const std::string& channel, ByteView message);

  /// Draws every frame for which the displayed peer's view has arrived. Skips frames that are too
  /// far behind the newest.
  void DrawDue();

  bool heard() const { return playback_.has_value(); }
  int frames() const { return frames_; }
  int skipped() const { return skipped_; }
  std::int64_t dropped() const { return dropped_; }
  const std::string& path() const { return folder_.path(); }

 private:
  bool IsStray(std::int64_t tick);
  /// Forgets what was shown of a session that has ended.
  void Restart();
  void Begin();
  void DrawFrame();

  const RenderOptions options_;
  OutputFolder folder_;
  RecordingBuilder builder_;
  std::optional<GivenOracle> truth_;
  std::optional<Playback> playback_;  // of builder_'s recording
  std::optional<Font> font_;
  std::unique_ptr<Canvas> canvas_;
  std::optional<DrawList> list_;
  Image image_;
  bool prepared_ = false;
  double next_s_ = 0;              // the next frame's moment
  StrayTicks ticks_;               // of all accepted views
  int frames_ = 0, skipped_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace seam
