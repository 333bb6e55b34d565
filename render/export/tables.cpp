/// Events and metrics as tables, for analysis beside the poses of --csv.

#include "common/base/json_text.h"
#include "common/measure/table.h"
#include "common/record/events/event_text.h"
#include "render/export/formats.h"

namespace seam {
namespace {

double SecondsOf(const ExportSession& session, std::int64_t tick) {
  return static_cast<double>(tick) * session.TickSeconds();
}

std::string OrNothing(std::int64_t number) { return number < 0 ? "" : std::to_string(number); }

}  // namespace

void WriteEventsTable(const ExportSession& session, OutputFile* out) {
  out->Write("tick,time_s,kind,client,player,body,other,index,value,text\n");
  for (const Event& event : session.recording.events) {
    const auto part = [&](std::int32_t id) {
      return id < 0 ? std::string() : CsvField(session.PartName(id));
    };
    std::string row = std::to_string(event.tick);
    for (const std::string& field :
         {JsonNumber(SecondsOf(session, event.tick)), std::string(EventKindName(event.kind)),
          OrNothing(event.client),
          event.player < 0 ? std::string() : CsvField(session.PlayerName(event.player)),
          part(event.body), part(event.other), OrNothing(event.index),
          JsonNumber(static_cast<double>(event.value_milli) * 1e-3, 3), CsvField(event.text)}) {
      row += ',' + field;
    }
    out->Write(row + '\n');
  }
}

void WriteMetricsTable(const ExportSession& session, OutputFile* out) {
  out->Write(
      "tick,time_s,peer,bytes_out,bytes_in,datagrams_out,datagrams_in,malformed,stale,right,"
      "implausible,budget,cpu_us,rtt_us,jitter_us,loss_ppm,tick_late_us\n");
  for (const auto& [peer, readings] : session.recording.stats) {
    for (const Stats& s : readings) {
      std::string row = std::to_string(s.tick) + ',' + JsonNumber(SecondsOf(session, s.tick)) +
                        ',' + CsvField(session.ViewName(peer));
      for (const std::int64_t n :
           {s.bytes_out, s.bytes_in, s.datagrams_out, s.datagrams_in, s.dropped_malformed,
            s.dropped_stale, s.dropped_right, s.dropped_implausible, s.dropped_budget, s.cpu_us}) {
        row += ',' + std::to_string(n);
      }
      row += ',' + OrNothing(s.rtt_us) + ',' + OrNothing(s.jitter_us) + ',' +
             std::to_string(s.loss_ppm) + ',' + std::to_string(s.tick_late_us);
      out->Write(row + '\n');
    }
  }
}

}  // namespace seam
