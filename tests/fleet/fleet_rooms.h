#pragma once
/// Servers and clients of a fleet in virtual time, over one network in memory.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/client.h"
#include "common/net/impair.h"
#include "common/net/memory.h"
#include "common/sync/method.h"
#include "server/room_state.h"
#include "server/server.h"

namespace seam {

class FleetRooms {
 public:
  struct Silence : Recorder {
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };
  struct Host {
    Address address;
    std::unique_ptr<Net> net;
    std::unique_ptr<ImpairedNet> path;
    std::unique_ptr<SeededEntropy> entropy;
    std::unique_ptr<Server> server;
    bool runs = true;
  };
  /// A path that can be cut to one server, both ways.
  struct Gate : Net {
    explicit Gate(Net& behind) : net(behind) {}
    void Advance(std::int64_t now_us) override { net.Advance(now_us); }
    void Send(const Address& to, ByteView datagram) override {
      if (!cut || *cut != to) net.Send(to, datagram);
    }
    void Flush() override { net.Flush(); }
    bool Receive(Address* from, Bytes* datagram) override {
      while (net.Receive(from, datagram)) {
        if (!cut || *cut != *from) return true;
      }
      return false;
    }
    Net& net;
    std::optional<Address> cut;
  };
  struct Guest {
    std::unique_ptr<Net> net;
    std::unique_ptr<Gate> gate;
    std::unique_ptr<SeededEntropy> entropy;
    std::unique_ptr<Client> client;
  };

  explicit FleetRooms(const std::string& impair, const std::string& scene = "crossing")
      : profile_(FindProfile(impair)), scene_(LoadScene("scenes/" + scene + ".toml")) {
    SeededEntropy entropy(77);
    identity = std::make_shared<const KeyPair>(entropy);
  }

  /// Begins a room at a new host.
  Host& Begin(std::int32_t epoch, std::shared_ptr<const KeyPair> keys) {
    Host& host = NewHost();
    host.server = std::make_unique<Server>(scene_, ConfigOf(epoch, std::move(keys)), *host.path,
                                           silence_, *host.entropy);
    return host;
  }
  /// Goes on with saved bytes at a new host.
  Host& GoOn(const Bytes& bytes) {
    Status status;
    const std::unique_ptr<const SavedRoom> saved = SavedRoom::Read(bytes, &status);
    EXPECT_TRUE(saved != nullptr) << status.why();
    Host& host = NewHost();
    host.server = std::make_unique<Server>(*saved, ConfigOf(saved->epoch(), identity), *host.path,
                                           silence_, *host.entropy);
    status = host.server->Resume(*saved, now_us);
    EXPECT_TRUE(status.ok()) << status.why();
    return host;
  }
  Guest& Join(const std::string& name, const Address& server) {
    guests.push_back(std::make_unique<Guest>());
    Guest& guest = *guests.back();
    const auto number = static_cast<std::uint16_t>(guests.size());
    guest.net = network.Attach({100, number});
    guest.gate = std::make_unique<Gate>(*guest.net);
    guest.entropy = std::make_unique<SeededEntropy>(500 + number);
    ClientConfig config;
    config.server = server;
    config.name = name;
    config.drive = Drive::kBot;
    guest.client = std::make_unique<Client>(config, *guest.gate, silence_, *guest.entropy);
    return guest;
  }
  /// Lets `us` pass, or less when `until` holds; returns whether it does.
  bool Run(std::int64_t us, const std::function<bool()>& until = {}) {
    for (const std::int64_t end_us = now_us + us; now_us < end_us; now_us += 4000) {
      for (const auto& host : hosts) {
        if (host->runs) host->server->Tick(now_us, 0);
      }
      for (const auto& guest : guests) guest->client->Tick(now_us, 0);
      if (until && until()) return true;
    }
    return false;
  }
  /// True if every client plays at this host.
  bool AllPlayAt(const Host& host) const {
    for (const auto& guest : guests) {
      const Client& client = *guest->client;
      if (!client.running() || client.moving() || client.server() != host.address) return false;
    }
    return host.server->player_count() == static_cast<int>(guests.size());
  }
  static Redirect RedirectTo(const Host& host, std::int32_t epoch) {
    Redirect redirect;
    redirect.address = ToString(host.address);
    redirect.room = "main";
    redirect.epoch = epoch;
    return redirect;
  }

  MemoryNetwork network;
  std::shared_ptr<const KeyPair> identity;
  std::vector<std::unique_ptr<Host>> hosts;
  std::vector<std::unique_ptr<Guest>> guests;
  std::int64_t now_us = 1000000;

  /// Makes the next host without a room; its address can be named.
  Host& NewHost() {
    hosts.push_back(std::make_unique<Host>());
    Host& host = *hosts.back();
    const auto number = static_cast<std::uint32_t>(hosts.size());
    host.address = {number, 7777};
    host.net = network.Attach(host.address);
    host.path = std::make_unique<ImpairedNet>(*host.net, profile_, profile_, 40 + number);
    host.entropy = std::make_unique<SeededEntropy>(900 + number);
    return host;
  }

 private:
  ServerConfig ConfigOf(std::int32_t epoch, std::shared_ptr<const KeyPair> keys) const {
    ServerConfig config;
    config.sync = MakeSyncConfig(MethodNames{"buffer", "", ""});
    config.sync.tick_hz = scene_.solver.tick_hz;
    config.sync.input_delay_ticks = scene_.input_delay_ticks;
    config.publish = Publish::kNone;
    config.epoch = epoch;
    config.identity = std::move(keys);
    return config;
  }

  const ImpairProfile profile_;
  const Scene scene_;
  Silence silence_;
};

}  // namespace seam
