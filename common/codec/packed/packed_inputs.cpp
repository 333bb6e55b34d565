#include "common/codec/packed/packed_inputs.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/codec/validate.h"

namespace seam {
namespace {

constexpr int kTickBits = 40;
static_assert(kTickMax <= std::int64_t{1} << kTickBits);
/// Golomb parameters of the gap between players, the distance in ticks, and the ticks less one.
constexpr int kGapBits = 1, kApartBits = 1, kTicksBits = 2;
/// Most bits of an entry's head, and of one tick.
constexpr std::size_t kEntryBitsMost = 1 + kTickBits + 17 + 25 + 13;
constexpr std::size_t kTickBitsMost = 1 + 3 + 8 + 8 + 16;
/// Largest distance of the newest ticks of two players in one message.
constexpr std::int64_t kTicksApartMax = 1000;

/// Inputs of one tick; all 0 before the first.
struct Held {
  std::int8_t drive = 0, lift = 0;
  std::int16_t buttons = 0;
};

void PutField(int value, int before, int width, BitWriter* bits) {
  bits->Put(value != before ? 1 : 0, 1);
  if (value != before) bits->Put(static_cast<std::uint16_t>(value), width);
}

void PutTick(const Held& now, const Held& before, BitWriter* bits) {
  const bool same =
      now.drive == before.drive && now.lift == before.lift && now.buttons == before.buttons;
  bits->Put(same ? 0 : 1, 1);
  if (same) return;
  PutField(now.drive, before.drive, 8, bits);
  PutField(now.lift, before.lift, 8, bits);
  PutField(now.buttons, before.buttons, 16, bits);
}

Held GetTick(const Held& before, BitReader* bits) {
  Held now = before;
  if (bits->Get(1) == 0) return now;
  if (bits->Get(1) != 0) now.drive = static_cast<std::int8_t>(bits->Get(8));
  if (bits->Get(1) != 0) now.lift = static_cast<std::int8_t>(bits->Get(8));
  if (bits->Get(1) != 0) now.buttons = static_cast<std::int16_t>(bits->Get(16));
  return now;
}

/// Reads the entry after that of `player`. The result's player is -1 if it has more than kInputsMax
/// ticks or no valid player.
Inputs GetEntry(int player, std::int64_t newest, BitReader* bits) {
  Inputs inputs;
  const std::uint32_t gap = bits->GetGolomb(kGapBits);
  const std::int64_t last = newest + UnZigZag(bits->GetGolomb(kApartBits));
  const std::uint32_t more = bits->GetGolomb(kTicksBits);
  inputs.player = gap < kPlayersMax ? player + 1 + static_cast<int>(gap) : -1;
  inputs.first_tick = last - more;
  Held held;
  for (std::uint32_t i = 0; i <= more && i < kInputsMax; ++i) {
    held = GetTick(held, bits);
    inputs.drive.push_back(held.drive);
    inputs.lift.push_back(held.lift);
    inputs.buttons.push_back(held.buttons);
  }
  const bool whole = more < kInputsMax && inputs.player < kPlayersMax;
  if (!whole) inputs.player = -1;
  return inputs;
}

}  // namespace

bool InputsPacker::Add(const Inputs& inputs, std::size_t newest) {
  const std::size_t known = inputs.drive.size(), ticks = std::min(known, newest);
  SEAM_ASSERT(ticks > 0 && inputs.lift.size() == known && inputs.buttons.size() == known);
  SEAM_ASSERT(inputs.player >= 0 && inputs.player < kPlayersMax);
  const std::int64_t last = inputs.first_tick + static_cast<std::int64_t>(known) - 1;
  const std::int64_t apart = empty() ? 0 : last - newest_;
  const std::size_t most = 1 + (kEntryBitsMost + kTickBitsMost * ticks + 1) / 8;
  const bool fits = bits_.size() + most <= kPackedBytesMax;
  if (!empty() &&
      (!fits || inputs.player <= player_ || apart > kTicksApartMax || apart < -kTicksApartMax)) {
    return false;
  }
  if (empty()) {
    newest_ = last;
    bits_.Put(static_cast<std::uint64_t>(last) >> 32, kTickBits - 32);
    bits_.Put(static_cast<std::uint64_t>(last) & 0xffffffffu, 32);
  } else {
    bits_.Put(1, 1);
  }
  bits_.PutGolomb(static_cast<std::uint32_t>(inputs.player - player_ - 1), kGapBits);
  bits_.PutGolomb(ZigZag(static_cast<std::int32_t>(apart)), kApartBits);
  bits_.PutGolomb(static_cast<std::uint32_t>(ticks - 1), kTicksBits);
  Held before;
  for (std::size_t i = known - ticks; i < known; ++i) {
    const Held now{inputs.drive[i], inputs.lift[i], inputs.buttons[i]};
    PutTick(now, before, &bits_);
    before = now;
  }
  player_ = inputs.player;
  return true;
}

PackedInputs InputsPacker::Finish() {
  SEAM_ASSERT(!empty());
  bits_.Put(0, 1);
  player_ = -1;
  return {bits_.Finish()};
}

std::optional<std::vector<Inputs>> UnpackInputs(const PackedInputs& packed) {
  BitReader bits(ByteView(packed.bits.data(), packed.bits.size()));
  std::vector<Inputs> all;
  const std::uint64_t high = bits.Get(kTickBits - 32);
  const auto newest = static_cast<std::int64_t>(high << 32 | bits.Get(32));
  int player = -1;
  do {
    Inputs inputs = GetEntry(player, newest, &bits);
    if (!bits.ok() || !Valid(inputs)) return std::nullopt;
    player = inputs.player;
    all.push_back(std::move(inputs));
  } while (bits.Get(1) != 0);
  if (!bits.AtEnd()) return std::nullopt;
  return all;
}

}  // namespace seam
