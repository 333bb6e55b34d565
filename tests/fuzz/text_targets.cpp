#include <string>

#include "common/base/check.h"
#include "common/physics/world.h"
#include "tests/fuzz/targets.h"
#include "tests/support/lone_room.h"

namespace seam {
namespace {

Bytes BytesOf(const std::string& text) { return Bytes(text.begin(), text.end()); }
std::string TextOf(ByteView bytes) { return {bytes.data, bytes.data + bytes.size}; }

/// A room with all that a script can touch.
constexpr const char* kRoom = R"([[player]]
name = "ann"
vehicle = "car"
[[part]]
name = "ground"
chain = [[-30, 0], [30, 0]]
[[part]]
name = "car"
box = [2, 0.5]
position = [0, 1]
owner = "ann"
[[part]]
name = "ball"
circle = 0.5
position = [4, 2]
[[trigger]]
name = "gate"
kind = "area"
position = [3, 1]
box = [2, 2]
score = 1
[[script]]
name = "s"
code = '''
)";

}  // namespace

void TakeScene(ByteView bytes) {
  if (bytes.size > 8192) return;  // longer ones are slow, and no different
  try {
    const Scene scene = ParseScene(TextOf(bytes), "fuzz.toml");
    World world(scene);
    if (world.body_count() > 300) return;
    for (int i = 0; i < 20; ++i) world.Step();
    for (int body = 0; body < world.body_count(); ++body) {
      if (!world.Read(body).position.allFinite()) std::abort();
    }
    Hole(scene.gravity.y() > 0 && world.body_count() > 1);
  } catch (const OperatorError& error) {
    const std::string what = error.what();
    if (what.rfind("fuzz.toml:", 0) != 0) std::abort();
    if (what.find_first_of("\n\r\x1b") != std::string::npos) std::abort();
  }
}

std::vector<Bytes> SceneSeeds() {
  std::vector<Bytes> seeds;
  for (const char* text :
       {"gravity = [0, -10]\n[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 2]\n[[part]]\n"
        "name = \"g\"\nchain = [[-9, 0], [9, 0]]\n",
        "[[part]]\nname = \"a\"\ncircle = 0.5\nposition = [0, 2]\nrepeat = {count = [3, 2], step = "
        "[1.1, 1.1]}\n[[joint]]\nkind = \"hinge\"\na = \"a.0\"\nb = \"a.1\"\nat = [0.5, 2]\n",
        "[solver]\nsubsteps = 2\njoints = \"exact\"\ncontacts = \"soft\"\n[[part]]\nname = \"a\"\n"
        "polygon = [[0, 0], [1, 0], [0, 1]]\nvelocity = [3, 1]\nspin = 2\n[[water]]\nfrom = [-5, "
        "-5]\nto = [5, 0]\n",
        "[[player]]\nname = \"ann\"\nregion = [[-9, -9], [0, 9]]\n[[part]]\nname = \"a\"\ncapsule "
        "= {from = [0, 0], to = [1, 0], radius = 0.2}\nowner = \"ann\"\n"}) {
    seeds.push_back(BytesOf(text));
  }
  return seeds;
}

void TakeScript(ByteView bytes) {
  const std::string code = TextOf(bytes);
  if (code.size() > 4096 || code.find("'''") != std::string::npos) return;
  try {
    LoneRoom room(ParseScene(kRoom + code + "\n'''\n", "fuzz.toml"));
    for (int i = 0; i < 30; ++i) room.Step();
    Hole(room.server->left_bounds() > 0);
    const Bytes saved = room.Save();
    const LoneRoom loaded(saved, "buffer");
    if (loaded.server == nullptr) std::abort();  // what was saved can be loaded
  } catch (const OperatorError&) {
  }
}

std::vector<Bytes> ScriptSeeds() {
  std::vector<Bytes> seeds;
  for (const char* text :
       {"function on_tick(t) room.n = (room.n or 0) + 1 world.say(room.n) end",
        "function on_start() world.add_part{name = 'a', circle = 0.3, position = {1, 5}} end",
        "function on_touch(a, b) world.push(b, 10, 20) world.score('ann', 1) end",
        "function on_tick() local x, y = world.position('ball') world.set('ball', {position = {x, "
        "y + 1}, velocity = {1, 2}}) end",
        "room = {a = {b = 1, c = 'x'}, 2, 3}\nfunction on_trigger(t, p, e) world.remove(p) end",
        "for i = 1, 100 do string.rep('a', i) end local t = {} t[t] = t setmetatable(t, {})"}) {
    seeds.push_back(BytesOf(text));
  }
  return seeds;
}

}  // namespace seam
