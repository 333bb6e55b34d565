#pragma once
/// Writer of trace events as JSON, one a line, with one process for each peer.

#include <cstdint>
#include <string>

#include "render/export/output_file.h"

namespace seam {

class TraceWriter {
 public:
  TraceWriter(OutputFile* out, int tick_hz);
  /// Names a peer's process.
  void Name(int peer, const std::string& name);
  /// Writes a slice of one tick. `arguments`: members of a JSON object, without its braces.
  void Slice(int peer, std::int64_t tick, const std::string& name, const std::string& arguments);
  /// Writes a span between the beginnings of two ticks. Spans of different `id` may overlap.
  void Span(int peer, std::int64_t from_tick, std::int64_t to_tick, std::int64_t id,
            const std::string& name);
  void Counter(int peer, std::int64_t tick, const char* name, double value);
  void Instant(int peer, std::int64_t tick, const std::string& name);
  /// Writes an arrow from a tick of one peer to the same or a later tick of another. Requires ticks
  /// that have slices, and from_tick <= to_tick.
  void Flow(const char* name, int from_peer, std::int64_t from_tick, int to_peer,
            std::int64_t to_tick);
  void Finish();

 private:
  double Us(std::int64_t tick) const { return static_cast<double>(tick) * 1e6 / tick_hz_; }
  /// `rest`: further members, beginning with a comma, or "".
  void Add(char phase, int peer, int thread, double us, const std::string& name,
           const std::string& rest);

  OutputFile* out_;
  int tick_hz_;
  bool first_ = true;
  std::int64_t flows_ = 0;
};

}  // namespace seam
