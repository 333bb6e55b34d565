/// The schemas, as https://docs.foxglove.dev/docs/sdk/schemas has them: the fields that are used.

#include "render/export/foxglove.h"

namespace seam {

#define SEAM_TIME(Title)                                                                           \
  R"({"type":"object","title":")" Title R"(","properties":{"sec":{"type":"integer","minimum":0},)" \
  R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})"
#define SEAM_VECTOR                                                                     \
  R"({"type":"object","title":"foxglove.Vector3","properties":{"x":{"type":"number"},)" \
  R"("y":{"type":"number"},"z":{"type":"number"}}})"
#define SEAM_POINT                                                                     \
  R"({"type":"object","title":"foxglove.Point3","properties":{"x":{"type":"number"},)" \
  R"("y":{"type":"number"},"z":{"type":"number"}}})"
#define SEAM_QUATERNION                                                                    \
  R"({"type":"object","title":"foxglove.Quaternion","properties":{"x":{"type":"number"},)" \
  R"("y":{"type":"number"},"z":{"type":"number"},"w":{"type":"number"}}})"
#define SEAM_COLOR                                                                    \
  R"({"type":"object","title":"foxglove.Color","properties":{"r":{"type":"number"},)" \
  R"("g":{"type":"number"},"b":{"type":"number"},"a":{"type":"number"}}})"

const FoxgloveSchema kFrameTransforms = {
    "foxglove.FrameTransforms",
    R"({"title":"foxglove.FrameTransforms","type":"object","properties":{"transforms":)"
    R"({"type":"array","items":{"title":"foxglove.FrameTransform","type":"object","properties":)"
    R"({"timestamp":)" SEAM_TIME(
        "time") R"(,"parent_frame_id":{"type":"string"},"child_frame_id":{"type":"string"},)"
                R"("translation":)" SEAM_VECTOR R"(,"rotation":)" SEAM_QUATERNION R"(}}}}})"};

const FoxgloveSchema kSceneUpdate = {
    "foxglove.SceneUpdate",
    R"({"title":"foxglove.SceneUpdate","type":"object","properties":{"deletions":)"
    R"({"type":"array","items":{"title":"foxglove.SceneEntityDeletion","type":"object",)"
    R"("properties":{"timestamp":)" SEAM_TIME(
        "time") R"(,"type":{"type":"integer"},"id":{"type":"string"}}}},"entities":)"
                R"({"type":"array","items":{"title":"foxglove.SceneEntity","type":"object","properties":)"
                R"({"timestamp":)" SEAM_TIME("time") R"(,"frame_id":{"type":"string"},"id":{"type":"string"},"lifetime":)" SEAM_TIME(
                    "duration") R"(,"frame_locked":{"type":"boolean"},"metadata":{"type":"array","items":{"type":"object",)"
                                R"("title":"foxglove.KeyValuePair","properties":{"key":{"type":"string"},)"
                                R"("value":{"type":"string"}}}},"lines":{"type":"array","items":{"type":"object",)"
                                R"("title":"foxglove.LinePrimitive","properties":{"type":{"type":"integer"},)"
                                R"("pose":{"type":"object","title":"foxglove.Pose","properties":{"position":)" SEAM_VECTOR
                                R"(,"orientation":)" SEAM_QUATERNION
                                R"(}},"thickness":{"type":"number"},"scale_invariant":{"type":"boolean"},"points":)"
                                R"({"type":"array","items":)" SEAM_POINT R"(},"color":)" SEAM_COLOR
                                R"(,"colors":{"type":"array","items":)" SEAM_COLOR
                                R"(},"indices":{"type":"array","items":{"type":"integer","minimum":0}}}}}}}}}})"};

const FoxgloveSchema kLog = {
    "foxglove.Log",
    R"({"title":"foxglove.Log","type":"object","properties":{"timestamp":)" SEAM_TIME(
        "time") R"(,"level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"},)"
                R"("file":{"type":"string"},"line":{"type":"integer","minimum":0}}})"};

const FoxgloveSchema kErrors = {
    "seam2d.Errors",
    R"({"title":"seam2d.Errors","type":"object","properties":{"tick":{"type":"integer"},)"
    R"("rms_m":{"type":["number","null"]},"max_m":{"type":["number","null"]},"error_m":)"
    R"({"type":"object","additionalProperties":{"type":["number","null"]}}}})"};

const FoxgloveSchema kInput = {
    "seam2d.Input",
    R"({"title":"seam2d.Input","type":"object","properties":{"tick":{"type":"integer"},)"
    R"("drive":{"type":"number"},"lift":{"type":"number"},"buttons":{"type":"integer"}}})"};

}  // namespace seam
