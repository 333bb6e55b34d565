#pragma once
/// The newest events of a stream, once for all watchers. A watcher that is too slow finds that its
/// place is gone, and begins anew: it costs no memory of its own.

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

namespace seam {

class EventRing {
 public:
  using Piece = std::shared_ptr<const std::string>;

  /// Adds an event of server-sent events, named `kind`. `data` has no line end.
  void Add(const std::string& kind, const std::string& data);
  /// Forgets all events; every watcher begins anew.
  void Clear();
  /// Returns the place behind the newest event; at least 1.
  std::uint64_t end() const { return begin_ + pieces_.size(); }
  /// True if the events from `place` on are all known.
  bool Has(std::uint64_t place) const { return place >= begin_ && place <= end(); }
  /// Returns the event at a place and moves the place behind it; nullptr at the end. Requires
  /// Has(*place).
  Piece At(std::uint64_t* place) const;
  /// Returns the bytes of all events so far.
  std::int64_t bytes() const { return bytes_; }

  /// Most bytes kept: some seconds of a large room.
  static constexpr std::size_t kBytesMax = 2000000;

 private:
  std::uint64_t begin_ = 1;  // place of the oldest piece
  std::deque<Piece> pieces_;
  std::size_t kept_ = 0;  // bytes of pieces_
  std::int64_t bytes_ = 0;
};

/// Returns one event of server-sent events.
std::string EventText(const std::string& kind, const std::string& data);

}  // namespace seam
