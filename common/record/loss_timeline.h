#pragma once
/// The losses of a recording by channel and time: messages missed by the logger, ticks without a
/// view or input, datagrams lost in the network.

#include <cstdint>
#include <string>
#include <vector>

#include "common/record/recording.h"
#include "common/record/time_range.h"

namespace seam {

struct Loss {
  enum class Kind {
    kBus,      ///< messages of the channel missing in the log, by their sequence numbers
    kView,     ///< ticks with an incomplete or missing view of the peer
    kInput,    ///< ticks without an accepted input of the player
    kNetwork,  ///< datagrams to the peer, estimated per second from the loss among the last 256
  };
  Kind kind = Kind::kBus;
  std::string channel;          ///< as in the log, "SEAM.room.view.1"; for kNetwork "to peer 1"
  double from_s = 0, to_s = 0;  ///< interval of the loss, session time
  std::int64_t lost = 0;        ///< messages, ticks or datagrams
};

/// Returns all losses of a log, by time. `recording` must be read from that log; it supplies views,
/// inputs and counters. Throws OperatorError when the log cannot be opened.
std::vector<Loss> FindLosses(const std::string& path, const Recording& recording);
/// Returns the losses except kBus, for a recording without a log.
std::vector<Loss> FindLosses(const Recording& recording);

/// Slices of a session in a strip: it fits a terminal beside the channel's name.
constexpr int kLossSlices = 50;

/// Returns the losses that overlap the range.
std::vector<Loss> Within(const std::vector<Loss>& losses, const TimeRange& range);

/// Returns "bus", "view", "input" or "network".
const char* LossKind(Loss::Kind kind);

/// Returns a heading and one aligned line per loss; "no losses" when there are none.
std::string FormatLosses(const std::vector<Loss>& losses);
/// Returns a line per kind and channel: the session from 0 to `end_s` from left to right, in
/// kLossSlices slices. '.': nothing lost; 1 to 9, then '#': so many or more in the slice, a loss
/// spread evenly over its interval. "" when there are none.
std::string FormatLossStrips(const std::vector<Loss>& losses, double end_s);
/// Returns the losses as CSV: kind,channel,from_s,to_s,lost.
std::string LossesCsv(const std::vector<Loss>& losses);

}  // namespace seam
