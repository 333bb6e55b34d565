#include "common/codec/short_form.h"

#include "common/base/check.h"
#include "common/codec/codec.h"

namespace seam {
namespace {

constexpr std::uint8_t kTypeBits = 0x3f, kAsItWas = 0x40;
constexpr std::uint8_t kOtherType = kTypeBits;
constexpr std::uint8_t kEnd = 1;
constexpr std::size_t kHashBytes = 8, kWordBytes = 8;

std::uint8_t PlaceOfType(ByteView message) {
  SEAM_ASSERT(MessageTypes().size() <= kOtherType);
  const MessageType* const type = FindType(message);
  const bool of_edge = type != nullptr && type->on_edge == TypeHash(message);
  return of_edge ? static_cast<std::uint8_t>(type - MessageTypes().data()) : kOtherType;
}

/// Appends the words of `fields` and kEnd without their zeros.
void AppendPacked(ByteView fields, Bytes* out) {
  for (std::size_t word = 0; word <= fields.size; word += kWordBytes) {
    const std::size_t mask = out->size();
    out->push_back(0);
    for (std::size_t i = 0; i < kWordBytes; ++i) {
      const std::size_t at = word + i;
      const std::uint8_t byte = at < fields.size ? fields.data[at] : at == fields.size ? kEnd : 0;
      if (byte == 0) continue;
      (*out)[mask] = static_cast<std::uint8_t>((*out)[mask] | 1u << i);
      out->push_back(byte);
    }
  }
}

/// Appends the fields that AppendPacked packed. False if it cannot have made these bytes.
bool AppendUnpacked(ByteView packed, Bytes* out) {
  std::size_t at = 0;
  while (at < packed.size && out->size() <= kMessageBytesMax) {
    const std::uint8_t mask = packed.data[at++];
    for (std::size_t i = 0; i < kWordBytes; ++i) {
      const bool zero = (mask >> i & 1) == 0;
      if (!zero && at == packed.size) return false;
      out->push_back(zero ? std::uint8_t{0} : packed.data[at++]);
    }
  }
  if (at < packed.size || out->size() < kHashBytes + kWordBytes) return false;
  // The end is in the last word.
  const auto last = out->end() - static_cast<std::ptrdiff_t>(kWordBytes);
  while (out->end() > last && out->back() == 0) out->pop_back();
  if (out->end() == last || out->back() != kEnd) return false;
  out->pop_back();
  return true;
}

}  // namespace

Bytes ShortForm(ByteView message) {
  SEAM_ASSERT(message.size >= 1 && message.size <= kMessageBytesMax);
  const std::uint8_t type = PlaceOfType(message);
  const std::size_t skipped = type == kOtherType ? 0 : kHashBytes;
  const ByteView fields(message.data + skipped, message.size - skipped);
  Bytes bytes = {type};
  bytes.reserve(1 + fields.size + fields.size / kWordBytes + 2);
  if (type != kOtherType) AppendPacked(fields, &bytes);
  if (type != kOtherType && bytes.size() <= 1 + fields.size) return bytes;
  bytes.assign(1, static_cast<std::uint8_t>(type | kAsItWas));
  bytes.insert(bytes.end(), fields.begin(), fields.end());
  return bytes;
}

bool ReadShortForm(ByteView bytes, Bytes* message) {
  message->clear();
  if (bytes.size < 1 || bytes.size > kShortFormBytesMax) return false;
  const auto type = static_cast<std::uint8_t>(bytes.data[0] & kTypeBits);
  const bool packed = (bytes.data[0] & kAsItWas) == 0;
  const ByteView rest(bytes.data + 1, bytes.size - 1);
  if (bytes.data[0] > (kTypeBits | kAsItWas)) return false;
  if (type == kOtherType) {
    if (packed || rest.size == 0) return false;
  } else {
    const std::vector<MessageType>& types = MessageTypes();
    if (type >= types.size()) return false;
    for (int shift = 56; shift >= 0; shift -= 8) {
      message->push_back(static_cast<std::uint8_t>(types[type].on_edge >> shift));
    }
  }
  if (packed && !AppendUnpacked(rest, message)) return false;
  if (!packed) message->insert(message->end(), rest.begin(), rest.end());
  return message->size() <= kMessageBytesMax;
}

int TypeOfShortForm(ByteView bytes) {
  if (bytes.size == 0) return -1;
  const int type = bytes.data[0] & kTypeBits;
  return static_cast<std::size_t>(type) < MessageTypes().size() ? type : -1;
}

}  // namespace seam
