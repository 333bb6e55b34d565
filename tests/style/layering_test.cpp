/// Enforces the table of docs/architecture.md: which room may include which, which file is the door
/// to which library, and how large a room may be. Reads the sources of the repository.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/source_tree.h"

namespace seam {
namespace layering_test {

namespace fs = std::filesystem;

/// Expects that below `folders` only files matching `allowed` include a header matching `included`.
void ExpectOnlyIn(const char* allowed, const std::vector<std::string>& folders,
                  const char* included) {
  const Regex door(included), may(allowed);
  std::string offenders;
  for (const Source& source : Sources(folders, {".h", ".cpp"})) {
    if (may.Matches(source.path)) continue;
    for (const std::string& name : source.includes) {
      if (door.Matches(name)) offenders += source.path + " includes " + name + "\n";
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Layering, TheSourcesAreWhereThisTestLooks) {
  ASSERT_FALSE(Root().empty()) << "run the tests inside the repository";
  EXPECT_GT(Code().size(), 50u);
  EXPECT_GT(Sources({"lcmtypes"}, {".lcm"}).size(), 10u);
  // And it can fail: these doors are open.
  EXPECT_NONFATAL_FAILURE(ExpectOnlyIn("none", kCode, "lcm/.*"), "common/record/bus.cpp");
  EXPECT_NONFATAL_FAILURE(ExpectOnlyIn("none", kCode, "seam/.*"), "common/codec/codec.cpp");
  EXPECT_NONFATAL_FAILURE(ExpectOnlyIn("none", kCode, "sys/socket\\.h"), "common/net/udp.cpp");
}

/// A room with its inner rooms, and the rooms of ours that it may include besides itself. Each may
/// use only rooms above it in the table: so there are no cycles.
struct Room {
  const char* folder;
  std::vector<std::string> may;
};

const std::vector<Room>& Rooms() {
  static const std::vector<std::string> common = {
      "common/base",   "common/net",   "common/codec",    "common/record",
      "common/scene",  "common/fleet", "common/topology", "common/physics",
      "common/stages", "common/sync",  "common/measure"};
  static const auto with = [](std::vector<std::string> more) {
    std::vector<std::string> all = common;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  static const std::vector<Room> rooms = {
      {"common/base", {}},
      {"seam", {}},  // generated from lcmtypes
      {"common/codec", {"common/base", "seam"}},
      {"common/net", {"common/base", "common/codec"}},
      {"common/fleet", {"common/base", "common/net"}},
      {"common/record", {"common/base", "common/net", "common/codec"}},
      {"common/scene", {"common/base"}},
      {"common/topology", {"common/base", "common/scene"}},
      {"common/physics", {"common/base", "common/scene", "common/topology"}},
      {"common/stages", {"common/base", "common/scene", "common/topology", "common/physics"}},
      {"common/sync",
       {"common/base", "common/net", "common/codec", "common/record", "common/scene",
        "common/topology", "common/physics", "common/stages"}},
      {"common/measure",
       {"common/base", "common/codec", "common/record", "common/scene", "common/topology",
        "common/physics", "common/stages", "common/sync"}},
      {"server", common},
      {"client", common},
      {"server/relay", with({"server", "client"})},
      {"client/embed", with({"server", "client"})},
      {"client/python", with({"server", "client", "client/embed"})},
      {"render", common},
      {"tests/support", with({"server", "client", "client/embed", "render", "tests/lab"})},
      {"tests/lab", with({"server", "client", "client/embed", "tests/support"})},
      {"tests", with({"server", "server/relay", "client", "client/embed", "render", "tests/support",
                      "tests/lab"})}};
  return rooms;
}

/// The room of a folder: the longest that it is or lies in; "" if there is none.
std::string RoomOf(const std::string& folder) {
  std::string best;
  for (const Room& room : Rooms()) {
    const std::string name = room.folder;
    const bool in = folder == name || folder.rfind(name + "/", 0) == 0;
    if (in && name.size() > best.size()) best = name;
  }
  return best;
}

std::string FolderOf(const std::string& path) {
  return fs::path(path).parent_path().generic_string();
}

/// "FILE includes INCLUDE" for each include that the table does not allow, a line each.
std::string WrongIncludes(const std::vector<Source>& sources) {
  std::string offenders;
  for (const Source& source : sources) {
    const std::string from = RoomOf(FolderOf(source.path));
    if (from.empty()) {
      offenders += source.path + ": its room is not in the table\n";
      continue;
    }
    const auto room = std::find_if(Rooms().begin(), Rooms().end(),
                                   [&](const Room& r) { return from == r.folder; });
    for (const std::string& name : source.includes) {
      const std::string to = RoomOf(FolderOf(name));
      if (to.empty() || to == from) continue;
      if (std::count(room->may.begin(), room->may.end(), to) != 0) continue;
      offenders += source.path + " includes " + name + "\n";
    }
  }
  return offenders;
}

TEST(Layering, EachRoomIncludesOnlyRoomsBelowIt) { EXPECT_EQ(WrongIncludes(Code()), ""); }

TEST(Layering, NamesTheFileAndTheIncludeThatBreakTheOrder) {
  Source source;
  source.path = "common/scene/a.cpp";
  source.includes = {"common/base/check.h", "common/physics/world.h", "vector"};
  EXPECT_EQ(WrongIncludes({source}), "common/scene/a.cpp includes common/physics/world.h\n");
  source.path = "common/newroom/a.cpp";
  EXPECT_EQ(WrongIncludes({source}), "common/newroom/a.cpp: its room is not in the table\n");
  source.path = "server/script/a.cpp";
  source.includes = {"client/client.h"};
  EXPECT_EQ(WrongIncludes({source}), "server/script/a.cpp includes client/client.h\n");
}

TEST(Layering, TheTableHasNoCycles) {
  // tests/support and tests/lab are one program's; they may use each other.
  std::vector<std::string> above;
  for (const Room& room : Rooms()) {
    for (const std::string& used : room.may) {
      if (used == "tests/lab") continue;
      EXPECT_EQ(std::count(above.begin(), above.end(), used), 1)
          << room.folder << " may use " << used << ", which stands below it";
    }
    above.emplace_back(room.folder);
  }
}

/// Folders inside a room, and the neighbours in that room that they may include; files in the room
/// itself only combine them.
TEST(Layering, InnerRoomsDoNotIncludeTheirUsers) {
  const std::vector<std::pair<const char*, const char*>> table = {
      {"common/physics/contacts", "common/physics"},
      {"common/physics/anchored", "common/physics"},
      {"common/physics/exact", "common/physics(/contacts)?"},
      {"common/physics/flight", "none"},
      {"common/physics/outline", "common/physics"},
      {"common/physics/rest", "common/physics"},
      {"common/physics/saved", "common/physics"},
      {"common/codec/packed", "common/codec"},
      {"common/sync/table", "none"},
      {"common/sync/inputs", "none"},
      {"common/sync/policy", "common/sync(/edits|/inputs)?"},
      {"common/sync/rest", "common/sync(/inputs|/reach|/table)?"},
      {"common/sync/blend", "common/sync(/inputs|/reach|/rest|/table)?"},
      {"common/sync/rollback", "common/sync(/blend|/edits|/inputs|/reach|/table)?"},
      {"common/sync/correct", "common/sync(/blend|/inputs|/reach|/rest|/rollback|/table)?"},
      {"common/sync/reach", "common/sync(/inputs|/table)?"},
      {"common/sync/edits", "none"},
      {"common/sync/audit", "none"},
      {"common/base/command", "common/base"},
      {"common/base/spatial", "common/base"},
      {"common/base/files", "none"},
      {"common/record/events", "none"},
      {"common/record/store", "common/record(/events)?"},
      {"common/record/segments", "common/record"},
      {"common/measure/around", "common/measure"},
      {"common/measure/contents", "common/measure"},
      {"common/measure/screen", "common/measure"},
      {"common/sync/show", "common/sync(/reach|/table)?"},
      {"common/sync/settings", "none"},
      {"common/stages/(bonds|bricks|character|water)", "common/stages"},
      {"client/swarm", "client(/top)?"},
      {"client/top", "none"},
      {"client/front", "none"},
      {"client/embed/seam2d", "client/embed"},
      {"server/authority", "none"},
      {"server/edits", "server/authority"},
      {"server/interest", "none"},
      {"server/sessions", "server/interest"},
      {"server/load", "server"},
      {"server/saved", "server"},
      {"server/fleet", "server(/hub|/saved)?"},
      {"server/control", "server(/edits)?"},
      {"server/hub", "server(/control|/load|/rules|/sessions|/saved)?"},
      {"server/script", "none"},
      {"server/token", "none"},
      {"server/rules", "server/script"},
      {"server/trust", "server/rules"},
      {"common/scene/joints", "common/scene(/toml)?"},
      {"common/scene/motion", "common/scene(/toml)?"},
      {"common/scene/charges", "common/scene(/toml)?"},
      {"common/scene/planner", "common/scene(/toml)?"},
      {"common/scene/crowding", "common/scene"},
      {"common/scene/lcm", "common/scene(/toml)?"},
      {"common/scene/saved", "common/scene"},
      {"common/scene/toml", "common/scene"},
      {"render/canvas", "none"},
      {"render/playback", "render/canvas"},
      {"render/draw", "render/(canvas|playback)"},
      {"render/export", "render/canvas"},
      {"render/import", "none"},
      {"render/log", "none"},
      {"render/measure", "render/playback"},
      {"render/page", "render/(canvas|draw|playback)"},
      {"render/view", "render/(canvas|page|playback)"},
      {"tests/support/allocations", "none"},
      {"tests/support/browser", "tests/support"},
      {"tests/support/mechanisms", "tests/support"},
      {"tests/support/path", "none"},
      {"tests/support/plan", "none"},
      {"tests/support/soak", "tests/support"},
      {"tests/lab/experiment", "tests/lab"},
      {"tests/lab/fairness", "tests/lab(/experiment|/report(/sessions)?)?"},
      {"common/measure/limit", "common/measure(/screen)?"},
      {"tests/lab/check", "tests/lab"},
      {"tests/lab/schema", "none"},
      {"tests/lab/chaos", "tests/lab(/experiment)?"},
      {"tests/lab/shards", "tests/lab(/experiment)?"},
      {"tests/lab/exact", "tests/lab(/experiment|/hard|/report)?"},
      {"tests/lab/gait", "tests/lab(/experiment)?"},
      {"tests/lab/agreement", "tests/lab(/experiment)?"},
      {"tests/lab/attack", "tests/lab(/experiment)?"},
      {"tests/lab/damage", "tests/lab(/experiment)?"},
      {"tests/lab/handover", "tests/lab(/experiment)?"},
      {"tests/lab/hard", "none"},
      {"tests/lab/hard/mechanisms", "tests/lab/hard"},
      {"tests/lab/report", "tests/lab(/experiment|/report/(html|joints|sessions))?"},
      {"tests/lab/report/html", "tests/lab(/experiment|/report)?"},
      {"tests/lab/report/sessions", "tests/lab(/experiment|/report)?"},
      {"tests/lab/report/joints", "tests/lab(/experiment|/report)?"},
      {"tests/lab/load", "tests/lab(/experiment)?"},
      {"tests/lab/relief", "tests/lab(/(handover|load|report|world))?"},
      {"tests/lab/replay", "tests/lab"},
      {"tests/lab/rivals", "tests/lab(/experiment|/report|/validity)?"},
      {"tests/lab/titles", "tests/lab(/experiment|/report(/sessions)?)?"},
      {"tests/lab/validity", "tests/lab"},
      {"tests/lab/world", "tests/lab(/report)?"}};
  std::string offenders;
  for (const Source& source : Code()) {
    const std::string folder = FolderOf(source.path);
    if (Regex(".*_test\\.cpp").Matches(source.path) || folder == RoomOf(folder)) continue;
    if (RoomOf(folder) == "tests") continue;  // a folder for the tests of each room
    const auto row = std::find_if(table.begin(), table.end(),
                                  [&](const auto& r) { return Regex(r.first).Matches(folder); });
    if (row == table.end()) {
      offenders += source.path + ": its folder is not in the table\n";
      continue;
    }
    for (const std::string& name : source.includes) {
      const std::string to = FolderOf(name);
      const bool foreign = to == folder || RoomOf(to) != RoomOf(folder);
      if (foreign || Regex(row->second).Matches(to)) continue;
      offenders += source.path + " includes " + name + "\n";
    }
  }
  EXPECT_EQ(offenders, "");
}

/// Folders of more than `most` of the files, with their number, a line each.
std::string LargeFolders(const std::vector<std::string>& paths, int most) {
  std::map<std::string, int> files;
  for (const std::string& path : paths) ++files[FolderOf(path)];
  std::string large;
  for (const auto& [folder, count] : files) {
    if (count > most) large += folder + ": " + std::to_string(count) + " files\n";
  }
  return large;
}

TEST(Layering, NoFolderHoldsMoreThan45Files) {
  std::vector<std::string> paths;
  for (const Source& source : Code()) paths.push_back(source.path);
  EXPECT_EQ(LargeFolders(paths, 45), "");
  EXPECT_EQ(LargeFolders({"a/1.h", "a/2.h", "b/1.h"}, 1), "a: 2 files\n");
}

TEST(Layering, EveryIncludeOfOursIsWrittenFromTheRoot) {
  const Regex quoted(R"re( *# *include *"([^"]+)".*)re");
  std::string offenders;
  for (const Source& source : Code()) {
    for (const std::string& line : source.lines) {
      const std::string name = quoted.Group(line);
      if (!name.empty() && !fs::exists(Root() / name) && name.rfind("seam/", 0) != 0) {
        offenders += source.path + ": " + line + "\n";
      }
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Layering, EachOutsideLibraryHasOneDoor) {
  ExpectOnlyIn(
      "common/(physics|stages)/.*|tests/lab/hard/raw_box2d\\.cpp|tests/physics/"
      "contact_find_test\\.cpp|tests/render/import_dump_test\\.cpp",
      kCode, "box2d/.*|Box2D/.*");
  ExpectOnlyIn("render/canvas/canvas[^/]*", kCode, "GL/.*|EGL/.*");
  ExpectOnlyIn("common/record/bus\\.cpp", kCode, "lcm/.*");
  ExpectOnlyIn("common/codec/codec[^/]*\\.cpp", kCode, "seam/[a-z_]+\\.hpp");
  ExpectOnlyIn("render/canvas/png[^/]*", kCode, "png\\.h|spng\\.h");
  ExpectOnlyIn("render/(page/gzip|canvas/png_writer)\\.cpp|tests/.*", kCode, "zlib\\.h");
  ExpectOnlyIn("common/base/compress\\.cpp|tests/.*", kCode, "zstd\\.h");
  ExpectOnlyIn("render/canvas/font[^/]*", kCode, "ft2build\\.h|freetype/.*");
  ExpectOnlyIn("common/scene/toml/toml_tree\\.cpp", kProduct, "toml\\.hpp|toml[^/]*/.*");
  ExpectOnlyIn("common/base/command/(command_line|command_table|mistake)\\.cpp", kCode, "CLI/.*");
  ExpectOnlyIn("server/script/script_lua[^/]*", kCode, "(.*/)?(lua|lauxlib|lualib)\\.h(pp)?");
  ExpectOnlyIn(
      "common/net/(keyed_hash|seal|key_exchange|connect_token)\\.cpp|common/record/"
      "keyed_chain\\.cpp",
      kCode, "sodium\\.h|sodium/.*");
  ExpectOnlyIn("common/record/store/store\\.cpp|tests/.*", kCode, "sqlite3\\.h");
  ExpectOnlyIn(
      "render/import/rube\\.cpp|common/fleet/(directory_values|etcd_store|file_store)\\.cpp", kCode,
      "nlohmann/.*");
  ExpectOnlyIn("common/fleet/http_post\\.cpp", kCode, "curl/.*");
  ExpectOnlyIn("render/import/tiled\\.cpp", kCode, "tinyxml2\\.h");
  ExpectOnlyIn("client/python/.*", kCode, "pybind11/.*");
  ExpectOnlyIn("none", kProduct, "gtest/.*");
  ExpectOnlyIn("common/net/(udp|http_)[^/]*", kProduct,
               "sys/socket\\.h|netinet/.*|arpa/.*|netdb\\.h");
}

TEST(Layering, SyncKnowsOfTheNetOnlyHowLargeItsMessagesMayBe) {
  ExpectOnlyIn("common/sync/limits\\.h", {"common/sync"}, "common/net/.*");
}

TEST(Layering, PhysicsKnowsNoClockSocketOrUnseededChance) {
  ExpectOnlyIn(
      "none", {"common/scene", "common/topology", "common/physics", "common/stages", "common/sync"},
      "chrono|ctime|time\\.h|sys/time\\.h|random|unistd\\.h|thread");
}

}  // namespace layering_test
}  // namespace seam
