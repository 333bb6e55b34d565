#include "client/python/udp_client.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/hex.h"
#include "common/base/names.h"
#include "common/base/process.h"
#include "common/net/farewell.h"

namespace seam {
namespace {

constexpr std::uint16_t kDefaultPort = 7777;
constexpr std::int64_t kTurnUsMax = 20000;

ClientConfig Configure(const UdpClientConfig& from) {
  for (const std::string& name : {from.name, from.room}) {
    if (!name.empty() && !IsName(name)) {
      throw OperatorError("\"" + name + "\": a name has 1 to 32 letters, digits, - or _");
    }
  }
  ClientConfig config;
  config.server = ParseAddress(from.server, kDefaultPort);
  if (config.server.port == 0) throw OperatorError(from.server + ": no server has port 0");
  if (!from.server_key.empty()) {
    config.server_key.emplace();
    if (!FromHex(from.server_key, config.server_key->data(), config.server_key->size())) {
      throw OperatorError("server_key takes the 64 digits that seam-server prints at its start");
    }
  }
  config.watch = from.name.empty();
  config.numbers_name = config.watch;
  if (!from.name.empty()) config.name = from.name;
  config.room = from.room;
  config.drive = config.watch ? Drive::kNone : Drive::kLive;
  config.shows = true;
  return config;
}

}  // namespace

UdpClient::UdpClient(const UdpClientConfig& config)
    : udp_(kAnyAddress),
      net_(udp_, FindProfile(config.impair), FindProfile(config.impair),
           static_cast<std::uint64_t>(config.seed)),
      sink_(config.lcm_url, config.record, config.force,
            config.room.empty() ? "main" : config.room),
      client_(Configure(config), net_, sink_, entropy_) {}

UdpClient::~UdpClient() { Leave(); }

void UdpClient::Turn() {
  if (ended()) return;
  client_.Tick(SteadyClockUs(), CpuUs());
  sink_.Poll();
  if (!client_.fatal().empty()) throw OperatorError(client_.fatal());
  if (!sink_.trouble().ok()) throw OperatorError(sink_.trouble().why());
  const std::int64_t now = SteadyClockUs();
  const std::int64_t wake =
      std::min({client_.next_tick_us(now), net_.next_due_us(), now + kTurnUsMax});
  udp_.Wait(std::max<std::int64_t>(0, wake - now));
}

void UdpClient::Leave() {
  if (left_) return;
  left_ = true;
  if (client_.fatal().empty() || client_.peer() >= 0) client_.Shutdown(SteadyClockUs());
  DrainNetwork(udp_, net_);
  sink_.Flush();
}

std::int64_t UdpClient::tick() const { return client_.running() ? client_.replica()->tick() : -1; }

View UdpClient::ViewNow() const {
  if (client_.replica() == nullptr) throw OperatorError("the room has not come yet: join() waits");
  return client_.replica()->MakeView();
}

}  // namespace seam
