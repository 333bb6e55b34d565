#include "render/export/foxglove_parts.h"

#include <cmath>

#include "common/base/geometry.h"
#include "render/export/foxglove.h"
#include "render/export/protobuf.h"

namespace seam {

std::string ProtoTime(const ExportSession& session, std::int64_t tick) {
  const std::uint64_t ns = TimeNs(session, tick);
  ProtoMessage time;
  time.Varint(1, ns / 1000000000);
  time.Varint(2, ns % 1000000000);
  return time.bytes();
}

std::string ProtoPoint(double x, double y) {
  ProtoMessage vector;
  vector.Double(1, x);
  vector.Double(2, y);
  return vector.bytes();
}

std::string ProtoTurn(double z, double w) {
  ProtoMessage quaternion;
  quaternion.Double(3, z);
  quaternion.Double(4, w);
  return quaternion.bytes();
}
std::string ProtoTurn(double angle) { return ProtoTurn(std::sin(angle / 2), std::cos(angle / 2)); }

std::string BodyFrame(const ExportSession& session, const View& view, PartId id) {
  return ExportViewName(session, view.peer) + "/" + session.of.at(id);
}

ExportColour ViewColour(int peer) {
  if (peer == kOraclePeer) return {1, 1, 1, 0.6};
  const double hue = 2 * kPi * 0.36 * peer;
  const auto part = [&](double turn) { return 0.55 + 0.4 * std::cos(hue + turn); };
  return {part(0), part(-2 * kPi / 3), part(2 * kPi / 3)};
}

}  // namespace seam
