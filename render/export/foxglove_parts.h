#pragma once
/// Parts of Foxglove's messages, and names and colours of their bodies.

#include <string>

#include "render/export/session.h"

namespace seam {

struct ExportColour {
  double r = 0, g = 0, b = 0, a = 1;
};

/// Sides of the polygon for a circle.
constexpr int kCircleSides = 24;

/// google.protobuf.Timestamp of a tick.
std::string ProtoTime(const ExportSession& session, std::int64_t tick);
/// foxglove.Vector3 or Point3.
std::string ProtoPoint(double x, double y);
/// foxglove.Quaternion of a rotation about z.
std::string ProtoTurn(double z, double w);
std::string ProtoTurn(double angle);

/// Returns the frame of a body of a view: "VIEW/BODY".
std::string BodyFrame(const ExportSession& session, const View& view, PartId id);
/// Returns a view's colour: hues a little more than a third of the colour circle apart; the
/// oracle's is white.
ExportColour ViewColour(int peer);

}  // namespace seam
