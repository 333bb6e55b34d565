#include "client/progress_text.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "client/terminal_view.h"

namespace seam {

std::string SecondsText(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", seconds);
  return text;
}

namespace {

/// Returns "100 ms"; "not known yet" for -1.
std::string RoundTrip(std::int32_t rtt_us) {
  if (rtt_us < 0) return "not known yet";
  char text[24];
  std::snprintf(text, sizeof text, "%.0f ms", rtt_us / 1000.0);
  return text;
}

/// Returns "ann: 3 s, the scene comes: 45 % of 581 kB".
std::string Coming(const Client& client, double elapsed_s) {
  char line[120];
  std::snprintf(line, sizeof line, "%s: %.0f s, the scene comes: %.0f %% of %.0f kB",
                client.name().c_str(), elapsed_s, 100 * client.room_share(),
                static_cast<double>(client.room_size()) / 1000);
  return line;
}

}  // namespace

std::string ProgressText(const Client& client, double elapsed_s) {
  const std::optional<float> speed = OwnSpeed(client);
  char fast[24] = "";
  if (speed) std::snprintf(fast, sizeof fast, "%.1f m/s, ", static_cast<double>(*speed));
  char line[200];
  std::snprintf(line, sizeof line,
                "%s: %.0f s, %speer %d, round trip %s, loss %.1f %%, %lld corrections, %lld "
                "rejoin(s)",
                client.name().c_str(), elapsed_s, fast, client.peer(),
                RoundTrip(client.stats().rtt_us).c_str(), client.stats().loss_ppm / 10000.0,
                static_cast<long long>(client.corrections()),
                static_cast<long long>(client.rejoins()));
  if (client.speed_ppm() == kFullSpeedPpm) return line;
  return line + (", the room runs at " + std::to_string(client.speed_ppm() / 10000) +
                 " % of its speed: its server is overloaded");
}

std::string WaitingText(const Client& client, const std::string& told, double elapsed_s) {
  if (client.room_size() > 0 && client.replica() == nullptr) return Coming(client, elapsed_s);
  const std::string what = client.replica() == nullptr ? "joining"
                           : told.empty()              ? "waiting for the room to start"
                                                       : told;
  return client.name() + ": " + SecondsText(std::floor(elapsed_s)) + " s, " + what;
}

}  // namespace seam
