#include "common/record/load_histograms.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace seam {
namespace {

struct Named {
  const char* name;
  const char* help;
  BucketHistogram& (*of)(RoomLoad&);
};
const Named kHistograms[] = {
    {"seam_tick_seconds", "Wall time of the ticks since the start.",
     [](RoomLoad& room) -> BucketHistogram& { return room.tick; }},
    {"seam_late_seconds", "Lateness of the ticks since the start.",
     [](RoomLoad& room) -> BucketHistogram& { return room.late; }},
    {"seam_round_trip_seconds", "Round trips, of each client once a second.",
     [](RoomLoad& room) -> BucketHistogram& { return room.connections.round_trip; }},
    {"seam_queue_seconds", "Delay of a client's path by our own traffic, once a second.",
     [](RoomLoad& room) -> BucketHistogram& { return room.connections.queue; }},
    {"seam_loss_ratio", "Share of a client's datagrams that is lost, once a second.",
     [](RoomLoad& room) -> BucketHistogram& { return room.connections.loss; }},
    {"seam_corrected_metres", "Corrections of the server's copies of clients' bodies.",
     [](RoomLoad& room) -> BucketHistogram& { return room.connections.corrected; }}};

std::string Seconds(std::int64_t us) { return MetricNumber(static_cast<double>(us) * 1e-6); }

void Write(const Named& named, const RoomLoad& load, std::string* text) {
  const BucketHistogram& h = named.of(const_cast<RoomLoad&>(load));  // which is only read
  const std::string name = named.name, room = "{room=\"" + load.room + '"';
  const std::string bucket = name + "_bucket" + room + ",le=\"";
  for (std::size_t i = 0; i < h.at_most.size(); ++i) {
    *text += bucket + Seconds(h.kBoundsUs[i]) + "\"} " + std::to_string(h.at_most[i]) + '\n';
  }
  const std::string count = "} " + std::to_string(h.count) + '\n';
  *text += bucket + "+Inf\"" + count;
  *text += name + "_sum" + room + "} " + Seconds(h.sum_us) + '\n';
  *text += name + "_count" + room + count;
}

void TakeBucket(const std::string& le, std::int64_t value, BucketHistogram* h) {
  // Matches bounds to half a microsecond. "+Inf" matches none: it equals the count.
  const double bound_us = std::strtod(le.c_str(), nullptr) * 1e6;
  for (std::size_t i = 0; i < h->at_most.size(); ++i) {
    const auto known_us = static_cast<double>(h->kBoundsUs[i]);
    if (std::abs(bound_us - known_us) < 0.5) h->at_most[i] = value;
  }
}

}  // namespace

std::string MetricNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  return text;
}

std::string WriteHistograms(const std::vector<RoomLoad>& loads) {
  std::string text;
  for (const Named& named : kHistograms) {
    text += std::string("# HELP ") + named.name + ' ' + named.help + "\n# TYPE " + named.name +
            " histogram\n";
    for (const RoomLoad& load : loads) Write(named, load, &text);
  }
  return text;
}

void TakeHistogram(const std::string& name, const std::string& le, double value, RoomLoad* room) {
  for (const Named& named : kHistograms) {
    const std::string of = named.name;
    if (name.rfind(of, 0) != 0) continue;
    const std::string what = name.substr(of.size());
    BucketHistogram& h = named.of(*room);
    if (what == "_bucket") TakeBucket(le, std::llround(value), &h);
    if (what == "_count") h.count = std::llround(value);
    if (what == "_sum") h.sum_us = std::llround(value * 1e6);
  }
}

}  // namespace seam
