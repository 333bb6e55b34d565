#pragma once
/// Publishes a peer's messages on the bus, with number and room name.

#include <map>
#include <string>

#include "common/codec/codec.h"
#include "common/record/recorder.h"

namespace seam {

class Publisher {
 public:
  Publisher(Recorder& recorder, std::string room) : recorder_(recorder), room_(std::move(room)) {}

  /// False if published messages reach no listener.
  bool listening() const { return recorder_.listening(); }
  /// Requires a message that travels on the bus (message_list.h).
  template <class Message>
  void Publish(Message message);
  /// Splits views of more than kViewBodiesMax bodies.
  void Publish(const View& message);

 private:
  template <class Message>
  void Number(Message& message);

  Recorder& recorder_;
  std::string room_;
  std::map<std::string, std::int64_t> sequence_;
};

}  // namespace seam
