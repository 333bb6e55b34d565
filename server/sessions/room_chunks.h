#pragma once
/// The room's description as joiners get it: compressed, in pieces, as fast as they acknowledge it.

#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/net/link.h"

namespace seam {

class RoomChunks {
 public:
  /// `room`: the encoded Room.
  explicit RoomChunks(const Bytes& room);

  /// Returns the size of the compressed bytes.
  std::size_t size() const { return bytes_.size(); }
  /// Gives the link the next messages; it holds few at a time, so that a joiner costs no copy of a
  /// long scene. `*sent`: bytes given so far.
  void SendAhead(std::int64_t now_us, Link* link, std::size_t* sent) const;
  /// Returns the time in which a slow machine unpacks and parses the room, us. Meanwhile its client
  /// is silent.
  std::int64_t load_us() const { return load_us_; }
  /// Returns the latest time at which a client that was admitted at `created_us` gets ready, us.
  std::int64_t ReadyByUs(std::int64_t created_us) const;

 private:
  const Bytes bytes_;
  const std::int64_t load_us_;
};

}  // namespace seam
