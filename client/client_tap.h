#pragma once
/// Passes on all that a client receives: a relay serves its own watchers with it.

#include "common/base/bytes.h"
#include "common/codec/codec.h"

namespace seam {

class ClientTap {
 public:
  virtual ~ClientTap() = default;
  /// Called when the client has loaded the room. Everything from before is void.
  virtual void OnRoom() = 0;
  /// Called with each message of the session, before the client acts on it. `bytes`: the same,
  /// encoded.
  virtual void OnMessage(const AnyMessage& message, ByteView bytes) = 0;
  /// Called with all states, packed or not, of any message.
  virtual void OnStates(const States& states) = 0;
};

}  // namespace seam
