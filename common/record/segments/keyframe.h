#pragma once
/// With which a segment of a log begins, so that it can be read alone: the messages of before that
/// its readers need, as `seam-log cut` keeps them. Views say all poses in each tick, so no body is
/// in it.

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>

#include "common/base/bytes.h"
#include "common/codec/messages.h"

namespace seam {

class Keyframe {
 public:
  using Visit = std::function<void(const std::string& channel, ByteView message)>;
  /// Notes a message of the log. A Room of another session than before begins a new one.
  void Note(const std::string& channel, ByteView message);
  /// Calls `visit` with each message: the scene, all edits, the newest values, and the last inputs
  /// of each player. The numbers of a channel lead up to that of its next message.
  void Each(const Visit& visit) const;

 private:
  /// Kind, id and key of a Meta.
  using ValueName = std::array<std::int32_t, 3>;
  void NoteValues(const std::string& channel, ByteView message);
  void EachOfValues(const Visit& visit) const;

  std::int64_t session_ = 0;
  std::map<std::string, Bytes> newest_;            // Room and Inputs, by channel
  std::map<std::string, std::deque<Bytes>> kept_;  // edits, and the last round of ScenePart
  std::string values_channel_;
  Meta newest_values_;  // the last message, without its values
  std::map<ValueName, float> values_;
};

}  // namespace seam
