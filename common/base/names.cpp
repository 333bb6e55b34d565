#include "common/base/names.h"

#include <algorithm>

namespace seam {

bool IsName(const std::string& text) {
  return !text.empty() && text.size() <= kNameBytesMax &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_' || c == '-';
         });
}

std::string RoomName(const std::string& name, int index, int count) {
  return count == 1 ? name : name + "-" + std::to_string(index + 1);
}

}  // namespace seam
