#include "common/codec/log_seal.h"

#include "common/base/check.h"

namespace seam {
namespace {

constexpr std::uint32_t kVarintBits = 7, kVarintMore = 0x80;

void PutVarint(std::int32_t value, std::vector<std::uint8_t>* to) {
  auto left = static_cast<std::uint32_t>(value);
  for (; left >= kVarintMore; left >>= kVarintBits) {
    to->push_back(static_cast<std::uint8_t>(left | kVarintMore));
  }
  to->push_back(static_cast<std::uint8_t>(left));
}

bool TakeVarint(const std::vector<std::uint8_t>& from, std::size_t* at, std::int32_t* value) {
  std::uint64_t sum = 0;
  for (std::uint32_t shift = 0; shift < 5 * kVarintBits && *at < from.size();
       shift += kVarintBits) {
    const std::uint8_t byte = from[(*at)++];
    sum |= static_cast<std::uint64_t>(byte & (kVarintMore - 1)) << shift;
    if ((byte & kVarintMore) != 0) continue;
    *value = static_cast<std::int32_t>(sum);
    return sum <= INT32_MAX;
  }
  return false;
}

}  // namespace

std::vector<std::uint8_t> PackTicks(const std::vector<SealedTick>& ticks) {
  SEAM_ASSERT(ticks.size() <= static_cast<std::size_t>(kSealTicksMax));
  std::vector<std::uint8_t> bytes;
  for (const SealedTick& tick : ticks) {
    PutVarint(tick.before, &bytes);
    PutVarint(tick.after, &bytes);
    bytes.push_back(static_cast<std::uint8_t>(tick.hash));
    bytes.push_back(static_cast<std::uint8_t>(tick.hash >> 8));
  }
  return bytes;
}

std::optional<std::vector<SealedTick>> TicksOf(const LogSeal& seal) {
  std::vector<SealedTick> ticks;
  const std::vector<std::uint8_t>& bytes = seal.ticks;
  for (std::size_t at = 0; at < bytes.size();) {
    SealedTick tick;
    if (!TakeVarint(bytes, &at, &tick.before) || !TakeVarint(bytes, &at, &tick.after)) return {};
    if (bytes.size() - at < sizeof tick.hash) return {};
    tick.hash = static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
    at += sizeof tick.hash;
    ticks.push_back(tick);
  }
  if (ticks.size() > static_cast<std::size_t>(kSealTicksMax)) return {};
  std::int64_t tick = seal.tick - static_cast<std::int64_t>(ticks.size());
  for (SealedTick& each : ticks) each.tick = ++tick;
  return ticks;
}

}  // namespace seam
