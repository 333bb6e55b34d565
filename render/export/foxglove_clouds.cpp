#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "render/canvas/shapes.h"
#include "render/export/foxglove.h"
#include "render/export/foxglove_parts.h"
#include "render/export/protobuf.h"

namespace seam {
namespace {

/// Points along outlines, for a foxglove.PointCloud: x, y, z as floats, then red, green, blue and
/// alpha as bytes.
class CloudPoints {
 public:
  explicit CloudPoints(const ExportColour& colour) : colour_(colour) {}

  /// Leaves out points farther than this from all places of bodies, m: a viewer fits all points.
  void StayNear(const Recording& recording) {
    constexpr float kNearBodies_m = 5;
    least_ = Vec2(1e9f, 1e9f);
    most_ = -least_;
    for (const auto& [peer, views] : recording.views) {
      for (const auto& [tick, view] : views) {
        for (std::size_t i = 0; i < view.id.size(); ++i) {
          const Vec2 place(view.x[i], view.y[i]), margin(kNearBodies_m, kNearBodies_m);
          least_ = least_.cwiseMin(place - margin);
          most_ = most_.cwiseMax(place + margin);
        }
      }
    }
  }

  void Add(const BodyShapes& body, const Pose& pose) {
    const Frame2 frame(pose);
    for (const Outline& outline : body.outlines) {
      if (outline.kind == ShapeKind::kCircle) {
        AddCircle(frame, outline);
        continue;
      }
      const std::size_t count = outline.points.size();
      const std::size_t edges = IsLine(outline.kind) ? count - 1 : count;
      for (std::size_t i = 0; i < edges; ++i) {
        AddEdge(frame(outline.points[i]), frame(outline.points[(i + 1) % count]));
      }
    }
  }

  std::string Message(const std::string& time, const std::string& frame) const {
    constexpr std::uint64_t kUint8 = 1, kFloat32 = 7;
    ProtoMessage cloud, pose;
    pose.Bytes(1, ProtoPoint(0, 0));
    pose.Bytes(2, ProtoTurn(0.0));
    cloud.Bytes(1, time);
    cloud.Bytes(2, frame);
    cloud.Bytes(3, pose.bytes());
    cloud.Fixed32(4, kStride);
    std::uint32_t offset = 0;
    for (const char* name : {"x", "y", "z", "red", "green", "blue", "alpha"}) {
      const bool place = name[1] == '\0';
      ProtoMessage field;
      field.Bytes(1, name);
      field.Fixed32(2, offset);
      field.Varint(3, place ? kFloat32 : kUint8);
      cloud.Bytes(5, field.bytes());
      offset += place ? 4 : 1;
    }
    cloud.Bytes(6, data_);
    return cloud.bytes();
  }

 private:
  static constexpr std::uint32_t kStride = 16;
  /// Distance of points along an edge, m, and most points of one edge, so that a long ground stays
  /// small.
  static constexpr float kSpacing_m = 0.1f;
  static constexpr int kEdgePointsMax = 200;

  void AddCircle(const Frame2& frame, const Outline& outline) {
    const auto point = [&](int side) {
      const float turn = 2 * kPiFloat * static_cast<float>(side) / kCircleSides;
      return frame(outline.points.front() + outline.radius * Vec2(std::cos(turn), std::sin(turn)));
    };
    AddEdge(frame(outline.points.front()), point(0));  // a spoke
    for (int side = 0; side < kCircleSides; ++side) AddEdge(point(side), point(side + 1));
  }

  void AddEdge(const Vec2& from, const Vec2& to) {
    const auto wanted = static_cast<int>((to - from).norm() / kSpacing_m);
    const int count = std::clamp(wanted, 1, kEdgePointsMax);
    for (int i = 0; i < count; ++i) {
      const Vec2 p = from + static_cast<float>(i) / static_cast<float>(count) * (to - from);
      if ((p - least_).minCoeff() < 0 || (most_ - p).minCoeff() < 0) continue;
      ProtoMessage::AppendFloat(p.x(), &data_);
      ProtoMessage::AppendFloat(p.y(), &data_);
      ProtoMessage::AppendFloat(0, &data_);
      for (const double part : {colour_.r, colour_.g, colour_.b, colour_.a}) {
        data_ += static_cast<char>(static_cast<std::uint8_t>(std::lround(255 * part)));
      }
    }
  }

  const ExportColour colour_;
  Vec2 least_{-1e9f, -1e9f}, most_{1e9f, 1e9f};  // points outside are left out
  std::string data_;
};

}  // namespace

std::vector<NamedMessage> CloudsOf(const ExportSession& session, const View& view,
                                   const std::vector<ExportRow>& rows) {
  const std::string time = ProtoTime(session, view.tick);
  const auto revision = session.revisions->At(view.revision);
  std::vector<NamedMessage> clouds;
  for (const BodyShapes& body : RevisionOf(revision->scene(), revision->composition()).moving) {
    const bool shown = std::any_of(rows.begin(), rows.end(),
                                   [&](const ExportRow& row) { return row.id == body.id; });
    if (!shown) continue;
    CloudPoints points(ViewColour(view.peer));
    points.Add(body, Pose());
    clouds.push_back(
        {session.of.at(body.id), points.Message(time, BodyFrame(session, view, body.id))});
  }
  return clouds;
}

std::string GroundCloudOf(const ExportSession& session) {
  const auto revision = session.revisions->At(0);
  CloudPoints points({0.5, 0.5, 0.5, 1});
  points.StayNear(session.recording);
  for (const BodyShapes& body : RevisionOf(revision->scene(), revision->composition()).anchored) {
    if (body.imposed < 0) points.Add(body, body.start);
  }
  return points.Message(ProtoTime(session, session.recording.first_tick), "world");
}

}  // namespace seam
