#pragma once
/// Base 64 of RFC 4648, with padding, as etcd's JSON has its keys and values.

#include <string>

namespace seam {

std::string ToBase64(const std::string& bytes);
/// Returns false for any other text than those of ToBase64.
bool FromBase64(const std::string& text, std::string* bytes);

}  // namespace seam
