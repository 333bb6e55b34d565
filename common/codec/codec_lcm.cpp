#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/codec/lcm_types.h"
#include "common/codec/message_limits.h"
#include "common/codec/validate.h"
#include "seam/all_types.hpp"  // each LCM type's header; made by the Makefile

namespace seam {
namespace {

template <class Wire>
Bytes Encoded(const Wire& wire) {
  const int size = wire.getEncodedSize();
  Bytes bytes(static_cast<std::size_t>(size));
  SEAM_ASSERT(wire.encode(bytes.data(), 0, size) == size);
  return bytes;
}

template <class Wire>
Status Decoded(ByteView bytes, Wire* wire) {
  const int size = static_cast<int>(bytes.size);
  if (bytes.size <= kBusMessageBytesMax && wire->decode(bytes.data, 0, size) == size) {
    return Status::Ok();
  }
  return Status::Error(std::string("is no seam.") + Wire::getTypeName() +
                       " (another fingerprint or length)");
}

bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Sets or reads the fields that message_t and heard_t share.
template <class Wire>
void FillMessage(const LcmMessage& m, Wire* wire) {
  SEAM_ASSERT(Check(m).ok());
  wire->utime = m.utime;
  wire->name = m.name;
  wire->count = static_cast<std::int16_t>(m.value.size());
  wire->value = m.value;
  wire->text = m.text;
}
template <class Wire>
Status TakeMessage(const Wire& wire, LcmMessage* m) {
  *m = {wire.utime, wire.name, wire.value, wire.text};
  return Check(*m);
}

}  // namespace

Status Check(const LcmPose& p) {
  if (!AllFinite({p.x, p.y, p.angle, p.vx, p.vy, p.spin})) {
    return Status::Error("has a pose that is no finite number");
  }
  return Status::Ok();
}

Status Check(const LcmDrive& d) {
  // NaN is not within either.
  if (!(std::abs(d.drive) <= 1)) return Status::Error("has a drive that is not in -1..1");
  if (!(std::abs(d.lift) <= 1)) return Status::Error("has a lift that is not in -1..1");
  if (d.buttons < 0 || d.buttons > kLcmButtonsMax) {
    return Status::Error("has buttons that are not in 0..32767");
  }
  return Status::Ok();
}

Status Check(const LcmMessage& m) {
  if (m.name.empty() || !IsPrintable(m.name, kLcmNameBytesMax)) {
    return Status::Error("has no name of 1 to 64 printable bytes");
  }
  if (m.value.size() > kLcmValuesMax) return Status::Error("has more than 64 values");
  if (!AllFinite(m.value)) return Status::Error("has a value that is no finite number");
  if (!IsPrintable(m.text, kTextBytesMax)) {
    return Status::Error("has a text that is no line of at most 1000 printable bytes");
  }
  return Status::Ok();
}

Bytes Encode(const LcmPose& pose) {
  pose_t wire;
  wire.utime = pose.utime;
  wire.tick = pose.tick;
  wire.peer = pose.peer;
  wire.name = pose.name;
  wire.x = pose.x;
  wire.y = pose.y;
  wire.angle = pose.angle;
  wire.vx = pose.vx;
  wire.vy = pose.vy;
  wire.spin = pose.spin;
  return Encoded(wire);
}

Bytes Encode(const LcmDrive& drive) {
  drive_t wire;
  wire.utime = drive.utime;
  wire.drive = drive.drive;
  wire.lift = drive.lift;
  wire.buttons = drive.buttons;
  return Encoded(wire);
}

Bytes Encode(const LcmMessage& message) {
  message_t wire;
  FillMessage(message, &wire);
  return Encoded(wire);
}

Bytes Encode(const LcmHeard& heard) {
  heard_t wire;
  wire.channel = heard.channel;
  FillMessage(heard.message, &wire);
  return Encoded(wire);
}

Status Decode(ByteView bytes, LcmPose* pose) {
  pose_t wire;
  const Status status = Decoded(bytes, &wire);
  if (!status.ok()) return status;
  *pose = {wire.utime, wire.tick,  wire.peer, wire.name, wire.x,
           wire.y,     wire.angle, wire.vx,   wire.vy,   wire.spin};
  return Check(*pose);
}

Status Decode(ByteView bytes, LcmDrive* drive) {
  drive_t wire;
  const Status status = Decoded(bytes, &wire);
  if (!status.ok()) return status;
  *drive = {wire.utime, wire.drive, wire.lift, wire.buttons};
  return Check(*drive);
}

Status Decode(ByteView bytes, LcmMessage* message) {
  message_t wire;
  const Status status = Decoded(bytes, &wire);
  return status.ok() ? TakeMessage(wire, message) : status;
}

Status Decode(ByteView bytes, LcmHeard* heard) {
  heard_t wire;
  const Status status = Decoded(bytes, &wire);
  if (!status.ok()) return status;
  heard->channel = wire.channel;
  if (heard->channel.empty() || !IsPrintable(heard->channel, kLabelBytesMax)) {
    return Status::Error("has no channel");
  }
  return TakeMessage(wire, &heard->message);
}

}  // namespace seam
