/// A seam-server and its clients on a path with an attacker: real UDP, and a relay between client
/// and server that adds, damages and forges datagrams under their addresses.

#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "common/base/process.h"
#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/net/link.h"
#include "tests/support/live_session.h"
#include "tests/support/path/link_keys.h"
#include "tests/support/path/middle.h"
#include "tests/support/udp_socket.h"

namespace seam {
namespace bombard_test {

constexpr std::uint64_t kSeed = 20;
constexpr std::int64_t kTicks = 240;  ///< of a session

/// Stands between one client and the server. The server knows the client by this relay's address.
class Relay {
 public:
  /// Called with a datagram in flight; its result is passed on.
  using Change = std::function<Bytes(const Bytes&)>;

  explicit Relay(std::uint16_t server_port) : server_port_(server_port) {}
  std::uint16_t port() const { return to_client_.port(); }

  /// Passes on received datagrams, waiting at most a millisecond.
  void Pass(const Change& up, const Change& down) {
    pollfd wait[2] = {{to_client_.fd(), POLLIN, 0}, {to_server_.fd(), POLLIN, 0}};
    poll(wait, 2, 1);
    std::uint16_t from = 0;
    Bytes data;
    for (int i = 0; i < 1000 && to_client_.Receive(&from, &data); ++i) {
      client_port_ = from;
      Keep(&sent_up, data);
      to_server_.Send(server_port_, up(data));
    }
    for (int i = 0; i < 1000 && to_server_.Receive(&from, &data); ++i) {
      if (from != server_port_) continue;
      Keep(&sent_down, data);
      to_client_.Send(client_port_, down(data));
    }
  }
  bool ForgeUp(const Bytes& data) { return to_server_.Send(server_port_, data); }
  bool ForgeDown(const Bytes& data) { return to_client_.Send(client_port_, data); }
  std::uint16_t client_port() const { return client_port_; }

  std::vector<Bytes> sent_up, sent_down;  ///< the last real ones

 private:
  static void Keep(std::vector<Bytes>* kept, const Bytes& data) {
    if (kept->size() == 64) kept->erase(kept->begin());
    kept->push_back(data);
  }

  UdpSocket to_client_, to_server_;
  const std::uint16_t server_port_;
  std::uint16_t client_port_ = 0;
};

const Relay::Change kUnchanged = [](const Bytes& data) { return data; };

class Bombarded : public ::testing::Test {
 protected:
  Bombarded() {
    server_ = std::make_unique<Program>(std::vector<std::string>{
        BuiltProgram("seam-server"), "scenes/crossing.toml", "--bind", "127.0.0.1:0", "--lcm-url",
        "none", "--quiet", "--duration", "4", "--record", folder_ / "server.lcm"});
    EXPECT_TRUE(server_->WaitForErrors("waiting for", 20)) << server_->Story();
    const std::string line = server_->errors();
    server_port_ = static_cast<std::uint16_t>(std::atoi(line.c_str() + line.find("on 127.") + 13));
  }

  std::unique_ptr<Program> Join(const std::string& name, std::uint16_t port) {
    return std::make_unique<Program>(
        std::vector<std::string>{BuiltProgram("seam-client"), "127.0.0.1:" + std::to_string(port),
                                 "--name", name, "--drive", name, "--lcm-url", "none", "--quiet"});
  }

  static long Number(const Program& program, const std::string& word) {
    return NumberBefore(program.errors(), word);
  }

  /// Expects the room to have run to its end with `name` in it from the beginning.
  void ExpectStayed(const std::string& name, int peer) {
    EXPECT_EQ(server_->status(), 0) << server_->Story();
    EXPECT_GE(Number(*server_, " ticks"), kTicks) << server_->Story();
    const Recording record = ReadRecording(folder_ / "server.lcm");
    EXPECT_EQ(record.undecodable, 0);
    int joined = 0;
    for (const Event& event : record.events) {
      if (event.text.rfind(name + " joins", 0) == 0) ++joined;
      EXPECT_EQ(event.text.find(name + " (peer"), std::string::npos) << event.text;
    }
    EXPECT_EQ(joined, 1);
    std::int64_t last = -1;
    for (const States& states : record.states) {
      if (states.peer == peer) last = std::max(last, states.tick);
    }
    EXPECT_GE(last, kTicks - 30) << "its states were accepted to the end";
  }

  Workspace folder_;
  std::unique_ptr<Program> server_;
  std::uint16_t server_port_ = 0;
  Random random_{kSeed};
};

Bytes Garbage(Random* random, std::size_t bytes) {
  Bytes data(bytes);
  for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random->Next());
  return data;
}

/// A message of the protocol in a conversation that nobody has begun.
Bytes Foreign(Random* random) {
  Link link(LinkKeys(random->Next() | 1));
  Ping ping;
  Inputs inputs;
  inputs.drive = inputs.lift = {127};
  inputs.buttons = {0};
  switch (random->Next() % 3) {
    case 0: link.SendUnreliable(Encode(ping)); break;
    case 1: link.SendReliable(Encode(inputs)); break;
    default: link.SendUnreliable(Garbage(random, 1 + random->Next() % 1000)); break;
  }
  Bytes out;
  link.Flush(1, [&](ByteView datagram) { out.assign(datagram.begin(), datagram.end()); });
  return out;
}

/// A datagram that must be dropped: made of `real` ones, or of nothing.
Bytes Bad(Random* random, const std::vector<Bytes>& real) {
  Bytes data = real[random->Next() % real.size()];
  switch (random->Next() % 7) {
    case 0: return Garbage(random, random->Next() % 1201);
    case 1: return Garbage(random, 1201 + random->Next() % 1000);
    case 2: data.resize(random->Next() % data.size()); return data;
    case 3: data.resize(data.size() + 1 + random->Next() % 8); return data;
    case 4: return data;  // again: it has arrived already
    case 5: return Foreign(random);
    default:
      for (std::uint64_t i = 0, n = 1 + random->Next() % 8; i < n; ++i) {
        const auto bit = 1u << (random->Next() % 8);
        auto& byte = data[(random->Next() % data.size())];
        byte = static_cast<std::uint8_t>(byte ^ bit);
      }
      return data;
  }
}

TEST_F(Bombarded, TheServerCountsForeignDatagramsAndKeepsItsClients) {
  Relay relay(server_port_);
  auto ann = Join("ann", relay.port());
  auto bob = Join("bob", server_port_);
  std::vector<UdpSocket> strangers(8);
  long up = 0, down = 0;
  std::int64_t began_us = -1;
  const std::int64_t deadline_us = SteadyClockUs() + 60000000;
  while (!server_->Wait(0) && SteadyClockUs() < deadline_us) {
    relay.Pass(kUnchanged, kUnchanged);
    if (relay.sent_up.size() < 64) continue;
    const std::int64_t now_us = SteadyClockUs();
    if (began_us < 0) began_us = now_us;
    // For 1.5 s at 10 000 a second, from the client's own address and from strangers'.
    const std::int64_t due = std::min<std::int64_t>(now_us - began_us, 1500000) / 100;
    for (int burst = 0; burst < 40 && up + down < due; ++burst) {
      const Bytes bad = Bad(&random_, relay.sent_up);
      const bool hers = random_.Chance(0.5);
      const auto& stranger = strangers[random_.Next() % strangers.size()];
      up += (hers ? relay.ForgeUp(bad) : stranger.Send(server_port_, bad)) ? 1 : 0;
      if (burst % 2 != 0) continue;
      const Bytes answer = Bad(&random_, relay.sent_down);
      down += (hers ? relay.ForgeDown(answer) : stranger.Send(relay.client_port(), answer)) ? 1 : 0;
    }
  }
  ASSERT_TRUE(server_->Wait(0)) << "hangs";
  for (int i = 0; i < 5000 && !ann->Wait(0); ++i) relay.Pass(kUnchanged, kUnchanged);
  EXPECT_TRUE(bob->Wait(10));
  SCOPED_TRACE(server_->Story() + ann->Story());
  ExpectStayed("ann", 1);
  ExpectStayed("bob", 2);
  EXPECT_EQ(ann->status(), 0);
  EXPECT_EQ(bob->status(), 0);
  EXPECT_NE(ann->errors().find("the server closed the room"), std::string::npos);
  // Nearly all are counted; the kernel may have dropped some. And nothing else was.
  EXPECT_GT(up, 2000);
  // Well formed but in another conversation, under her address, is "without right".
  EXPECT_GT(Number(*server_, " without right"), 0);
  // With the comma: the table of clients has malformed ones of each.
  const long counted = Number(*server_, " malformed,") + Number(*server_, " without right");
  EXPECT_GT(counted, up / 2);
  EXPECT_LE(counted, up);
  EXPECT_GT(Number(*ann, " bad"), down / 2);
  // A datagram of no session draws at most one answer, which goes to the address that it is from.
  EXPECT_LE(Number(*ann, " bad"), down + Number(*server_, " without right"));
  EXPECT_EQ(Number(*bob, " bad"), 0);
}

/// A forger who has stood between client and server from the beginning, so that he has the keys:
/// changes a few bytes of the messages.
bool Forge(Random* random, std::vector<Bytes>* messages) {
  if (!random->Chance(0.3)) return true;
  for (Bytes& bytes : *messages) {
    for (std::uint64_t i = 0, n = random->Next() % 4; i < n; ++i) {
      // Beyond the type's hash, where a change is not noticed at once.
      const std::size_t at = std::min<std::size_t>(8, bytes.size() - 1);
      auto& byte = bytes[at + random->Next() % (bytes.size() - at)];
      byte = static_cast<std::uint8_t>(random->Chance(0.3) ? 0xff : random->Next());
    }
  }
  return true;
}

TEST_F(Bombarded, AForgedPlayerHarmsNeitherTheServerNorTheOthersNorItsOwnProgram) {
  Relay relay(server_port_);
  auto ann = Join("ann", server_port_);
  auto bob = Join("bob", relay.port());
  Middle middle;
  bool started = false;
  const Middle::Change forge = [&](DatagramHeader*, std::vector<Bytes>* messages) {
    // Once the room runs: before, a forged answer only keeps him out.
    return !started || Forge(&random_, messages);
  };
  const Relay::Change up = [&](const Bytes& data) { return *middle.Up(data, forge); };
  const Relay::Change down = [&](const Bytes& data) { return *middle.Down(data, forge); };
  const std::int64_t deadline_us = SteadyClockUs() + 60000000;
  while (!server_->Wait(0) && SteadyClockUs() < deadline_us) {
    started = started || relay.sent_up.size() == 64;
    relay.Pass(up, down);
  }
  ASSERT_TRUE(server_->Wait(0)) << "hangs";
  EXPECT_TRUE(ann->Wait(10));
  for (int i = 0; i < 5000 && !bob->Wait(0); ++i) {
    if (i == 1000) bob->Signal(SIGTERM);  // he may have missed the goodbye
    relay.Pass(up, down);
  }
  SCOPED_TRACE("seed " + std::to_string(kSeed) + server_->Story() + ann->Story() + bob->Story());
  ExpectStayed("ann", 1);
  EXPECT_EQ(ann->status(), 0);
  EXPECT_EQ(Number(*ann, " bad"), 0) << "the server passes on nothing that does not decode";
  EXPECT_TRUE(bob->status() == 0 || bob->status() == 2) << "no crash, no abort";
}

}  // namespace bombard_test
}  // namespace seam
