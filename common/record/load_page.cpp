#include "common/record/load_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "common/record/load_histograms.h"

namespace seam {
namespace {

constexpr const char* kTraffic[] = {"framing", "states",  "inputs", "rest",  "grants", "hand_over",
                                    "edits",   "joining", "clock",  "rules", "other"};
static_assert(sizeof kTraffic / sizeof kTraffic[0] == kTrafficOther + 1, "a name for each kind");

/// A field of a Load and its metric in the page. Exactly one of the two members is set.
struct Metric {
  const char* name;
  const char* type;
  const char* help;
  std::int32_t Load::*small;
  std::int64_t Load::*large;
  double unit;  // factor from the Load's number to the page's
};

constexpr double kMicro = 1e-6;
const Metric kMetrics[] = {
    {"seam_tick", "gauge", "The room's tick.", nullptr, &Load::tick, 1},
    {"seam_room_speed_ratio", "gauge", "Speed of the room's clock, 1 in real time.",
     &Load::speed_ppm, nullptr, kMicro},
    {"seam_ticks_last_second", "gauge", "Ticks in the last second.", &Load::ticks, nullptr, 1},
    {"seam_tick_p50_seconds", "gauge", "Median wall time of a tick in the last second.",
     &Load::tick_p50_us, nullptr, kMicro},
    {"seam_tick_p99_seconds", "gauge", "99th percentile of the wall time of a tick.",
     &Load::tick_p99_us, nullptr, kMicro},
    {"seam_tick_max_seconds", "gauge", "Longest wall time of a tick.", &Load::tick_max_us, nullptr,
     kMicro},
    {"seam_late_p50_seconds", "gauge", "Median lateness of a tick in the last second.",
     &Load::late_p50_us, nullptr, kMicro},
    {"seam_late_p99_seconds", "gauge", "99th percentile of the lateness of a tick.",
     &Load::late_p99_us, nullptr, kMicro},
    {"seam_late_max_seconds", "gauge", "Worst lateness of a tick.", &Load::late_max_us, nullptr,
     kMicro},
    {"seam_room_cpu_seconds_total", "counter",
     "CPU time spent on the room, or by its program if it is alone.", nullptr, &Load::cpu_us,
     kMicro},
    {"seam_clients", "gauge", "Sessions.", &Load::clients, nullptr, 1},
    {"seam_players", "gauge", "Players who are ready.", &Load::players, nullptr, 1},
    {"seam_bodies", "gauge", "Bodies of the world.", &Load::bodies, nullptr, 1},
    {"seam_bodies_moving", "gauge", "Bodies that move.", &Load::moving, nullptr, 1},
    {"seam_bodies_moving_held", "gauge", "Moving bodies that a client has authority over.",
     &Load::moving_held, nullptr, 1},
    {"seam_islands", "gauge", "Groups of awake bodies that touch or are joined.", &Load::islands,
     nullptr, 1},
    {"seam_hand_overs_total", "counter", "Changes of a mechanism's authority.", nullptr,
     &Load::hand_overs, 1},
    {"seam_jumps_total", "counter", "Hand-overs with a visible difference.", nullptr, &Load::jumps,
     1},
};

struct Reason {
  const char* name;
  std::int64_t Load::*count;
};
const Reason kReasons[] = {{"malformed", &Load::dropped_malformed},
                           {"stale", &Load::dropped_stale},
                           {"right", &Load::dropped_right},
                           {"implausible", &Load::dropped_implausible},
                           {"budget", &Load::dropped_budget}};

/// A number of the connections and its metric in the page.
struct OfConnections {
  const char* name;
  const char* type;
  const char* help;
  std::int64_t Connections::*number;
};
const OfConnections kConnections[] = {
    {"seam_repaired_compositions_total", "counter",
     "Clients with other bodies than the server: sent anew.", &Connections::compositions},
    {"seam_repaired_rests_total", "counter", "Clients that lacked bodies at rest: sent again.",
     &Connections::rests},
    {"seam_line_least_bytes_per_second", "gauge", "Least budget of a client now.",
     &Connections::least_line},
    {"seam_lines_thin", "gauge", "Clients that their path limits.", &Connections::thin_lines},
    {"seam_doubts_total", "counter", "Messages with states that differ from what is expected.",
     &Connections::doubts},
    {"seam_distrusted", "gauge", "Players whose bodies the server holds for their doubts.",
     &Connections::distrusted},
    {"seam_recording_failed", "gauge", "1: the log, a snapshot or the store cannot be written.",
     &Connections::unkept},
};

constexpr const char* kDropped = "seam_dropped_total";
constexpr const char* kTrafficBytes = "seam_traffic_bytes_total";

std::string Head(const char* name, const char* type, const char* help) {
  return std::string("# HELP ") + name + ' ' + help + "\n# TYPE " + name + ' ' + type + '\n';
}

/// Returns `name{room="r",more} value`. A room's name needs no escapes (IsName).
std::string Sample(const char* name, const std::string& room, const std::string& more,
                   double value) {
  return std::string(name) + "{room=\"" + room + "\"" + more + "} " + MetricNumber(value) + '\n';
}

double Value(const Metric& metric, const Load& load) {
  const double n = metric.small != nullptr ? static_cast<double>(load.*metric.small)
                                           : static_cast<double>(load.*metric.large);
  return n * metric.unit;
}

void SetValue(const Metric& metric, double value, Load* load) {
  const double n = std::round(value / metric.unit);
  if (metric.small != nullptr) {
    load->*metric.small = static_cast<std::int32_t>(std::clamp(n, -1.0, 2147483647.0));
  } else {
    load->*metric.large = static_cast<std::int64_t>(n);
  }
}

/// A parsed sample line.
struct Line {
  std::string name, labels;
  double value = 0;
  /// Returns the value of a label, "" if there is none.
  std::string Label(const std::string& key) const {
    const std::size_t at = ("," + labels).find("," + key + "=\"");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + key.size() + 2;
    return labels.substr(begin, labels.find('"', begin) - begin);
  }
};

bool Split(const std::string& text, Line* line) {
  const std::size_t open = text.find('{'), close = text.find("} ");
  if (text.empty() || text[0] == '#' || open == std::string::npos || close == std::string::npos ||
      close < open) {
    return false;
  }
  line->name = text.substr(0, open);
  line->labels = text.substr(open + 1, close - open - 1);
  char* end = nullptr;
  line->value = std::strtod(text.c_str() + close + 2, &end);
  return std::isfinite(line->value) && std::abs(line->value) < 9e15;
}

void TakeTraffic(const Line& line, Load* load) {
  for (std::int8_t kind = 0; kind <= kTrafficOther; ++kind) {
    if (line.Label("kind") != kTraffic[kind]) continue;
    std::size_t i = 0;
    while (i < load->kind.size() && load->kind[i] != kind) ++i;
    if (i == load->kind.size()) {
      load->kind.push_back(kind), load->bytes_out.push_back(0), load->bytes_in.push_back(0);
    }
    const bool out = line.Label("direction") == "out";
    (out ? load->bytes_out : load->bytes_in)[i] = static_cast<std::int64_t>(line.value);
  }
}

void TakeConnections(const Line& line, Connections* connections) {
  for (const OfConnections& metric : kConnections) {
    if (line.name != metric.name) continue;
    connections->*metric.number = static_cast<std::int64_t>(line.value);
  }
}

void Take(const Line& line, Load* load) {
  for (const Metric& metric : kMetrics) {
    if (line.name == metric.name) SetValue(metric, line.value, load);
  }
  for (const Reason& reason : kReasons) {
    if (line.name != kDropped || line.Label("reason") != reason.name) continue;
    load->*reason.count = static_cast<std::int64_t>(line.value);
  }
  if (line.name == kTrafficBytes) TakeTraffic(line, load);
}

}  // namespace

const char* TrafficName(int kind) {
  return kind >= 0 && kind <= kTrafficOther ? kTraffic[kind] : kTraffic[kTrafficOther];
}

std::string WriteLoadPage(const std::vector<RoomLoad>& loads) {
  std::string text;
  for (const Metric& metric : kMetrics) {
    text += Head(metric.name, metric.type, metric.help);
    for (const RoomLoad& of : loads) {
      text += Sample(metric.name, of.room, "", Value(metric, of.load));
    }
  }
  for (const OfConnections& metric : kConnections) {
    text += Head(metric.name, metric.type, metric.help);
    for (const RoomLoad& of : loads) {
      const auto number = static_cast<double>(of.connections.*metric.number);
      text += Sample(metric.name, of.room, "", number);
    }
  }
  text += Head(kDropped, "counter", "Messages and datagrams that were dropped.");
  for (const RoomLoad& of : loads) {
    for (const Reason& reason : kReasons) {
      const std::string label = std::string(",reason=\"") + reason.name + '"';
      text += Sample(kDropped, of.room, label, static_cast<double>(of.load.*reason.count));
    }
  }
  text += Head(kTrafficBytes, "counter", "Bytes of UDP payload.");
  for (const RoomLoad& of : loads) {
    const Load& load = of.load;
    for (std::size_t i = 0; i < load.kind.size(); ++i) {
      const std::string kind = std::string(",kind=\"") + TrafficName(load.kind[i]) + '"';
      text += Sample(kTrafficBytes, of.room, kind + ",direction=\"out\"",
                     static_cast<double>(load.bytes_out[i]));
      text += Sample(kTrafficBytes, of.room, kind + ",direction=\"in\"",
                     static_cast<double>(load.bytes_in[i]));
    }
  }
  return text + WriteHistograms(loads);
}

std::vector<RoomLoad> ReadLoadPage(const std::string& text) {
  std::vector<RoomLoad> loads;
  std::istringstream in(text);
  for (std::string written; std::getline(in, written);) {
    Line line;
    if (!Split(written, &line)) continue;
    const std::string room = line.Label("room");
    if (room.empty()) continue;
    RoomLoad* found = nullptr;
    for (RoomLoad& known : loads) found = known.room == room ? &known : found;
    if (found == nullptr) {
      loads.emplace_back();
      loads.back().room = room;
      found = &loads.back();
    }
    Take(line, &found->load);
    TakeConnections(line, &found->connections);
    TakeHistogram(line.name, line.Label("le"), line.value, found);
  }
  return loads;
}

}  // namespace seam
