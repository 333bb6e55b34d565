#pragma once
/// Messages in saved state, as the bytes of the wire.

#include <string>
#include <utility>
#include <variant>

#include "common/base/state_archive.h"
#include "common/codec/codec.h"
#include "common/codec/message_limits.h"

namespace seam {

/// Writes or reads a message of one type.
template <class Message>
void PersistMessage(StateArchive& a, Message* message, std::size_t bytes_most) {
  std::string bytes;
  if (!a.reading()) {
    const Bytes encoded = Encode(*message);
    bytes.assign(encoded.begin(), encoded.end());
  }
  a.Text(&bytes, bytes_most);
  if (!a.reading()) return;
  AnyMessage any = Decode(Bytes(bytes.begin(), bytes.end()));
  Message* const read = std::get_if<Message>(&any);
  a.Require(read != nullptr, "a message is malformed");
  *message = read != nullptr ? std::move(*read) : Message();
}

}  // namespace seam
