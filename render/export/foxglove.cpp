#include "render/export/foxglove.h"

#include <cmath>

#include "common/base/geometry.h"
#include "common/measure/mean_square.h"
#include "render/canvas/shapes.h"
#include "common/base/json_text.h"

namespace seam {
namespace {

std::string Time(const ExportSession& session, std::int64_t tick) {
  const std::uint64_t ns = TimeNs(session, tick);
  return "{\"sec\":" + std::to_string(ns / 1000000000) +
         ",\"nsec\":" + std::to_string(ns % 1000000000) + "}";
}

std::string Xyz(double x, double y) {
  return "{\"x\":" + JsonNumber(x) + ",\"y\":" + JsonNumber(y) + ",\"z\":0}";
}

/// Returns a rotation about z as a quaternion.
std::string Turn(double angle) {
  return "{\"x\":0,\"y\":0,\"z\":" + JsonNumber(std::sin(angle / 2)) +
         ",\"w\":" + JsonNumber(std::cos(angle / 2)) + "}";
}

std::string Frame(const ExportSession& session, const View& view, PartId id) {
  return session.ViewName(view.peer) + "/" + session.of.at(id);
}

void Append(std::string* list, const std::string& item) {
  if (!list->empty()) *list += ',';
  *list += item;
}

/// Returns a view's colour: hues a little more than a third of the colour circle apart.
std::string Colour(int peer) {
  const double hue = 2 * kPi * 0.36 * peer;
  const auto part = [&](double turn) { return 0.55 + 0.4 * std::cos(hue + turn); };
  return "{\"r\":" + JsonNumber(part(0)) + ",\"g\":" + JsonNumber(part(-2 * kPi / 3)) +
         ",\"b\":" + JsonNumber(part(2 * kPi / 3)) + ",\"a\":1}";
}

/// Sides of the polygon for a circle.
constexpr int kCircleSides = 24;

std::string PointsOf(const Outline& outline) {
  std::string points;
  if (outline.kind != ShapeKind::kCircle) {
    for (const Vec2& p : outline.points) Append(&points, Xyz(double{p.x()}, double{p.y()}));
    return points;
  }
  const Eigen::Vector2d centre = outline.points.front().cast<double>();
  Append(&points, Xyz(centre.x(), centre.y()));  // a spoke, so that it can be seen to turn
  for (int side = 0; side <= kCircleSides; ++side) {
    const double turn = 2 * kPi * side / kCircleSides;
    Append(&points, Xyz(centre.x() + double{outline.radius} * std::cos(turn),
                        centre.y() + double{outline.radius} * std::sin(turn)));
  }
  return points;
}

/// foxglove.LinePrimitive: type 0 is a strip, 1 a loop.
std::string Line(const Outline& outline, const Pose& pose, const std::string& colour) {
  const bool open = IsLine(outline.kind) || outline.kind == ShapeKind::kCircle;
  return "{\"type\":" + std::string(open ? "0" : "1") +
         ",\"pose\":{\"position\":" + Xyz(double{pose.position.x()}, double{pose.position.y()}) +
         ",\"orientation\":" + Turn(double{pose.angle}) +
         "},\"thickness\":2,\"scale_invariant\":true,\"points\":[" + PointsOf(outline) +
         "],\"color\":" + colour + ",\"colors\":[],\"indices\":[]}";
}

/// foxglove.SceneEntity, fixed to `frame` for ever.
std::string Entity(const std::string& time, const std::string& frame, const std::string& id,
                   const BodyShapes& body, const Pose& pose, const std::string& colour) {
  std::string lines;
  for (const Outline& outline : body.outlines) Append(&lines, Line(outline, pose, colour));
  return "{\"timestamp\":" + time + ",\"frame_id\":" + JsonText(frame) + ",\"id\":" + JsonText(id) +
         ",\"lifetime\":{\"sec\":0,\"nsec\":0},\"frame_locked\":true,\"metadata\":[],\"lines\":[" +
         lines + "]}";
}

}  // namespace

std::uint64_t TimeNs(const ExportSession& session, std::int64_t tick) {
  if (tick <= 0) return 0;
  const auto hz = static_cast<std::uint64_t>(session.recording.room.tick_hz);
  const auto whole = static_cast<std::uint64_t>(tick);
  return whole / hz * 1000000000 + whole % hz * 1000000000 / hz;
}

std::string FramesOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows) {
  const std::string time = Time(session, view.tick);
  std::string frames;
  for (const ExportRow& row : rows) {
    const std::size_t i = row.i;
    Append(&frames, "{\"timestamp\":" + time + ",\"parent_frame_id\":\"world\"" +
                        ",\"child_frame_id\":" + JsonText(Frame(session, view, row.id)) +
                        ",\"translation\":" + Xyz(double{view.x[i]}, double{view.y[i]}) +
                        ",\"rotation\":" + Turn(double{view.angle[i]}) + "}");
  }
  return "{\"transforms\":[" + frames + "]}";
}

std::string SceneUpdateOf(const ExportSession& session, const View& view,
                          const std::vector<ExportRow>& rows) {
  const std::string time = Time(session, view.tick);
  const auto revision = session.revisions->At(view.revision);
  const DrawnRevision shapes = RevisionOf(revision->scene(), revision->composition());
  std::string entities;
  for (const ExportRow& row : rows) {
    for (const BodyShapes& body : shapes.moving) {
      if (body.id != row.id) continue;
      const std::string frame = Frame(session, view, row.id);
      Append(&entities, Entity(time, frame, frame, body, Pose(), Colour(view.peer)));
    }
  }
  // A deletion of type 1 deletes all entities.
  return "{\"deletions\":[{\"timestamp\":" + time + ",\"type\":1,\"id\":\"\"}],\"entities\":[" +
         entities + "]}";
}

std::string GroundOf(const ExportSession& session) {
  const std::string time = Time(session, session.recording.first_tick);
  const auto revision = session.revisions->At(0);
  std::string entities;
  for (const BodyShapes& body : RevisionOf(revision->scene(), revision->composition()).anchored) {
    if (body.imposed >= 0) continue;  // it moves, and no view says where it is
    Append(&entities, Entity(time, "world", session.PartName(body.id), body, body.start,
                             "{\"r\":0.5,\"g\":0.5,\"b\":0.5,\"a\":1}"));
  }
  return "{\"deletions\":[],\"entities\":[" + entities + "]}";
}

std::string ErrorsOf(const ExportSession& session, const View& view,
                     const std::vector<ExportRow>& rows) {
  MeanSquare all;
  std::optional<double> largest;
  std::string errors;
  for (const ExportRow& row : rows) {
    Append(&errors, JsonText(session.of.at(row.id)) + ":" + JsonNumber(row.error_m));
    if (!row.error_m) continue;
    all.Add(*row.error_m * *row.error_m);
    largest = std::max(largest.value_or(0), *row.error_m);
  }
  return "{\"tick\":" + std::to_string(view.tick) + ",\"rms_m\":" + JsonNumber(all.Root()) +
         ",\"max_m\":" + JsonNumber(largest) + ",\"error_m\":{" + errors + "}}";
}

std::string LogOf(const ExportSession& session, const Event& event) {
  return "{\"timestamp\":" + Time(session, event.tick) +
         ",\"level\":2,\"message\":" + JsonText(event.text) +
         ",\"name\":" + JsonText(session.ViewName(event.peer)) + ",\"file\":\"\",\"line\":0}";
}

}  // namespace seam
