/// seam-token: prints a connect token of an operator. `seam-token --help`.

#include <cstdio>

#include "common/base/command_line.h"
#include "common/base/names.h"
#include "common/base/process.h"
#include "common/codec/version_line.h"
#include "common/net/connect_token.h"
#include "common/net/secret_file.h"

namespace {

using namespace seam;

struct Flags {
  std::string key;
  bool make_key = false;
  std::string room = "main";
  std::string name;
  bool watch = false;
  std::int64_t life_s = kTokenLifeS;
};

void Define(Command& app, Flags& f) {
  app.Option("--key", f.key, "file of the operator's key, as seam-server --token-key has it");
  app.Switch("--make-key", f.make_key,
             "draw a key, write it to the --key file (mode 0600), and end");
  app.Option("--room", f.room, "room that the token opens");
  app.Option("--name", f.name, "name under which its holder may join");
  app.Switch("--watch", f.watch, "the holder may only look on");
  app.Option("--life", f.life_s, "seconds until it expires").Range(1, 86400);
}

int Print(const Flags& f) {
  if (f.key.empty()) throw OperatorError("which key? --key FILE (--make-key makes one)");
  OsEntropy entropy;
  if (f.make_key) {
    MakeSecretFile("--key", f.key, Secret(entropy));
    return 0;
  }
  if (!IsName(f.room)) throw OperatorError("--room takes 1 to 32 letters, digits, - or _");
  if (!IsName(f.name)) throw OperatorError("--name takes 1 to 32 letters, digits, - or _");
  TokenGrant grant;
  grant.protocol = static_cast<std::uint32_t>(kProtocolVersion);
  grant.room = f.room;
  grant.name = f.name;
  grant.may_play = !f.watch;
  grant.created_s = WallClockUs() / 1000000;
  grant.expires_s = grant.created_s + f.life_s;
  std::printf("%s\n", MakeToken(grant, ReadSecretFile("--key", f.key), entropy).c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{"seam-token",
                         "seam-token: let somebody join a room once, and soon",
                         VersionLine("seam-token"),
                         "",
                         {}};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); }, [&] { return Print(flags); });
}
