#pragma once
/// When and where a recording lost something: messages that the logger missed, ticks without a
/// view, datagrams that the network lost; by channel and moment.

#include <cstdint>
#include <string>
#include <vector>

#include "common/record/recording.h"
#include "common/record/time_range.h"

namespace seam {

struct Loss {
  enum class Kind {
    kBus,      ///< messages of the channel that are not in the log, by their sequence numbers
    kView,     ///< ticks of which the peer's view is not whole, or missing
    kInput,    ///< ticks of which no input of the player was accepted
    kNetwork,  ///< datagrams on the way to the peer, estimated: of the second, the share that its
               ///< last 256 lacked
  };
  Kind kind = Kind::kBus;
  std::string channel;          ///< as in the log, "SEAM.room.view.1"; of a network "to peer 1"
  double from_s = 0, to_s = 0;  ///< between which it was lost: moments of the session
  std::int64_t lost = 0;        ///< messages, ticks or datagrams
};

/// All losses of a log, by moment. `recording` is the log, read: it gives views and counters.
/// Throws OperatorError when the log cannot be opened.
std::vector<Loss> FindLosses(const std::string& path, const Recording& recording);
/// Those of views and networks alone, where there is no log.
std::vector<Loss> FindLosses(const Recording& recording);

/// Those that touch the range.
std::vector<Loss> Within(const std::vector<Loss>& losses, const TimeRange& range);

/// "bus", "view", "input", "network".
const char* LossKind(Loss::Kind kind);

/// A line for each, aligned, with a heading; "no losses" when there are none.
std::string FormatLosses(const std::vector<Loss>& losses);
/// kind,channel,from_s,to_s,lost.
std::string LossesCsv(const std::vector<Loss>& losses);

}  // namespace seam
