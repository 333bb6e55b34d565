/// Hostile text in a log stays text in every format of seam-export.

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/recorder.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"

namespace seam {
namespace export_hostile_test {

const char* const kHostile =
    R"x("}],"poses":[{"tick":1}], </script><script>alert(1)</script> \" ,"",)x";

/// A log of one view and one event; the name of the scene and the event's text are hostile.
void WriteHostileLog(const std::string& path) {
  LogWriter log(path);
  Room room;
  room.room = "r";
  room.scene_name = "\"</script>,";
  room.scene_text = "[[part]]\nname = \"ball\"\ncircle = 1\n[[player]]\nname = \"server\"\n";
  room.mode = "buffer";
  room.reconcile = "fade";
  room.impair = kHostile;
  View view;
  view.id = {0};
  view.role = {kRoleAuthority};
  view.authority = {0};
  view.x = view.y = view.angle = view.vx = view.vy = view.spin = view.age = {0};
  Event event;
  event.text = kHostile;
  const auto publish = [&](const char* kind, int peer, const Bytes& bytes) {
    log.Publish(ChannelName("r", kind, peer), 0, bytes);
  };
  publish("scene", -1, Encode(room));
  for (const int peer : {0, 1}) {
    view.peer = peer;
    publish("view", peer, Encode(view));
  }
  publish("event", 0, Encode(event));
}

TEST(ExportHostile, TextStaysTextInEveryFormat) {
  const LabWorkspace files;
  WriteHostileLog(files / "a.lcm");
  for (const std::string format : {"csv", "json", "mcap", "trace"}) {
    Program program({BuiltProgram("seam-export"), files / "a.lcm", "--" + format, "-o",
                     files / ("a." + format)});
    ASSERT_TRUE(program.Wait(60));
    ASSERT_EQ(program.status(), 0) << program.Story();
    EXPECT_EQ(files.Read("a." + format).find("<script>"), std::string::npos) << format;
  }
  files.Write("text", kHostile);
  files.Write("check.py", R"py(
import csv, json, sys
at = sys.argv[1]
text = open(at + "/text").read()
doc = json.load(open(at + "/a.json"))
assert doc["events"] == [{"tick": 0, "peer": "server", "text": text}], doc["events"]
assert doc["room"]["impair"] == text and doc["room"]["scene"] == '"</script>,'
assert len(doc["poses"]["rows"]) == 2
trace = json.load(open(at + "/a.trace"))["traceEvents"]
assert [e["name"] for e in trace if e["ph"] == "i"] == [text]
rows = list(csv.DictReader(open(at + "/a.csv")))
# A player who calls himself server is not the server.
assert [(r["view"], r["body"]) for r in rows] == [("server", "ball"), ("peer 1", "ball")], rows
)py");
  Program check({"python3", files / "check.py", files / ""});
  ASSERT_TRUE(check.Wait(60));
  if (check.status() == 127) GTEST_SKIP() << "there is no python3";
  EXPECT_EQ(check.status(), 0) << check.Story();
}

}  // namespace export_hostile_test
}  // namespace seam
