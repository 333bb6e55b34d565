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

/// What a server calls room `index` of `count`: "main" if it is the only one, else "main-1" and so
/// on. Not longer than kNameBytesMax for names of up to 26 characters and 99 999 rooms.
std::string RoomName(const std::string& name, int index, int count);

}  // namespace seam
