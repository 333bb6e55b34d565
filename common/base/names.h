#pragma once
/// Names of players and rooms. Because they appear in channel names, file names and on screens,
/// they are plain ASCII in every locale.

#include <cstddef>
#include <string>

namespace seam {

/// Longest name.
constexpr std::size_t kNameBytesMax = 32;

/// Returns true for 1..kNameBytesMax characters of [A-Za-z0-9_-].
bool IsName(const std::string& text);

/// Returns a server's name for room `index` of `count`: "main" if it is the only one, else
/// "main-1" and so on. Within kNameBytesMax for names of up to 26 characters and 99 999 rooms.
std::string RoomName(const std::string& name, int index, int count);

}  // namespace seam
