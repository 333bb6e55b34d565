#pragma once
/// Frames of a session while it arrives, message by message, whatever bus they come
/// from.

#include <memory>
#include <optional>
#include <string>

#include "common/record/recording.h"
#include "render/canvas/canvas.h"
#include "render/load.h"
#include "render/options.h"
#include "render/output.h"
#include "render/playback/playback.h"

namespace seam {

/// Seconds of a session on the strip's axis, and kept in memory.
constexpr double kLiveWindow_s = 10;

class LiveRenderer {
 public:
  /// Of the options: out, force, room, oracle, fonts, fps, size and view. Writes nothing yet.
  /// Throws OperatorError for a folder, font or oracle that will not do.
  explicit LiveRenderer(const RenderOptions& options);

  /// Takes a message of the bus; false when it is none of the session's. A view that is far from
  /// the present is damage and is dropped, unless that goes on: then the session began anew.
  bool Add(const std::string& channel, ByteView message);

  /// Draws every frame that is due: whose view of the viewing peer is there. Frames too far behind
  /// the newest are skipped.
  void DrawDue();

  bool heard() const { return playback_.has_value(); }
  int frames() const { return frames_; }
  int skipped() const { return skipped_; }
  std::int64_t dropped() const { return dropped_; }
  const std::string& path() const { return folder_.path(); }

 private:
  bool IsStray(std::int64_t tick);
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
  std::int64_t newest_tick_ = -1;  // of all views taken
  int strays_ = 0;                 // dropped one after another
  int frames_ = 0, skipped_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace seam
