#include <algorithm>
#include <string>

#include "common/codec/codec.h"
#include "common/sync/inputs/input_source.h"
#include "common/sync/method.h"
#include "server/server.h"
#include "tests/fuzz/targets.h"
#include "tests/support/random_messages.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace {

/// The operations, each a byte, modulo their number.
enum : std::uint8_t {
  kTick,        ///< one tick passes
  kTicks,       ///< as many as the next byte says, at most 63
  kReliable,    ///< a message: its type in MessageTypes, its length in two bytes, what follows the
                ///< hash
  kUnreliable,  ///< the same
  kStranger,    ///< a datagram from another address: its length in two bytes, its bytes
  kForged,      ///< a datagram from the client's address, likewise: not sealed
  kHello,       ///< a stranger says hello
  kOperations
};
constexpr int kTicksMost = 600;

constexpr const char* kYard = R"([[player]]
name = "ann"
vehicle = "car"
[[player]]
name = "bob"
[[part]]
name = "ground"
chain = [[-60, 0], [60, 0]]
[[part]]
name = "car"
box = [2, 0.5]
position = [-4, 0.5]
velocity = [2, 0]
owner = "ann"
[[part]]
name = "crate"
box = [0.6, 0.6]
position = [2, 0.3]
repeat = {count = [1, 3], step = [0, 0.6], glue = 900}
[[trigger]]
name = "gate"
kind = "area"
position = [0, 1]
box = [2, 2]
score = 1
)";

class FuzzedRoom {
 public:
  FuzzedRoom() {
    ServerConfig config;
    config.sync = MakeSyncConfig("buffer", "");
    config.publish = Publish::kNone;
    server_ = std::make_unique<Server>(scene_, config, *net_, silence_, entropy_);
    ann_.SayHello();
    for (int i = 0; i < 40 && !ready_; ++i) {
      Step();
      if (!ann_.welcomed) {
        ann_.SayJoin();
      } else if (i > 5) {
        ann_.link.SendReliable(Encode(Ready()));
        ready_ = true;
      }
    }
    for (int i = 0; i < 20; ++i) Step();
  }

  void Step() {
    now_us_ += 16667;
    server_->Tick(now_us_, 0);
    ann_.Read(now_us_);
    ann_.Flush(now_us_);
    ++ticks_;
  }
  void Run(ByteView bytes) {
    std::size_t at = 0;
    const auto next = [&] { return at < bytes.size ? bytes.data[at++] : std::uint8_t{0}; };
    const auto take = [&] {
      std::size_t size = static_cast<std::size_t>(next()) << 8;
      size |= next();
      size = std::min(std::min<std::size_t>(size, 1400), bytes.size - at);
      const Bytes part(bytes.data + at, bytes.data + at + size);
      at += size;
      return part;
    };
    while (at < bytes.size && ticks_ < kTicksMost) {
      switch (next() % kOperations) {
        case kTick: Step(); break;
        case kTicks:
          for (int n = next() & 63; n > 0; --n) Step();
          break;
        case kReliable: ann_.link.SendReliable(Message(next(), take())); break;
        case kUnreliable: ann_.link.SendUnreliable(Message(next(), take())); break;
        case kStranger: stranger_.net->Send(Guest::kServer, take()); break;
        case kForged: ann_.net->Send(Guest::kServer, take()); break;
        default: stranger_.SayHello(); break;
      }
    }
    Step();
    Step();
  }
  const Server& server() const { return *server_; }

 private:
  class Silence : public Recorder {
   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };

  static Bytes Message(std::uint8_t type, const Bytes& fields) {
    const std::vector<MessageType>& types = MessageTypes();
    const std::uint64_t hash = types[type % types.size()].hash;
    Bytes message;
    for (int shift = 56; shift >= 0; shift -= 8) {
      message.push_back(static_cast<std::uint8_t>(hash >> shift));
    }
    message.insert(message.end(), fields.begin(), fields.end());
    return message;
  }

  const Scene scene_ = ParseScene(kYard, "yard.toml");
  MemoryNetwork network_;
  std::unique_ptr<Net> net_ = network_.Attach(Guest::kServer);
  SeededEntropy entropy_{1};
  Silence silence_;
  std::unique_ptr<Server> server_;
  Guest ann_{&network_, 1, "ann"}, stranger_{&network_, 2, "eve"};
  bool ready_ = false;
  int ticks_ = 0;
  std::int64_t now_us_ = 1000000;
};

/// Adds kReliable with an encoded message.
void AddMessage(const Bytes& encoded, Bytes* out) {
  const std::vector<MessageType>& types = MessageTypes();
  std::uint64_t hash = 0;
  for (int i = 0; i < 8; ++i) hash = hash << 8 | encoded[static_cast<std::size_t>(i)];
  std::size_t type = 0;
  while (type < types.size() && types[type].hash != hash) ++type;
  const std::size_t size = encoded.size() - 8;
  for (const std::size_t byte : {std::size_t{kReliable}, type, size >> 8, size & 255}) {
    out->push_back(static_cast<std::uint8_t>(byte));
  }
  out->insert(out->end(), encoded.begin() + 8, encoded.end());
}

}  // namespace

void TakeSession(ByteView bytes) {
  FuzzedRoom room;
  const std::int64_t before = room.server().stats().dropped_malformed;
  room.Run(bytes);
  if (room.server().tick() < 5) std::abort();  // the room goes on
  for (int body = 0; body < room.server().replica().world().body_count(); ++body) {
    if (!room.server().replica().world().Read(body).position.allFinite()) std::abort();
  }
  Hole(room.server().stats().dropped_right > 0 &&
       room.server().stats().dropped_malformed == before);
}

std::vector<Bytes> SessionSeeds() {
  std::vector<Bytes> seeds;
  RandomMessages random(5);
  for (int i = 0; i < 6; ++i) {
    Bytes ops;
    Inputs inputs;
    random.Fill(inputs, 3);
    inputs.player = 0;
    inputs.first_tick = 30 + i;
    AddMessage(Encode(inputs), &ops);
    ops.push_back(kTicks), ops.push_back(5);
    States states;
    random.Fill(states, 1);
    states.peer = 1;
    states.tick = 30;
    AddMessage(Encode(states), &ops);
    ops.push_back(kTick);
    Ping ping;
    random.Fill(ping);
    AddMessage(Encode(ping), &ops);
    ops.push_back(kHello), ops.push_back(kTicks), ops.push_back(20);
    seeds.push_back(ops);
  }
#define SEAM_SEED(Struct, ...)           \
  {                                      \
    Struct message;                      \
    random.Fill(message);                \
    const Bytes bytes = Encode(message); \
    Bytes ops;                           \
    if (bytes.size() < 1300) {           \
      AddMessage(bytes, &ops);           \
      ops.push_back(kTick);              \
      seeds.push_back(ops);              \
    }                                    \
  }
  SEAM_MESSAGES(SEAM_SEED)
#undef SEAM_SEED
  return seeds;
}

}  // namespace seam
