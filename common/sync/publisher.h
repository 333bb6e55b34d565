#pragma once
/// Publishes a peer's messages on the bus, with session, number and room name.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/codec/codec.h"
#include "common/record/recorder.h"

namespace seam {

class Publisher {
 public:
  /// `room` and `session`: as in the room's Room message.
  Publisher(Recorder& recorder, std::string room, std::int64_t session)
      : recorder_(recorder), room_(std::move(room)), session_(session) {}
  /// Publishes the view that waits.
  ~Publisher() { PublishUnmoved(); }
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// False if published messages reach no listener.
  bool listening() const { return recorder_.listening(); }
  std::int64_t session() const { return session_; }
  /// Requires a message that travels on the bus (message_list.h).
  template <class Message>
  void Publish(Message message);
  /// Publishes a message once more, for late listeners: logs do not keep it.
  template <class Message>
  void Repeat(Message message);
  /// Splits views of more than kViewBodiesMax bodies. A view like the last one published
  /// waits: the next that moves counts it (`unmoved`), and one a second is published.
  void Publish(const View& message);
  /// Notes that the next messages come after the beginning of a tick's step (server only).
  void NoteStep() { before_step_ = NewMessages(); }
  /// Notes the end of the tick that began with NoteStep. `hash`: of the world.
  void NoteTick(std::uint64_t hash);
  /// Seals all that was published. The seal is kept when it is little beside the messages (or
  /// `keep`), and the next one is then of later messages only. `peer`: this one.
  void EndTick(std::int64_t utime, int peer, std::int64_t tick, bool keep = false);
  /// Publishes the last view if it waits, so that all ticks until now can be read.
  void PublishUnmoved();
  /// True if something was published since the last call of EndTick.
  bool pending() const { return pending_; }

  /// A seal has at most one byte in so many of the log.
  static constexpr std::size_t kSealShare = 40;

 private:
  template <class Message>
  void Number(Message& message);
  void PublishNow(const View& view);
  /// Messages that belong to no tick yet.
  std::int32_t NewMessages() const { return seal_.messages - sealed_; }

  Recorder& recorder_;
  std::string room_;
  std::int64_t session_;
  std::map<std::string, std::int64_t> sequence_;
  View shown_;                     // the last view that was published; without ticks, none
  int unmoved_ = 0;                // ticks since then that showed the same
  std::int64_t unmoved_us_ = 0;    // time of the last of them
  LogSeal seal_;                   // of the messages since the last one that was kept
  std::size_t bytes_ = 0;          // of these in a log
  std::vector<SealedTick> ticks_;  // since then
  std::int32_t sealed_ = 0;        // messages of these
  std::int32_t before_step_ = 0;
  bool ticked_ = false;  // a tick has ended since the last call of EndTick
  int unkept_ = 0;  // calls of EndTick since then
  bool pending_ = false;
};

}  // namespace seam
