#pragma once
/// Messages for Foxglove and Rerun, as protocol buffers: frames (one for each body in each view, in
/// the frame "world"), shapes fixed to them (as points too, because Rerun draws no lines), log
/// lines; and seam2d's own plain numbers. The oracle is one more view, "oracle".

#include <string>
#include <vector>

#include "render/export/session.h"

namespace seam {

/// Names of the messages.
constexpr const char *kFramesSchema = "foxglove.FrameTransforms",
                     *kSceneSchema = "foxglove.SceneUpdate", *kCloudSchema = "foxglove.PointCloud",
                     *kLogSchema = "foxglove.Log", *kErrorsSchema = "seam2d.Errors",
                     *kInputSchema = "seam2d.Input";

/// Returns the google.protobuf.FileDescriptorSet of the message of that name.
std::string ExportSchema(const std::string& name);

/// The peer of the view that OracleView makes.
constexpr int kOraclePeer = -1;

/// Returns the selected bodies as the oracle has them at the tick of a view.
View OracleView(const ExportSession& session, const View& view);
/// Returns the name of a view: its player's, "server" or "oracle".
std::string ExportViewName(const ExportSession& session, int peer);

/// Returns the time of a tick, ns from the session's tick 0; 0 for earlier ones.
std::uint64_t TimeNs(const ExportSession& session, std::int64_t tick);
/// foxglove.FrameTransforms: the pose of each body of the rows, rounded to 1/4096 m and 1/32768 of
/// a quaternion. Frames are "VIEW/BODY". Those of several views, one after the other, are one
/// message as well.
std::string FramesOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows);
/// foxglove.SceneUpdate: the outlines of all bodies in the rows, fixed to their frames; replaces
/// all earlier shapes of the view.
std::string SceneUpdateOf(const ExportSession& session, const View& view,
                          const std::vector<ExportRow>& rows);
/// A message of a body, by the body's name.
struct NamedMessage {
  std::string name, message;
};
/// foxglove.PointCloud of each body of the rows: points along its outlines, fixed to its frame.
std::vector<NamedMessage> CloudsOf(const ExportSession& session, const View& view,
                                   const std::vector<ExportRow>& rows);
/// foxglove.PointCloud of all bodies that never move, in the frame "world", near those that do.
std::string GroundCloudOf(const ExportSession& session);
/// foxglove.SceneUpdate: the outlines of bodies that never move, in the frame "world".
std::string GroundOf(const ExportSession& session);
/// seam2d.ViewErrors: rms_m, max_m, and error_m by body, of the bodies that the oracle has.
std::string ErrorsOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows);
/// seam2d.Errors: those of all views of a tick.
std::string ErrorsOf(std::int64_t tick, const std::vector<std::string>& views);
/// seam2d.Input.
std::string InputOf(std::int64_t tick, const Input& input);
/// foxglove.Log of an event.
std::string LogOf(const ExportSession& session, const Event& event);

}  // namespace seam
