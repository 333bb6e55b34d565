#pragma once
/// Names of players and rooms: they stand in channel names, file names and on screens, so they are
/// plain ASCII, whatever the locale.

#include <cstddef>
#include <string>

namespace seam {

/// Longest name.
constexpr std::size_t kNameBytesMax = 32;

/// 1..kNameBytesMax characters of [A-Za-z0-9_-].
bool IsName(const std::string& text);

}  // namespace seam
