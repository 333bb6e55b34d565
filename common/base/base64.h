#pragma once
/// Base 64 of RFC 4648, with padding.

#include <string>
#include <string_view>

namespace seam {

std::string ToBase64(std::string_view bytes);
/// Returns false for any other text than those of ToBase64.
bool FromBase64(const std::string& text, std::string* bytes);

}  // namespace seam
