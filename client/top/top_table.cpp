#include "client/top/top_table.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace seam {
namespace {

constexpr std::int64_t kNoLoadUs = 5000000;

double Ms(std::int32_t us) { return us * 1e-3; }

/// Returns the bytes of a kind of traffic; 0 if the kind is missing.
std::int64_t BytesOf(const Load& load, const std::vector<std::int64_t>& bytes, int kind) {
  for (std::size_t i = 0; i < load.kind.size(); ++i) {
    if (load.kind[i] == kind) return bytes[i];
  }
  return 0;
}

std::int64_t Dropped(const Load& load) {
  return load.dropped_malformed + load.dropped_stale + load.dropped_right +
         load.dropped_implausible + load.dropped_budget;
}

}  // namespace

void TopTable::Take(std::int64_t now_us, const RoomLoad& load) {
  Heard& heard = rooms_[load.room];
  heard.before = heard.now_us == 0 ? load.load : heard.now;
  heard.before_us = heard.now_us == 0 ? now_us : heard.now_us;
  heard.before_connections = heard.now_us == 0 ? load.connections : heard.connections;
  heard.connections = load.connections;
  heard.now = load.load;
  heard.now_us = now_us;
}

/// Formats "  120.0   0.5   2    31.5": round trip p99 ms, loss %, thin lines, least budget kB/s.
std::string TopTable::LinesText(const Heard& heard) {
  const Connections &now = heard.connections, &before = heard.before_connections;
  if (now.round_trip.count == 0) return "       -     -    -       -";
  const BucketHistogram loss = now.loss.Since(before.loss);
  const double lost =
      loss.count > 0 ? static_cast<double>(loss.sum_us) * 1e-4 / static_cast<double>(loss.count)
                     : 0.0;
  char text[64];
  std::snprintf(text, sizeof text, " %7.0f %5.1f %4lld %7.1f",
                now.round_trip.Since(before.round_trip).QuantileUs(0.99) * 1e-3, lost,
                static_cast<long long>(now.thin_lines), static_cast<double>(now.least_line) * 1e-3);
  return text;
}

std::string TopTable::Row(const std::string& room, const Heard& heard) {
  const Load& load = heard.now;
  const double seconds = std::max(1e-3, heard.seconds());
  const auto rate = [&](std::int64_t now, std::int64_t before) {
    return heard.seconds() > 0 ? static_cast<double>(now - before) / seconds : 0.0;
  };
  double out = 0, in = 0;
  for (int kind = 0; kind <= kTrafficOther; ++kind) {
    out += rate(BytesOf(load, load.bytes_out, kind),
                BytesOf(heard.before, heard.before.bytes_out, kind));
    in += rate(BytesOf(load, load.bytes_in, kind),
               BytesOf(heard.before, heard.before.bytes_in, kind));
  }
  char text[256];
  std::snprintf(
      text, sizeof text,
      "%-16.16s %5.0f %3d/%-3d %6.2f %6.2f %7.2f %7.2f %6.1f %5d/%-5d %5.0f %6d %6.0f %6.1f "
      "%8.1f %8.1f %7.1f%s\n",
      room.c_str(), load.speed_ppm * 1e-4, load.players, load.clients, Ms(load.tick_p50_us),
      Ms(load.tick_p99_us), Ms(load.tick_max_us), Ms(load.late_p99_us),
      100e-6 * rate(load.cpu_us, heard.before.cpu_us), load.moving, load.bodies,
      load.moving > 0 ? 100.0 * load.moving_held / load.moving : 0.0, load.islands,
      60 * rate(load.hand_overs, heard.before.hand_overs),
      60 * rate(load.jumps, heard.before.jumps), out * 1e-3, in * 1e-3,
      rate(Dropped(load), Dropped(heard.before)), LinesText(heard).c_str());
  return text;
}

std::string TopTable::Text(std::int64_t now_us) const {
  if (rooms_.empty()) return "no room was heard yet\n";
  std::string text =
      "room             speed  players tick ms                late     cpu   moving/    held "
      "island  hand-  jumps      out       in   drops     rtt  loss thin   least\n"
      "                     %  /peers    p50    p99     max  p99 ms      %    bodies       %     "
      "-s  overs    /min     kB/s     kB/s      /s  p99 ms     % lines    kB/s\n";
  double out[kTrafficOther + 1] = {};
  for (const auto& [room, heard] : rooms_) {
    if (now_us - heard.now_us > kNoLoadUs) continue;
    text += Row(room, heard);
    for (int kind = 0; heard.seconds() > 0 && kind <= kTrafficOther; ++kind) {
      const std::int64_t more = BytesOf(heard.now, heard.now.bytes_out, kind) -
                                BytesOf(heard.before, heard.before.bytes_out, kind);
      out[kind] += static_cast<double>(more) / heard.seconds() * 1e-3;
    }
  }
  text += "sent, kB/s:";
  for (int kind = 0; kind <= kTrafficOther; ++kind) {
    char piece[64];
    std::snprintf(piece, sizeof piece, " %s %.1f", TrafficName(kind), out[kind]);
    if (out[kind] > 0) text += piece;
  }
  return text + "\n";
}

}  // namespace seam
