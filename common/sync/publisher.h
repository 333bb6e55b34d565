#pragma once
/// Numbers, names and publishes a peer's messages on the bus.

#include <map>
#include <string>

#include "common/codec/codec.h"
#include "common/record/recorder.h"

namespace seam {

class Publisher {
 public:
  Publisher(Recorder& recorder, std::string room) : recorder_(recorder), room_(std::move(room)) {}

  void Publish(Room message);
  void Publish(Inputs message);
  void Publish(States message);
  void Publish(Grants message);
  void Publish(EditOrder message);
  void Publish(Meta message);
  /// Splits views of more than kViewBodiesMax bodies.
  void Publish(const View& message);
  void Publish(Impacts message);
  void Publish(Stats message);
  void Publish(Event message);

 private:
  template <typename Message>
  void Number(Message& message, const char* kind, int peer);

  Recorder& recorder_;
  std::string room_;
  std::map<std::string, std::int32_t> sequence_;
};

}  // namespace seam
