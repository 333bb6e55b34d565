/// The values of a fleet's directory as JSON; what is read is checked as the wire is.

#include "common/fleet/directory_values.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "common/base/names.h"
#include "common/net/net.h"

namespace seam {
namespace {

using Json = nlohmann::json;

constexpr std::int32_t kWholeMost = std::numeric_limits<std::int32_t>::max();
/// Longest version of a server's program, bytes.
constexpr std::size_t kVersionBytesMax = 32;

bool ReadWord(const Json& object, const char* name, std::size_t bytes_max, std::string* word) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_string()) return false;
  *word = found->get<std::string>();
  const bool plain = std::all_of(word->begin(), word->end(),
                                 [](char c) { return c > 0x20 && static_cast<int>(c) < 0x7f; });
  return !word->empty() && word->size() <= bytes_max && plain;
}

bool ReadNumber(const Json& object, const char* name, std::int32_t* number) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number_integer()) return false;
  if (found->is_number_unsigned() && found->get<std::uint64_t>() > std::uint64_t{kWholeMost}) {
    return false;
  }
  const auto value = found->get<std::int64_t>();
  *number = static_cast<std::int32_t>(value);
  return value >= 0 && value <= kWholeMost;
}

bool ReadReachable(const Json& object, std::string* address) {
  Address read;
  return ReadWord(object, "address", 64, address) && ReadAddress(*address, &read);
}

}  // namespace

std::string ServerText(const FleetServer& server) {
  return Json{{"address", server.address},   {"version", server.version},
              {"protocol", server.protocol}, {"capacity", server.capacity},
              {"used", server.used},         {"draining", server.draining}}
      .dump();
}

bool ReadServerText(const std::string& text, FleetServer* server) {
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object()) return false;
  const auto draining = all.find("draining");
  if (draining == all.end() || !draining->is_boolean()) return false;
  server->draining = draining->get<bool>();
  return ReadReachable(all, &server->address) &&
         ReadWord(all, "version", kVersionBytesMax, &server->version) &&
         ReadNumber(all, "protocol", &server->protocol) &&
         ReadNumber(all, "capacity", &server->capacity) && ReadNumber(all, "used", &server->used);
}

std::string HolderTextOf(const FleetHolder& holder) {
  return Json{{"server", holder.server}, {"address", holder.address}, {"epoch", holder.epoch}}
      .dump();
}

bool ReadHolderText(const std::string& text, FleetHolder* holder) {
  const Json all = Json::parse(text, nullptr, false);
  return all.is_object() && ReadWord(all, "server", 32, &holder->server) &&
         IsName(holder->server) && ReadReachable(all, &holder->address) &&
         ReadNumber(all, "epoch", &holder->epoch) && holder->epoch >= 1;
}

std::string StandbyTextOf(const FleetStandby& standby) {
  return Json{{"server", standby.server}, {"address", standby.address}}.dump();
}

bool ReadStandbyText(const std::string& text, FleetStandby* standby) {
  const Json all = Json::parse(text, nullptr, false);
  return all.is_object() && ReadWord(all, "server", 32, &standby->server) &&
         IsName(standby->server) && ReadReachable(all, &standby->address);
}

bool ReadEpochText(const std::string& text, std::int32_t* epoch) {
  if (text.empty() || text.size() > 10 ||
      text.find_first_not_of("0123456789") != std::string::npos) {
    return false;
  }
  const long long value = std::stoll(text);
  *epoch = static_cast<std::int32_t>(std::min<long long>(value, kWholeMost));
  return value >= 1 && value <= kWholeMost;
}

bool IsFleetObject(const std::string& text) {
  return text.size() <= kFleetValueBytesMax && Json::parse(text, nullptr, false).is_object();
}

FleetListing ReadListing(const std::string& prefix, const std::vector<KeyValue>& keys) {
  FleetListing listing;
  std::map<std::string, FleetRoom> rooms;
  const auto refuse = [&](const KeyValue& key, const char* why) {
    if (listing.refused.empty()) listing.refused = key.key.substr(0, 128) + ": " + why;
  };
  const std::string servers_at = prefix + "servers/", rooms_at = prefix + "rooms/";
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const KeyValue& key = keys[i];
    if (i == kFleetEntriesMax) refuse(key, "the directory has too many entries");
    if (i >= kFleetEntriesMax) break;
    if (key.value.size() > kFleetValueBytesMax) {
      refuse(key, "the value is too long");
      continue;
    }
    if (key.key.rfind(servers_at, 0) == 0) {
      FleetServer server;
      server.id = key.key.substr(servers_at.size());
      server.lease = key.lease;
      const bool good = IsName(server.id) && ReadServerText(key.value, &server);
      if (good) listing.servers.push_back(server);
      if (!good) refuse(key, "no server's entry");
      continue;
    }
    const std::size_t slash = key.key.rfind('/');
    const bool of_room = key.key.rfind(rooms_at, 0) == 0 && slash >= rooms_at.size();
    const std::string name =
        of_room ? key.key.substr(rooms_at.size(), slash - rooms_at.size()) : "";
    if (!IsName(name)) {
      refuse(key, "no key of a fleet");
      continue;
    }
    const std::string what = key.key.substr(slash + 1);
    FleetRoom room = rooms[name];
    room.name = name;
    bool good = false;
    if (what == "epoch") {
      good = ReadEpochText(key.value, &room.epoch);
      room.epoch_changed = key.changed;
    } else if (what == "holder") {
      room.holder.emplace();
      room.holder_changed = key.changed;
      good = ReadHolderText(key.value, &*room.holder);
    } else if (what == "standby") {
      room.standby.emplace();
      good = ReadStandbyText(key.value, &*room.standby);
    } else if (what == "spec" || what == "state") {
      (what == "spec" ? room.spec : room.state) = key.value;
      good = IsFleetObject(key.value);
    }
    if (good) rooms[name] = room;
    if (!good) refuse(key, "no such value of a room");
  }
  for (const auto& [name, room] : rooms) {
    if (!room.name.empty()) listing.rooms.push_back(room);
  }
  return listing;
}

}  // namespace seam
