#include "server/fleet/fleet_host.h"

#include <cctype>
#include <cstdio>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/names.h"
#include "common/base/process.h"
#include "common/base/version.h"
#include "common/net/udp.h"

namespace seam {
namespace {

constexpr const char* kAnyOfFleet = "fleet";

/// Returns the address as a name: "192-0-2-1-7777".
std::string NameOf(const std::string& address) {
  std::string name;
  for (const char c : address) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return name.size() > kNameBytesMax ? name.substr(name.size() - kNameBytesMax) : name;
}

}  // namespace

void CheckFleetFlags(const ServerFlags& f) {
  const bool kept = !f.state.empty() || !f.resume.empty();
  if (!f.drain_to.empty() && !kept) {
    throw OperatorError("--drain-to: the other server goes on with what --state or --resume keeps");
  }
  if (f.drain_to == kAnyOfFleet && f.directory.empty()) {
    throw OperatorError("--drain-to fleet needs --directory");
  }
  if (!f.drain_to.empty() && f.drain_to != kAnyOfFleet &&
      ParseAddress(f.drain_to, 7777).port == 0) {
    throw OperatorError("--drain-to " + f.drain_to + ": no server has port 0");
  }
  if (f.standby && (f.directory.empty() || f.resume.empty())) {
    throw OperatorError("--standby follows the rooms of a fleet: --directory and --resume FOLDER");
  }
  if (f.gateway && f.directory.empty()) throw OperatorError("--gateway needs --directory");
  if (f.gateway && (kept || !f.scenes.empty())) {
    throw OperatorError("--gateway has no rooms: not with a scene, --state or --resume");
  }
  if (!f.directory.empty() && !IsName(f.fleet)) {
    throw OperatorError("--fleet takes 1 to 32 letters, digits, - or _");
  }
  if (f.directory.empty() && (!f.server_id.empty() || !f.advertise.empty())) {
    throw OperatorError("--id and --advertise are for a fleet: --directory");
  }
  if (!f.server_id.empty() && !IsName(f.server_id)) {
    throw OperatorError("--id takes 1 to 32 letters, digits, - or _");
  }
}

void PrepareFolders(const ServerFlags& f) {
  std::error_code error;
  if (!f.directory.empty() && !f.resume.empty()) {
    std::filesystem::create_directories(f.resume, error);
  }
  if (error) throw OperatorError(f.resume + ": cannot be made: " + error.message());
}

FleetMember::Config MemberOf(const ServerFlags& f, const Address& local) {
  Address reached = local;
  if (!f.advertise.empty()) reached = ParseAddress(f.advertise, local.port);
  if (reached.port == 0)
    throw OperatorError("--advertise " + f.advertise + ": no server has port 0");
  Address any = kAnyAddress;
  any.port = reached.port;
  if (reached == any || reached == Address{0, reached.port}) {
    throw OperatorError(
        "--directory: clients need an address of this server: --advertise ADDRESS, or --bind");
  }
  FleetMember::Config config;
  config.directory = f.directory;
  config.fleet = f.fleet;
  config.me.address = ToString(reached);
  config.me.id = f.server_id.empty() ? NameOf(config.me.address) : f.server_id;
  config.me.version = kVersion;
  config.me.protocol = kProtocolVersion;
  config.me.capacity = f.gateway ? 0 : f.capacity;
  config.folder = f.state.empty() ? f.resume : f.state;
  config.takes = !f.resume.empty();
  config.warm = f.standby;
  return config;
}

void FollowFleet(FleetMember& member, Hub& hub) {
  for (const std::string& news : member.TakeReports()) PrintError("seam-server", news);
  for (const Redirect& lost : member.TakeLost()) {
    for (const auto& room : hub.rooms()) {
      if (room->config().room == lost.room) room->Supersede(lost);
    }
  }
  for (const RoomPlan& plan : member.TakeReady()) {
    try {
      hub.Add(plan);
      PrintError("seam-server", "room " + plan.config.room + ": taken over in epoch " +
                                    std::to_string(plan.config.epoch));
    } catch (const OperatorError& error) {
      member.GiveBack(plan.config.room, plan.config.epoch, error.what());
    }
  }
  for (const auto& [name, address] : member.TakeStandbys()) {
    for (const auto& room : hub.rooms()) {
      if (room->config().room == name && !room->over()) room->NameStandby(address);
    }
  }
}

void DrainRooms(const ServerFlags& f, FleetMember* member, Hub& hub) {
  std::string to;
  if (f.drain_to != kAnyOfFleet) to = ToString(ParseAddress(f.drain_to, 7777));
  if (member != nullptr) member->Drain(to);
  const auto may_be_taken = [&] {
    if (member == nullptr) return false;
    FollowFleet(*member, hub);
    if (!member->drains()) member->Stop();  // what is left is moved
    return member->drains();
  };
  const auto where = [&](const std::string& room, std::int32_t epoch) {
    if (member != nullptr) {
      const Redirect moved = member->Move(room, to, epoch);
      if (moved.address.empty())
        PrintError("seam-server", "room " + room + ": no server to go on with it; it is kept");
      return moved;
    }
    Redirect redirect;
    redirect.address = to;
    redirect.room = room;
    redirect.epoch = epoch;
    return redirect;
  };
  hub.Drain(may_be_taken, where);
  if (member != nullptr) member->Stop();
}

}  // namespace seam
