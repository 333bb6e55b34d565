#include <cstdlib>
#include <variant>

#include "common/codec/codec.h"
#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/codec/validate.h"
#include "tests/codec/balls.h"
#include "tests/fuzz/targets.h"
#include "tests/support/random_messages.h"

namespace seam {
namespace {

const PackedMotion kFuzzMotion(0, -10, kBallsHz);

/// Adds one of TakePacked's datagrams.
void AddPacked(std::uint8_t kind, const Bytes& data, Bytes* out) {
  out->push_back(kind);
  out->push_back(static_cast<std::uint8_t>(data.size() >> 8));
  out->push_back(static_cast<std::uint8_t>(data.size()));
  out->insert(out->end(), data.begin(), data.end());
}

}  // namespace

void TakeMessage(ByteView bytes) {
  std::visit(
      [](const auto& message) {
        using Message = std::decay_t<decltype(message)>;
        if constexpr (!std::is_same_v<Message, std::monostate>) {
          // What was accepted is valid, so it can be sent on, and arrives.
          if (std::holds_alternative<std::monostate>(Decode(Encode(message)))) std::abort();
        }
        if constexpr (std::is_same_v<Message, Hello>) {
          Hole(message.name.size() > 1 && message.name[0] == 'Z' && message.protocol < 0);
        }
      },
      Decode(bytes));
}

std::vector<Bytes> MessageSeeds() {
  RandomMessages random(1);
  std::vector<Bytes> seeds;
#define SEAM_SEED(Struct, ...)        \
  {                                   \
    Struct message;                   \
    random.Fill(message);             \
    seeds.push_back(Encode(message)); \
  }
  SEAM_MESSAGES(SEAM_SEED)
#undef SEAM_SEED
  return seeds;
}

void TakePacked(ByteView bytes) {
  StatesUnpacker unpacker(kFuzzMotion);
  for (std::size_t at = 0; at + 3 <= bytes.size;) {
    const bool states = (bytes.data[at] & 1) != 0;
    const std::size_t told = static_cast<std::size_t>(bytes.data[at + 1]) << 8 | bytes.data[at + 2];
    const std::size_t size = std::min(told, bytes.size - at - 3);
    const Bytes data(bytes.data + at + 3, bytes.data + at + 3 + size);
    at += 3 + size;
    if (states) {
      PackedStates packed;
      packed.data = data;
      const std::vector<States>* const all = unpacker.Take(packed);
      if (all == nullptr) continue;
      for (const States& one : *all) {
        if (!Valid(one)) std::abort();
        Hole(one.id.size() == 1 && one.tick % 16 == 7);
      }
    } else if (const auto all = UnpackInputs(PackedInputs{data})) {
      for (const Inputs& one : *all) {
        if (!Valid(one)) std::abort();
      }
    }
  }
}

std::vector<Bytes> PackedSeeds() {
  std::vector<Bytes> seeds;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Balls balls(seed, 90);
    StatesPacker packer(kFuzzMotion);
    Bytes all;
    for (int tick = 0; tick < 4; ++tick) {
      balls.Step();
      for (const States& states : balls.Tell(0.2)) packer.Add(states);
      for (const StatesPacker::Message& message : packer.Take(0)) {
        AddPacked(1, message.packed.data, &all);
        packer.Acknowledge(message.number);
      }
    }
    seeds.push_back(all);
  }
  RandomMessages random(2);
  InputsPacker packer;
  for (int player = 0; player < 3; ++player) {
    Inputs inputs;
    random.Fill(inputs, 4);
    inputs.player = player;
    packer.Add(inputs);
  }
  Bytes all;
  AddPacked(0, packer.Finish().bits, &all);
  seeds.push_back(all);
  return seeds;
}

}  // namespace seam
