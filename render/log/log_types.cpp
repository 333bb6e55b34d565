/// seam-log: types.

#include <fmt/format.h>

#include <cstdio>

#include "common/codec/fingerprints.h"
#include "render/log/log_commands.h"

namespace seam {

int RunLogTypes() {
  std::printf("%-18s %-16s  %s\n", "type", "fingerprint", "without session");
  for (const Fingerprint& type : Fingerprints()) {
    const std::string bare =
        type.without_session == 0 ? "-" : fmt::format("{:016x}", type.without_session);
    std::printf("%s", fmt::format("{:<18} {:016x}  {}\n", type.type, type.hash, bare).c_str());
  }
  return 0;
}

}  // namespace seam
