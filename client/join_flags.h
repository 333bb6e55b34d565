#pragma once
/// Values of the flags with which a program joins a room. All throw OperatorError.

#include <string>

#include "common/net/connect_token.h"
#include "common/net/key_exchange.h"

namespace seam {

/// Requires the name of a player or a room: 1 to 32 letters, digits, - or _.
void CheckName(const std::string& flag, const std::string& name);
/// Reads the token in the file of --token.
ConnectToken ReadTokenFile(const std::string& path);
/// Parses the key of --server-key.
PublicKey ParseServerKey(const std::string& text);

}  // namespace seam
