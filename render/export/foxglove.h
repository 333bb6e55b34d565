#pragma once
/// Messages for Foxglove and Rerun, as JSON, with their schemas: frames (one for each body in each
/// view, in the frame "world"), shapes fixed to them, log lines; and seam2d's own plain numbers.

#include <string>
#include <vector>

#include "render/export/session.h"

namespace seam {

struct FoxgloveSchema {
  std::string name;
  std::string text;  ///< a JSON Schema
};

FoxgloveSchema FrameTransformsSchema();
FoxgloveSchema SceneUpdateSchema();
FoxgloveSchema LogSchema();
FoxgloveSchema ErrorsSchema();
FoxgloveSchema InputSchema();

/// Returns the time of a tick, ns from the session's tick 0; 0 for earlier ones.
std::uint64_t TimeNs(const ExportSession& session, std::int64_t tick);
/// foxglove.FrameTransforms: the pose of each body of the rows. Frames are "VIEW/BODY".
std::string FramesOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows);
/// foxglove.SceneUpdate: the outlines of all bodies in the rows, fixed to their frames; replaces
/// all earlier shapes of the view.
std::string SceneUpdateOf(const ExportSession& session, const View& view,
                          const std::vector<ExportRow>& rows);
/// foxglove.SceneUpdate: the outlines of bodies that never move, in the frame "world".
std::string GroundOf(const ExportSession& session);
/// seam2d.Errors: rms_m, max_m, and error_m by body; null without an oracle.
std::string ErrorsOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows);
/// foxglove.Log of an event.
std::string LogOf(const ExportSession& session, const Event& event);

}  // namespace seam
