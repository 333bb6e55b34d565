#include "render/measure/logs_and_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "common/base/check.h"
#include "common/base/plain_file.h"

namespace seam {

std::string BaseName(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const std::size_t dot = name.rfind(".lcm");
  if (dot != std::string::npos && dot > 0 && dot + 4 == name.size()) name.resize(dot);
  return name;
}

std::string ChangesOf(const Recording& recording) {
  std::string first;
  int more = -1;
  for (const Event& event : recording.events) {
    if (event.kind != static_cast<std::int8_t>(EventKind::kControl)) continue;
    if (++more > 0) continue;
    const double time_s = static_cast<double>(event.tick) / std::max(1, recording.room.tick_hz);
    first = fmt::format("{} at {:.1f} s", event.text, time_s);
  }
  return first + (more > 0 ? fmt::format(", and {} more", more) : "");
}

std::string FirstLine(const std::string& path) {
  std::FILE* file = OpenPlainFile(path, FileUse::kRead);
  if (file == nullptr) return "";
  std::string line;
  for (int c = 0; line.size() < 1000 && (c = std::fgetc(file)) != EOF && c != '\n';) {
    line += static_cast<char>(c);
  }
  std::fclose(file);
  return line;
}

void WriteText(const std::string& path, const std::string& text) {
  std::FILE* file = OpenPlainFile(path, FileUse::kReplace);
  if (file == nullptr) throw OperatorError(path + ": cannot be written");
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) throw OperatorError(path + ": disk full?");
}

}  // namespace seam
