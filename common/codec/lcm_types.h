#pragma once
/// What a room and other programs exchange on LCM channels that its scene names (`[lcm]`): the
/// types pose_t, drive_t and message_t of lcmtypes. They are no messages of the room itself.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/status.h"

namespace seam {

/// A part's pose, from the server or from a player's client.
struct LcmPose {
  std::int64_t utime = 0;  ///< us since 1970, publisher's clock
  std::int64_t tick = 0;
  std::int32_t peer = 0;  ///< the publisher; 0: the server
  std::string name;
  double x = 0, y = 0, angle = 0;   ///< m, rad
  double vx = 0, vy = 0, spin = 0;  ///< m/s, rad/s
};

/// A player's inputs.
struct LcmDrive {
  std::int64_t utime = 0;      ///< us, sender's clock
  double drive = 0, lift = 0;  ///< -1..1
  std::int32_t buttons = 0;    ///< one bit per button, 0..kLcmButtonsMax
};
constexpr std::int32_t kLcmButtonsMax = 32767;

/// An event of a sensor or system, for the room's scripts.
struct LcmMessage {
  std::int64_t utime = 0;     ///< us, sender's clock
  std::string name;           ///< 1..kLcmNameBytesMax bytes
  std::vector<double> value;  ///< at most kLcmValuesMax
  std::string text;           ///< at most kTextBytesMax bytes
};
constexpr std::size_t kLcmNameBytesMax = 64, kLcmValuesMax = 64;

/// The same with its channel, as the log has it (heard_t, in an accepted_t).
struct LcmHeard {
  std::string channel;
  LcmMessage message;
};

/// Return one line if a value is no number or out of range.
Status Check(const LcmPose& pose);
Status Check(const LcmDrive& drive);
Status Check(const LcmMessage& message);

/// Encode as LCM does. Require valid values.
Bytes Encode(const LcmPose& pose);
Bytes Encode(const LcmDrive& drive);
Bytes Encode(const LcmMessage& message);
Bytes Encode(const LcmHeard& heard);

/// Decode the bytes of another program. Return one line if they are of another type or length, or a
/// value is no number or out of range.
Status Decode(ByteView bytes, LcmPose* pose);
Status Decode(ByteView bytes, LcmDrive* drive);
Status Decode(ByteView bytes, LcmMessage* message);
Status Decode(ByteView bytes, LcmHeard* heard);

}  // namespace seam
