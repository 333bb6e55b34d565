#pragma once
/// Publishes a peer's messages on the bus, with session, number and room name.

#include <cstdint>
#include <map>
#include <string>

#include "common/codec/codec.h"
#include "common/record/recorder.h"

namespace seam {

class Publisher {
 public:
  /// `room` and `session`: as in the room's Room message.
  Publisher(Recorder& recorder, std::string room, std::int64_t session)
      : recorder_(recorder), room_(std::move(room)), session_(session) {}

  /// False if published messages reach no listener.
  bool listening() const { return recorder_.listening(); }
  std::int64_t session() const { return session_; }
  /// Requires a message that travels on the bus (message_list.h).
  template <class Message>
  void Publish(Message message);
  /// Splits views of more than kViewBodiesMax bodies.
  void Publish(const View& message);
  /// Publishes a checksum of all that was published since the last call. `peer`: this one.
  void EndTick(std::int64_t utime, int peer, std::int64_t tick);
  /// True if something was published since then.
  bool pending() const { return chain_.messages > 0; }

 private:
  template <class Message>
  void Number(Message& message);

  Recorder& recorder_;
  std::string room_;
  std::int64_t session_;
  std::map<std::string, std::int64_t> sequence_;
  TickChain chain_;  // of the messages since the last EndTick
};

}  // namespace seam
