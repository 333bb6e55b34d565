#include "common/record/damage.h"

#include <cstdio>
#include <set>
#include <utility>

#include "common/record/time_range.h"

namespace seam {
namespace {

/// Most channels named in a line, and most lines about parts of a recording.
constexpr std::size_t kChannelsNamed = 8, kPartsNamed = 100;

bool g_damage_found = false;

std::string PartText(const DamagedRange& part) {
  std::string text = "tick " + std::to_string(part.first_tick);
  const std::string last = std::to_string(part.last_tick);
  if (part.to_the_end) {
    text = "from " + text + " to the log's end nothing is certain";
  } else if (part.last_tick > part.first_tick) {
    text = "ticks " + std::to_string(part.first_tick) + " to " + last + " are ";
  } else {
    text += " is ";
  }
  if (!part.to_the_end) text += part.missing ? "missing" : "damaged";
  if (part.forged) text += kForgedWords;
  std::size_t named = 0;
  for (const std::string& channel : part.channels) {
    if (named == kChannelsNamed) break;
    text += (named++ == 0 ? " (" : ", ") + channel;
  }
  if (part.channels.size() > named) {
    text += " and " + std::to_string(part.channels.size() - named) + " more channels";
  }
  return named > 0 ? text + ")" : text;
}

}  // namespace

bool IsDamaged(const Recording& recording) {
  return recording.skipped_bytes > 0 || recording.undecodable > 0 || !recording.damage.empty();
}

std::vector<std::string> DamageLines(const Recording& recording) {
  std::vector<std::string> lines;
  for (const DamagedRange& part : recording.damage) {
    if (lines.size() == kPartsNamed) {
      lines.push_back("and " + std::to_string(recording.damage.size() - kPartsNamed) +
                      " more damaged parts");
      break;
    }
    lines.push_back(PartText(part));
  }
  const std::string counts = DamageOf(recording);
  if (!counts.empty()) lines.push_back(counts);
  return lines;
}

std::string DamageNote(const Recording& recording) {
  const std::vector<std::string> lines = DamageLines(recording);
  if (lines.empty()) return "";
  const std::string first = lines[0].substr(0, lines[0].find(" ("));
  return lines.size() == 1 ? first : first + " and " + std::to_string(lines.size() - 1) + " more";
}

void ReportDamage(const char* program, const std::string& path, const Recording& recording) {
  static std::set<std::pair<std::string, std::int64_t>> reported;
  g_damage_found = g_damage_found || IsDamaged(recording);
  if (!reported.insert({path, recording.room.session}).second) return;
  for (const std::string& line : DamageLines(recording)) {
    std::fprintf(stderr, "%s: warning: %s: %s\n", program, path.c_str(), line.c_str());
  }
}

int StatusAfterReading(int status) { return status == 0 && g_damage_found ? 1 : status; }

}  // namespace seam
