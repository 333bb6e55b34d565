#include "common/record/loss_timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>
#include <variant>

#include "common/codec/codec.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// The sequence number of a message on the bus, and the tick of a view; -1: none.
struct Numbered {
  std::int64_t sequence = -1, view_tick = -1;
};

Numbered NumbersOf(const Bytes& data) {
  Numbered numbers;
  std::visit(
      [&](const auto& m) {
        using M = std::decay_t<decltype(m)>;
        if constexpr (!std::is_same_v<M, std::monostate>) {
          if constexpr (MessageTraits<M>::kTravels != Travels::kEdge) {
            numbers.sequence = m.sequence;
          }
          if constexpr (std::is_same_v<M, View>) numbers.view_tick = m.tick;
        }
      },
      Decode(data));
  return numbers;
}

void FindBusLosses(const std::string& path, const Room& room, std::vector<Loss>* losses) {
  struct Last {
    std::int64_t sequence = -1;
    double at_s = 0;
  };
  std::map<std::string, Last> channels;
  const double tick_hz = std::max(1, room.tick_hz);
  double now_s = 0;
  LogReader reader(path);
  for (LogEvent event; reader.Next(&event);) {
    if (RoomOfChannel(event.channel) != room.room) continue;
    if (SessionOf(event.data) != room.session) continue;
    const Numbered numbers = NumbersOf(event.data);
    if (numbers.sequence < 0) continue;
    if (numbers.view_tick >= 0) now_s = static_cast<double>(numbers.view_tick) / tick_hz;
    Last& last = channels[event.channel];
    const std::int64_t missing = numbers.sequence - last.sequence - 1;
    if (last.sequence >= 0 && missing > 0 && missing + 1 < kNumbersAheadMax) {
      losses->push_back({Loss::Kind::kBus, event.channel, last.at_s, now_s, missing});
    }
    if (numbers.sequence > last.sequence || missing < -64) last = {numbers.sequence, now_s};
  }
}

void FindViewLosses(const Recording& recording, double tick_hz, std::vector<Loss>* losses) {
  const std::string prefix = "SEAM." + recording.room.room + ".view.";
  for (const auto& [peer, views] : recording.views) {
    std::int64_t expected = views.empty() ? 0 : views.begin()->first;
    for (const auto& [tick, view] : views) {
      if (tick > expected) {
        losses->push_back({Loss::Kind::kView, prefix + std::to_string(peer),
                           static_cast<double>(expected) / tick_hz,
                           static_cast<double>(tick - 1) / tick_hz, tick - expected});
      }
      expected = tick + 1;
    }
  }
}

void FindInputLosses(const Recording& recording, double tick_hz, std::vector<Loss>* losses) {
  const std::string prefix = "SEAM." + recording.room.room + ".inputs.";
  for (const auto& [player, messages] : recording.inputs) {
    std::int64_t expected = messages.empty() ? 0 : messages.begin()->first;
    for (const auto& [first, message] : messages) {
      if (first > expected) {
        losses->push_back({Loss::Kind::kInput, prefix + std::to_string(player),
                           static_cast<double>(expected) / tick_hz,
                           static_cast<double>(first - 1) / tick_hz, first - expected});
      }
      const auto count = static_cast<std::int64_t>(message.drive.size());
      expected = std::max(expected, first + count);
    }
  }
}

void FindNetworkLosses(const Recording& recording, double tick_hz, std::vector<Loss>* losses) {
  for (const auto& [peer, counters] : recording.stats) {
    for (std::size_t i = 1; i < counters.size(); ++i) {
      const Stats &a = counters[i - 1], &b = counters[i];
      const auto came = static_cast<double>(b.datagrams_in - a.datagrams_in);
      const double share = std::clamp(b.loss_ppm / 1e6, 0.0, 0.999);
      const std::int64_t lost = std::llround(came * share / (1 - share));
      if (came <= 0 || lost <= 0) continue;
      losses->push_back({Loss::Kind::kNetwork, "to peer " + std::to_string(peer),
                         static_cast<double>(a.tick) / tick_hz,
                         static_cast<double>(b.tick) / tick_hz, lost});
    }
  }
}

std::vector<Loss> Sorted(std::vector<Loss> losses) {
  std::stable_sort(losses.begin(), losses.end(),
                   [](const Loss& a, const Loss& b) { return a.from_s < b.from_s; });
  return losses;
}

std::vector<Loss> OfRecording(const Recording& recording) {
  const double tick_hz = std::max(1, recording.room.tick_hz);
  std::vector<Loss> losses;
  FindViewLosses(recording, tick_hz, &losses);
  FindInputLosses(recording, tick_hz, &losses);
  FindNetworkLosses(recording, tick_hz, &losses);
  return losses;
}

}  // namespace

std::vector<Loss> FindLosses(const std::string& path, const Recording& recording) {
  std::vector<Loss> losses = OfRecording(recording);
  FindBusLosses(path, recording.room, &losses);
  return Sorted(std::move(losses));
}

std::vector<Loss> FindLosses(const Recording& recording) { return Sorted(OfRecording(recording)); }

std::vector<Loss> Within(const std::vector<Loss>& losses, const TimeRange& range) {
  std::vector<Loss> within;
  for (const Loss& loss : losses) {
    if (!std::isnan(range.from_s) && loss.to_s < range.from_s) continue;
    if (!std::isnan(range.to_s) && loss.from_s > range.to_s) continue;
    within.push_back(loss);
  }
  return within;
}

const char* LossKind(Loss::Kind kind) {
  switch (kind) {
    case Loss::Kind::kBus: return "bus";
    case Loss::Kind::kView: return "view";
    case Loss::Kind::kInput: return "input";
    case Loss::Kind::kNetwork: return "network";
  }
  return "";
}

std::string FormatLosses(const std::vector<Loss>& losses) {
  if (losses.empty()) return "no losses\n";
  std::size_t width = 7;
  for (const Loss& loss : losses) width = std::max(width, loss.channel.size());
  std::string text = fmt::format("{:>8}  {:>8}  {:<7}  {:<{}}  {:>5}\n", "from s", "to s", "kind",
                                 "channel", width, "lost");
  for (const Loss& loss : losses) {
    const bool about = loss.kind == Loss::Kind::kNetwork;
    text += fmt::format("{:8.3f}  {:8.3f}  {:<7}  {:<{}}  {:>5}\n", loss.from_s, loss.to_s,
                        LossKind(loss.kind), loss.channel, width,
                        (about ? "~" : "") + std::to_string(loss.lost));
  }
  return text;
}

std::string FormatLossStrips(const std::vector<Loss>& losses, double end_s) {
  std::map<std::string, std::vector<double>> strips;  // by kind and channel: lost in each slice
  std::size_t width = 0;
  const double slice_s = std::max(end_s, 1e-3) / kLossSlices;
  const auto slice_of = [&](double second) {
    return static_cast<std::size_t>(std::clamp(second / slice_s, 0.0, kLossSlices - 1.0));
  };
  for (const Loss& loss : losses) {
    const std::string name = fmt::format("{:<7}  {}", LossKind(loss.kind), loss.channel);
    width = std::max(width, name.size());
    std::vector<double>& strip = strips.emplace(name, kLossSlices).first->second;
    const std::size_t first = slice_of(loss.from_s), last = slice_of(loss.to_s);
    for (std::size_t i = first; i <= last; ++i) {
      strip[i] += static_cast<double>(loss.lost) / static_cast<double>(last - first + 1);
    }
  }
  if (strips.empty()) return "";
  std::string text = fmt::format("{:<{}}  |0 s{:>{}}|\n", "kind     channel", width,
                                 fmt::format("{:.1f} s", end_s), kLossSlices - 3);
  for (const auto& [name, strip] : strips) {
    text += fmt::format("{:<{}}  |", name, width);
    for (const double lost : strip) {
      const int count = static_cast<int>(std::ceil(lost - 1e-9));
      text += count <= 0 ? '.' : count <= 9 ? static_cast<char>('0' + count) : '#';
    }
    text += "|\n";
  }
  return text;
}

std::string LossesCsv(const std::vector<Loss>& losses) {
  std::string text = "kind,channel,from_s,to_s,lost\n";
  for (const Loss& loss : losses) {
    text += fmt::format("{},{},{:.6f},{:.6f},{}\n", LossKind(loss.kind), loss.channel, loss.from_s,
                        loss.to_s, loss.lost);
  }
  return text;
}

}  // namespace seam
