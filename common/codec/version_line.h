#pragma once
/// The output of `--version`: the program, its version and its protocol.

#include <string>

#include "common/base/version.h"
#include "common/codec/messages.h"

namespace seam {

/// Returns "seam-server 0.4.0 (protocol 4)".
inline std::string VersionLine(const std::string& program) {
  return program + " " + kVersion + " (protocol " + std::to_string(kProtocolVersion) + ")";
}

}  // namespace seam
