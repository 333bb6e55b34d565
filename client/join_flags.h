#pragma once
/// The flags with which a program joins a room, and their values. All throw OperatorError.

#include <string>

#include "client/client.h"
#include "common/base/command_line.h"

namespace seam {

struct JoinFlags {
  std::string server;  ///< "": this machine's
  std::string name;    ///< "": guest, guest-2, ...
  std::string room;    ///< "": the server's first
  std::string directory, fleet = "main";
  std::string token, server_key;
};

/// Requires the name of a player or a room: 1 to 32 letters, digits, - or _.
void CheckName(const std::string& flag, const std::string& name);
/// Defines all of them but the server and --name, of which each program tells its own.
void DefineJoin(Command& app, JoinFlags& flags);
/// Returns a client that joins so; reads the file of --token.
ClientConfig JoinConfig(const JoinFlags& flags);

}  // namespace seam
