#include "client/join_flags.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "common/base/check.h"
#include "common/base/hex.h"
#include "common/base/names.h"
#include "common/net/seal.h"

namespace seam {

void CheckName(const std::string& flag, const std::string& name) {
  if (!IsName(name)) throw OperatorError(flag + " takes 1 to 32 letters, digits, - or _");
}

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

}  // namespace seam
