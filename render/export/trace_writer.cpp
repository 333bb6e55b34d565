#include "render/export/trace_writer.h"

#include <cstdio>

#include "common/base/json_text.h"

namespace seam {
namespace {

/// Threads of a peer's process.
constexpr int kTicks = 1, kEvents = 2;

std::string Micro(double us) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f", us);
  return text;
}

}  // namespace

TraceWriter::TraceWriter(OutputFile* out, int tick_hz) : out_(out), tick_hz_(tick_hz) {
  out_->Write("{\"displayTimeUnit\":\"ms\",\"traceEvents\":[");
}

void TraceWriter::Add(char phase, int peer, int thread, double us, const std::string& name,
                      const std::string& rest) {
  // Trace viewers take process 0 for the idle process.
  out_->Write((first_ ? "\n{" : ",\n{") + std::string("\"ph\":\"") + phase +
              "\",\"pid\":" + std::to_string(peer + 1) + ",\"tid\":" + std::to_string(thread) +
              ",\"ts\":" + Micro(us) + ",\"name\":" + JsonText(name) + rest + "}");
  first_ = false;
}

void TraceWriter::Name(int peer, const std::string& name) {
  Add('M', peer, 0, 0, "process_name", ",\"args\":{\"name\":" + JsonText(name) + "}");
  Add('M', peer, 0, 0, "process_sort_index",
      ",\"args\":{\"sort_index\":" + std::to_string(peer) + "}");
  Add('M', peer, kTicks, 0, "thread_name", ",\"args\":{\"name\":\"ticks\"}");
  Add('M', peer, kEvents, 0, "thread_name", ",\"args\":{\"name\":\"events\"}");
}

void TraceWriter::Slice(int peer, std::int64_t tick, const std::string& name,
                        const std::string& arguments) {
  Add('X', peer, kTicks, Us(tick), name,
      ",\"cat\":\"tick\",\"dur\":" + Micro(1e6 / tick_hz_) + ",\"args\":{" + arguments + "}");
}

void TraceWriter::Span(int peer, std::int64_t from_tick, std::int64_t to_tick, std::int64_t id,
                       const std::string& name) {
  const std::string rest =
      ",\"cat\":\"authority\",\"id2\":{\"local\":\"" + std::to_string(id) + "\"}";
  Add('b', peer, kTicks, Us(from_tick), name, rest);
  Add('e', peer, kTicks, Us(to_tick), name, rest);
}

void TraceWriter::Counter(int peer, std::int64_t tick, const char* name, double value) {
  Add('C', peer, 0, Us(tick), name, ",\"args\":{\"rms\":" + JsonNumber(value) + "}");
}

void TraceWriter::Instant(int peer, std::int64_t tick, const std::string& name) {
  Add('i', peer, kEvents, Us(tick), name, ",\"s\":\"t\"");
}

void TraceWriter::Flow(const char* name, int from_peer, std::int64_t from_tick, int to_peer,
                       std::int64_t to_tick) {
  const std::string rest = ",\"cat\":\"message\",\"id\":" + std::to_string(++flows_);
  const double quarter_us = 2.5e5 / tick_hz_;
  Add('s', from_peer, kTicks, Us(from_tick) + quarter_us, name, rest);
  Add('f', to_peer, kTicks, Us(to_tick) + 3 * quarter_us, name, rest + ",\"bp\":\"e\"");
}

void TraceWriter::Finish() { out_->Write("\n]}\n"); }

}  // namespace seam
