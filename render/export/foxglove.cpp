#include "render/export/foxglove.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/measure/mean_square.h"
#include "render/canvas/shapes.h"
#include "render/export/foxglove_parts.h"
#include "render/export/protobuf.h"

namespace seam {
namespace {

/// Poses are rounded to these parts of a metre and of a quaternion. States travel in parts of 512,
/// so nothing is lost that was known, and files compress better.
constexpr double kPosePartsPerM = 4096, kTurnParts = 32768;

double Rounded(double value, double parts) { return std::round(value * parts) / parts; }

/// Returns the place and the turn of a pose of a view, rounded.
std::string RoundedPlace(const View& view, std::size_t i) {
  return ProtoPoint(Rounded(double{view.x[i]}, kPosePartsPerM),
                    Rounded(double{view.y[i]}, kPosePartsPerM));
}
std::string RoundedTurn(const View& view, std::size_t i) {
  const double half = double{view.angle[i]} / 2;
  return ProtoTurn(Rounded(std::sin(half), kTurnParts), Rounded(std::cos(half), kTurnParts));
}

void AddPoints(const Outline& outline, ProtoMessage* line) {
  constexpr int kLinePointsField = 5;
  if (outline.kind != ShapeKind::kCircle) {
    for (const Vec2& p : outline.points)
      line->Bytes(kLinePointsField, ProtoPoint(double{p.x()}, double{p.y()}));
    return;
  }
  const Eigen::Vector2d centre = outline.points.front().cast<double>();
  line->Bytes(kLinePointsField,
              ProtoPoint(centre.x(), centre.y()));  // a spoke, so that it can be seen to turn
  for (int side = 0; side <= kCircleSides; ++side) {
    const double turn = 2 * kPi * side / kCircleSides;
    line->Bytes(kLinePointsField, ProtoPoint(centre.x() + double{outline.radius} * std::cos(turn),
                                             centre.y() + double{outline.radius} * std::sin(turn)));
  }
}

/// foxglove.LinePrimitive.
std::string Line(const Outline& outline, const Pose& pose, const ExportColour& colour) {
  constexpr std::uint64_t kStrip = 0, kLoop = 1;
  constexpr double kThickness_px = 2;
  const bool open = IsLine(outline.kind) || outline.kind == ShapeKind::kCircle;
  ProtoMessage place, paint, line;
  place.Bytes(1, ProtoPoint(double{pose.position.x()}, double{pose.position.y()}));
  place.Bytes(2, ProtoTurn(double{pose.angle}));
  paint.Double(1, colour.r);
  paint.Double(2, colour.g);
  paint.Double(3, colour.b);
  paint.Double(4, colour.a);
  line.Varint(1, open ? kStrip : kLoop);
  line.Bytes(2, place.bytes());
  line.Double(3, kThickness_px);
  line.Varint(4, 1);  // pixels, at any zoom
  AddPoints(outline, &line);
  line.Bytes(6, paint.bytes());
  return line.bytes();
}

/// foxglove.SceneEntity, fixed to `frame` for ever.
std::string Entity(const std::string& time, const std::string& frame, const std::string& id,
                   const BodyShapes& body, const Pose& pose, const ExportColour& colour) {
  ProtoMessage entity;
  entity.Bytes(1, time);
  entity.Bytes(2, frame);
  entity.Bytes(3, id);
  entity.Bytes(4, "");  // a lifetime of 0: for ever
  entity.Varint(5, 1);
  for (const Outline& outline : body.outlines) entity.Bytes(11, Line(outline, pose, colour));
  return entity.bytes();
}

}  // namespace

std::string ExportViewName(const ExportSession& session, int peer) {
  return peer == kOraclePeer ? "oracle" : session.ViewName(peer);
}

View OracleView(const ExportSession& session, const View& view) {
  View truth;
  truth.peer = kOraclePeer;
  truth.tick = view.tick;
  truth.revision = view.revision;
  for (const ExportBody& body : session.bodies) {
    const auto state = session.oracle->At(view.tick, body.id);
    if (!state) continue;
    truth.id.push_back(body.id);
    truth.x.push_back(state->position.x());
    truth.y.push_back(state->position.y());
    truth.angle.push_back(state->angle);
  }
  return truth;
}

std::uint64_t TimeNs(const ExportSession& session, std::int64_t tick) {
  if (tick <= 0) return 0;
  const auto hz = static_cast<std::uint64_t>(session.recording.room.tick_hz);
  const auto whole = static_cast<std::uint64_t>(tick);
  return whole / hz * 1000000000 + whole % hz * 1000000000 / hz;
}

std::string FramesOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows) {
  const std::string time = ProtoTime(session, view.tick);
  ProtoMessage frames;
  for (const ExportRow& row : rows) {
    const std::size_t i = row.i;
    ProtoMessage frame;
    frame.Bytes(1, time);
    frame.Bytes(2, "world");
    frame.Bytes(3, BodyFrame(session, view, row.id));
    frame.Bytes(4, RoundedPlace(view, i));
    frame.Bytes(5, RoundedTurn(view, i));
    frames.Bytes(1, frame.bytes());
  }
  return frames.bytes();
}

std::string SceneUpdateOf(const ExportSession& session, const View& view,
                          const std::vector<ExportRow>& rows) {
  constexpr std::uint64_t kDeleteAll = 1;
  const std::string time = ProtoTime(session, view.tick);
  const auto revision = session.revisions->At(view.revision);
  const DrawnRevision shapes = RevisionOf(revision->scene(), revision->composition());
  ProtoMessage deletion, update;
  deletion.Bytes(1, time);
  deletion.Varint(2, kDeleteAll);
  update.Bytes(1, deletion.bytes());
  for (const ExportRow& row : rows) {
    for (const BodyShapes& body : shapes.moving) {
      if (body.id != row.id) continue;
      const std::string frame = BodyFrame(session, view, row.id);
      update.Bytes(2, Entity(time, frame, frame, body, Pose(), ViewColour(view.peer)));
    }
  }
  return update.bytes();
}

std::string GroundOf(const ExportSession& session) {
  const std::string time = ProtoTime(session, session.recording.first_tick);
  const auto revision = session.revisions->At(0);
  ProtoMessage update;
  for (const BodyShapes& body : RevisionOf(revision->scene(), revision->composition()).anchored) {
    if (body.imposed >= 0) continue;  // it moves, and no view says where it is
    update.Bytes(
        2, Entity(time, "world", session.PartName(body.id), body, body.start, {0.5, 0.5, 0.5, 1}));
  }
  return update.bytes();
}

std::string ErrorsOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows) {
  MeanSquare all;
  double largest = 0;
  ProtoMessage errors;
  errors.Bytes(1, ExportViewName(session, view.peer));
  for (const ExportRow& row : rows) {
    if (!row.error_m) continue;
    all.Add(*row.error_m * *row.error_m);
    largest = std::max(largest, *row.error_m);
    ProtoMessage body;
    body.Bytes(1, session.of.at(row.id));
    body.Float(2, static_cast<float>(*row.error_m));
    errors.Bytes(4, body.bytes());
  }
  errors.Float(2, static_cast<float>(all.RootOrZero()));
  errors.Float(3, static_cast<float>(largest));
  return errors.bytes();
}

std::string ErrorsOf(std::int64_t tick, const std::vector<std::string>& views) {
  ProtoMessage errors;
  errors.Varint(1, static_cast<std::uint64_t>(tick));
  for (const std::string& view : views) errors.Bytes(2, view);
  return errors.bytes();
}

std::string InputOf(std::int64_t tick, const Input& input) {
  ProtoMessage message;
  message.Varint(1, static_cast<std::uint64_t>(tick));
  message.Float(2, static_cast<float>(input.drive) / 127);
  message.Float(3, static_cast<float>(input.lift) / 127);
  message.Varint(4, static_cast<std::uint64_t>(std::int64_t{input.buttons}));
  return message.bytes();
}

std::string LogOf(const ExportSession& session, const Event& event) {
  constexpr std::uint64_t kInfo = 2;
  ProtoMessage log;
  log.Bytes(1, ProtoTime(session, event.tick));
  log.Varint(2, kInfo);
  log.Bytes(3, event.text);
  log.Bytes(4, session.ViewName(event.peer));
  return log.bytes();
}

}  // namespace seam
