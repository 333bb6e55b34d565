/// One JSON document with all contents of a recording, poses as arrays of numbers.

#include <string>

#include "common/base/json_text.h"
#include "common/topology/edit.h"
#include "render/export/formats.h"

namespace seam {
namespace {

/// Writes a list with commas between its items.
class List {
 public:
  List(OutputFile* out, const std::string& head) : out_(out) { out_->Write(head); }
  void Add(const std::string& item) {
    out_->Write((first_ ? "\n  " : ",\n  ") + item);
    first_ = false;
  }
  void End(const char* tail) { out_->Write(tail); }

 private:
  OutputFile* out_;
  bool first_ = true;
};

std::string Number(std::int64_t value) { return std::to_string(value); }

void WriteRoom(const Room& room, OutputFile* out) {
  out->Write("{\n\"format\": \"seam2d-export\",\n\"version\": 1,\n\"room\": {");
  out->Write("\"name\": " + JsonText(room.room) + ", \"scene\": " + JsonText(room.scene_name) +
             ", \"mode\": " + JsonText(room.mode) + ", \"reconcile\": " + JsonText(room.reconcile) +
             ", \"predict\": " + JsonText(room.predict) + ", \"impair\": " + JsonText(room.impair));
  out->Write(", \"seed\": " + JsonText(Number(room.seed)) +
             ", \"tick_hz\": " + Number(room.tick_hz) + ", \"send_hz\": " + Number(room.send_hz) +
             ", \"input_delay_ticks\": " + Number(room.input_delay_ticks) +
             ", \"scene_text\": " + JsonText(room.scene_text) + "},\n");
}

void WriteNames(const ExportSession& session, OutputFile* out) {
  List lacking(out, "\"lacking\": [");
  for (const std::string& line : session.lacking) lacking.Add(JsonText(line));
  lacking.End("],\n");
  List players(out, "\"players\": [");
  for (const Player& player : session.scene.players) players.Add(JsonText(player.name));
  players.End("],\n");
  List views(out, "\"views\": [");
  for (const auto& [peer, of_peer] : session.recording.views) {
    views.Add("{\"peer\": " + Number(peer) + ", \"name\": " + JsonText(session.ViewName(peer)) +
              ", \"ticks\": " + Number(static_cast<std::int64_t>(of_peer.size())) + "}");
  }
  views.End("],\n");
  List bodies(out, "\"bodies\": [");
  for (const ExportBody& body : session.bodies) {
    bodies.Add("{\"id\": " + Number(body.id) + ", \"name\": " + JsonText(body.name) + "}");
  }
  bodies.End("],\n");
}

std::string PartOrNull(const ExportSession& session, int part) {
  return part < 0 ? "null" : JsonText(session.PartName(part));
}

void WriteEdits(const ExportSession& session, OutputFile* out) {
  static const char* const kEditNames[] = {"none", "break", "bond", "insert", "remove",
                                           "free", "push",  "seat", "blast"};
  List edits(out, "\"edits\": [");
  for (const auto& [number, edit] : session.recording.edits) {
    const auto kind = static_cast<std::size_t>(edit.kind);
    const std::string name = kind < std::size(kEditNames) ? kEditNames[kind] : Number(edit.kind);
    std::string values;
    for (const float value : edit.value) {
      values += (values.empty() ? "" : ", ") + JsonNumber(double{value});
    }
    edits.Add(
        "{\"number\": " + Number(number) + ", \"tick\": " + Number(edit.tick) + ", \"kind\": " +
        JsonText(name) + ", \"cause\": " + (edit.cause == 0 ? "\"physics\"" : "\"outside\"") +
        ", \"a\": " + PartOrNull(session, edit.a) + ", \"b\": " + PartOrNull(session, edit.b) +
        ", \"joint\": " + Number(edit.joint) +
        ", \"player\": " + (edit.player < 0 ? "null" : JsonText(session.PlayerName(edit.player))) +
        ", \"text\": " + JsonText(edit.text) + ", \"value\": [" + values + "]}");
  }
  edits.End("],\n");
}

/// Writes [tick, player, drive, lift, buttons], a row for each tick with an input.
void WriteInputs(const ExportSession& session, const TimeRange& range, OutputFile* out) {
  List inputs(out,
              "\"inputs\": {\"columns\": [\"tick\", \"player\", \"drive\", \"lift\", "
              "\"buttons\"], \"rows\": [");
  const int hz = session.recording.room.tick_hz;
  for (const auto& [player, of_player] : session.recording.inputs) {
    const std::string name = JsonText(session.PlayerName(player));
    for (const auto& [first_tick, message] : of_player) {
      for (std::size_t i = 0; i < message.drive.size(); ++i) {
        const std::int64_t tick = first_tick + static_cast<std::int64_t>(i);
        if (!range.Holds(tick, hz)) continue;
        inputs.Add("[" + Number(tick) + "," + name + "," + Number(message.drive[i]) + "," +
                   Number(message.lift[i]) + "," + Number(message.buttons[i]) + "]");
      }
    }
  }
  inputs.End("]},\n");
}

void WriteEvents(const ExportSession& session, OutputFile* out) {
  List events(out, "\"events\": [");
  for (const Event& event : session.recording.events) {
    events.Add("{\"tick\": " + Number(event.tick) +
               ", \"peer\": " + JsonText(session.ViewName(event.peer)) +
               ", \"text\": " + JsonText(event.text) + "}");
  }
  events.End("],\n");
  List impacts(out,
               "\"impacts\": {\"columns\": [\"tick\", \"view\", \"a\", \"b\", \"x\", \"y\", "
               "\"dv\"], \"rows\": [");
  for (const Impacts& message : session.recording.impacts) {
    for (std::size_t i = 0; i < message.id_a.size(); ++i) {
      impacts.Add("[" + Number(message.tick) + "," + JsonText(session.ViewName(message.peer)) +
                  "," + PartOrNull(session, message.id_a[i]) + "," +
                  PartOrNull(session, message.id_b[i]) + "," + JsonNumber(double{message.x[i]}) +
                  "," + JsonNumber(double{message.y[i]}) + "," + JsonNumber(double{message.dv[i]}) +
                  "]");
    }
  }
  impacts.End("]},\n");
}

void WritePoses(const ExportSession& session, OutputFile* out) {
  List poses(out,
             "\"poses\": {\"columns\": [\"tick\", \"peer\", \"body\", \"x\", \"y\", \"angle\", "
             "\"vx\", \"vy\", \"spin\", \"error_m\", \"authority\"], \"rows\": [");
  ForEachView(session, [&](const View& view) {
    for (const ExportRow& row : RowsOf(session, view)) {
      const std::size_t i = row.i;
      std::string text = "[" + Number(view.tick) + "," + Number(view.peer) + "," + Number(row.id);
      for (const float value :
           {view.x[i], view.y[i], view.angle[i], view.vx[i], view.vy[i], view.spin[i]}) {
        text += ',' + JsonNumber(double{value});
      }
      poses.Add(text + ',' + JsonNumber(row.error_m) + ',' + Number(view.authority[i]) + ']');
    }
  });
  poses.End("]}\n}\n");
}

}  // namespace

void WriteJsonExport(const ExportSession& session, OutputFile* out) {
  WriteRoom(session.recording.room, out);
  WriteNames(session, out);
  WriteEdits(session, out);
  WriteInputs(session, session.range, out);
  WriteEvents(session, out);
  WritePoses(session, out);
}

}  // namespace seam
