#include "client/join_flags.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "common/base/check.h"
#include "common/base/hex.h"
#include "common/base/names.h"
#include "common/net/connect_token.h"
#include "common/net/key_exchange.h"
#include "common/net/seal.h"
#include "common/net/udp.h"

namespace seam {
namespace {

ConnectToken ReadTokenFile(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "re");
  if (file == nullptr) throw OperatorError("--token " + path + ": " + std::strerror(errno));
  std::string text(4096, 0);
  text.resize(std::fread(&text[0], 1, text.size(), file));
  std::fclose(file);
  ConnectToken token;
  const Status status = ReadToken(text, &token);
  Wipe(&text[0], text.size());
  if (!status.ok()) throw OperatorError("--token " + path + ": " + status.why());
  return token;
}

PublicKey ParseServerKey(const std::string& text) {
  PublicKey key{};
  if (!FromHex(text, key.data(), key.size())) {
    throw OperatorError("--server-key takes the 64 digits that seam-server prints at its start");
  }
  return key;
}

}  // namespace

void CheckName(const std::string& flag, const std::string& name) {
  if (!IsName(name)) throw OperatorError(flag + " takes 1 to 32 letters, digits, - or _");
}

void DefineJoin(Command& app, JoinFlags& flags) {
  app.Option("--token", flags.token, "show the token in this file, which names player and room");
  app.Option("--server-key", flags.server_key,
             "join only the server that printed this key at its start (default: whoever answers)");
  app.Option("--room", flags.room, "the room to join (default: the server's first)");
  app.Option("--directory", flags.directory,
             "find the room's server in this directory of a fleet, file:FOLDER or "
             "etcd:HOST:PORT,...; also when it moves (then no server need be given)");
  app.Option("--fleet", flags.fleet, "name of the fleet in the directory");
}

ClientConfig JoinConfig(const JoinFlags& flags) {
  if (!flags.token.empty() && !(flags.name.empty() && flags.room.empty())) {
    throw OperatorError("--token names player and room: not with --name or --room");
  }
  if (!flags.name.empty()) CheckName("--name", flags.name);
  if (!flags.room.empty()) CheckName("--room", flags.room);
  if (!flags.directory.empty()) CheckName("--fleet", flags.fleet);
  ClientConfig config;
  config.server = ParseAddress(flags.server.empty() ? "127.0.0.1:7777" : flags.server, 7777);
  if (config.server.port == 0) {
    throw OperatorError("address \"" + flags.server + "\": no server has port 0");
  }
  if (!flags.server_key.empty()) config.server_key = ParseServerKey(flags.server_key);
  config.name = flags.name.empty() ? "guest" : flags.name;
  config.numbers_name = flags.name.empty();
  config.room = flags.room;
  if (flags.token.empty()) return config;
  config.token = ReadTokenFile(flags.token);
  config.name = config.token->name;
  config.room = config.token->room;
  config.numbers_name = false;
  return config;
}

}  // namespace seam
