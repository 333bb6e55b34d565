#pragma once
/// A key in a private file: 64 hexadecimal digits and a line end.

#include <string>

#include "common/net/seal.h"

namespace seam {

/// Reads the file that the operator gave with `flag`. Throws OperatorError if it is not a plain
/// file of ours without access for others, or does not hold a key. Does not follow symbolic links.
Secret ReadSecretFile(const std::string& flag, const std::string& path);

/// Reads the file, or creates it with a key from `entropy` if there is none. Throws OperatorError
/// as both do.
Secret KeepSecretFile(const std::string& flag, const std::string& path, Entropy& entropy);

/// Creates the file (mode 0600). Throws OperatorError if it exists or cannot be written.
void MakeSecretFile(const std::string& flag, const std::string& path, const Secret& secret);

}  // namespace seam
