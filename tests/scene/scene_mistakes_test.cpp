/// Every mistake in a scene is one line "file:line: reason".

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/scene/scene.h"

namespace seam {
namespace scene_mistakes_test {

/// Returns the error of ParseScene; "" if none.
std::string Complaint(const std::string& text) {
  try {
    ParseScene(text, "s.toml");
    return "";
  } catch (const OperatorError& e) {
    return e.what();
  }
}

/// Lines 1 to 11 of a good scene; `top` is line 1, `more` begins on line 12.
std::string Around(const std::string& top, const std::string& more) {
  return top + R"(
[[player]]
name = "ann"
[[part]]
name = "ground"
chain = [[-10, 0], [10, 0]]
[[part]]
name = "crate"
box = [1, 1]
position = [0, 2]

)" + more;
}

struct Mistake {
  const char* top;   ///< line 1
  const char* more;  ///< from line 12
  int line;          ///< which the complaint must name
  const char* says;  ///< part of the complaint
};

/// A part from line 12 with a mistake in line 14.
#define PART(line_14) "[[part]]\nname = \"p\"\n" line_14 "\n"
/// A joint from line 12 between the ground and the crate; line 16 is the mistake.
#define JOINT(kind, line_16) \
  "[[joint]]\nname = \"j\"\nkind = \"" kind "\"\na = \"ground\"\nb = \"crate\"\n" line_16 "\n"
#define BRICKS(line_14) "[[bricks]]\nname = \"b\"\n" line_14 "\n"
#define TOWERS(sizes) "towers = {count = 2, pitch = 16, " sizes "}"
/// A kinematic joint from line 12; line 16 is the mistake.
#define KINEMATIC(part, line_16) \
  "[[joint]]\nname = \"j\"\nkind = \"kinematic\"\nb = \"" part "\"\n" line_16 "\n"
#define PROPELLER(line_14) "[[propeller]]\nname = \"p\"\n" line_14 "\n"
#define THRUST(line_14) "[[thrust]]\nname = \"t\"\n" line_14 "\n"
/// A trigger from line 12; line 16 is the mistake.
#define TRIGGER(line_16) "[[trigger]]\nname = \"t\"\nposition = [1, 1]\nbox = [1, 1]\n" line_16 "\n"
#define PLAYER(line_14) "[[player]]\nname = \"bob\"\n" line_14 "\n"

const Mistake kMistakes[] = {
    // TOML itself
    {"title = ", "", 1, ""},
    {"", "[[part]\n", 12, ""},
    {"", PART("box = [1 1]"), 14, ""},
    {"", PART("box = [1, 1]\nbox = [1, 1]"), 15, ""},
    {"title = \"a\nb\"", "", 1, "closing quote"},
    {"title = [[[[[[[[[[[[[1]]]]]]]]]]]]]", "", 1, "nested too deeply"},
    {"a.b.c.d.e.f = 1", "", 1, "too many dots"},
    {"title = \"\x01\"", "", 1, "control character"},
    {"title = \"\xc3\x28\"", "", 1, "not UTF-8"},
    {"title = \"\xed\xa0\x80\"", "", 1, "not UTF-8"},
    {"title = \"\xc0\xaf\"", "", 1, "not UTF-8"},
    {"title = \"\\u001b[31m\"", "", 1, "control character"},
    // Keys and types
    {"titel = \"x\"", "", 1, "unknown key 'titel' (did you mean 'title'?)"},
    {"zzzzzzzz = 1", "", 1, "unknown key 'zzzzzzzz' (known are title"},
    {"\"\\u001b\" = 1", "", 1, "unknown key '?'"},
    {"", PART("boxx = [1, 1]"), 14, "did you mean 'box'?"},
    {"", "[solver]\nsubstep = 4\n", 13, "did you mean 'substeps'?"},
    {"title = 3", "", 1, "title must be text, not 3"},
    {"gravity = 10", "", 1, "gravity must be two numbers"},
    {"gravity = [0, \"down\"]", "", 1, "not text"},
    {"gravity = [0, -10, 0]", "", 1, "two numbers"},
    {"duration = nan", "", 1, "duration must be a number"},
    {"duration = inf", "", 1, "duration must be a number"},
    {"duration = 0", "", 1, "from 0.1 to 86400"},
    {"duration = 2020-01-01", "", 1, "not a date or time"},
    {"solver = 3", "", 1, "solver must be a table"},
    {"planner = 3", "", 1, "planner must be a table"},
    {"", "[planner]\naquire = 4\n", 13, "did you mean 'acquire'?"},
    {"", "[planner]\nkeep = 20\n", 13, "keep must be at least acquire (24)"},
    {"", "[planner]\ndwell = -1\n", 13, "from 0 to 10"},
    {"", "[planner]\ncapacity = 1.5\n", 13, "capacity must be an integer from 0 to 65535"},
    {"", "[solver]\ntick_hz = 60.0\n", 13, "tick_hz must be an integer from 10 to 960"},
    {"", "[solver]\nsubsteps = 33\n", 13, "from 1 to 32"},
    {"", "[solver]\nvelocity_iterations = 0\n", 13, "from 1 to 64"},
    {"", "[solver]\nsleep = 1\n", 13, "true or false"},
    {"", "[solver]\njoints = \"exactly\"\n", 13, "joints must be 'auto', 'exact' or 'iterative'"},
    {"", "[solver]\njoints = true\n", 13, "joints must be text"},
    {"", "[solver]\njoint_substeps = 0\n", 13, "joint_substeps must be an integer from 1 to 16"},
    {"", "[solver]\ncontacts = \"hard\"\n", 13, "contacts must be 'engine' or 'soft'"},
    {"", "[solver]\ncontact_substeps = 17\n", 13, "from 1 to 16"},
    {"part = 3", "", 4, ""},
    {"speed_limit = 121", "", 1, "from 1 to 120"},
    {"bounds = [[0, 0]]", "", 1, "bounds must be [[x, y], [x, y]]"},
    {"bounds = [[5, 5], [0, 0]]", "", 1, "lower left first"},
    {"bounds = [[-1, -1], [1, 1]]", "", 10, "outside the bounds"},
    // Scripts and triggers
    {"title = '''a'''", "", 1, "multi-line"},
    {"script = \"\"\"\nx = 1\n\"\"\"", "", 1, "code stands between ''' and '''"},
    {"script = '''\nx = 1\n", "", 1, "code without its closing '''"},
    {"script = '''\nx = 1\n''''", "", 3, "one quote too many"},
    {"script = 3", "", 1, "an array"},
    {"", "[[script]]\nname = \"s\"\n", 12, "code is missing"},
    {"", "[[script]]\nname = \"s\"\ncode = 3\n", 14, "code must be text"},
    {"", "[[script]]\nname = \"s\"\ncode = \"\\u001b\"\n", 14, "control character"},
    {"", "[[script]]\nname = \"s\"\ncode = \"\"\ninstructions = 999\n", 15, "from 1000"},
    {"", "[[script]]\nname = \"s\"\ncode = \"\"\nmemory = 70000\n", 15, "integer from 256"},
    {"", "[[script]]\nname = \"s\"\ncode = \"\"\n[[script]]\nname = \"s\"\ncode = \"\"\n", 16,
     "another script"},
    {"", "[[trigger]]\nname = \"t\"\nbox = [1, 1]\n", 12, "needs a position or a part"},
    {"", "[[trigger]]\nname = \"t\"\nposition = [1, 1]\n", 12, "box is missing"},
    {"", TRIGGER("kind = \"door\""), 16, "kind must be area"},
    {"", TRIGGER("for = \"lorry\""), 16, "there is no part 'lorry'"},
    {"", TRIGGER("players = [\"bob\"]"), 16, "there is no player 'bob'"},
    {"", TRIGGER("order = 1"), 16, "only a checkpoint has an order"},
    {"", TRIGGER("kind = \"checkpoint\""), 12, "order is missing"},
    {"", TRIGGER("kind = \"checkpoint\"\norder = 0"), 17, "from 1 to 1000"},
    {"", TRIGGER("health = 1"), 16, "only a pickup or a hazard"},
    {"", TRIGGER("kind = \"hazard\"\nhealth = -1"), 17, "from 0"},
    {"", TRIGGER("kind = \"pickup\"\nonce = false"), 17, "a pickup is taken once"},
    {"", TRIGGER("# nobody has a vehicle"), 12, "nobody can enter"},
    {"", TRIGGER("part = \"crate\"\nfor = \"crate\""), 17, "its own trigger"},
    {"", TRIGGER("for = \"crate\"") TRIGGER("for = \"crate\""), 18, "another trigger"},
    {"", PART("box = [1, 1]\nhealth = -1"), 15, "health must be a number from 0"},
    {"", PART("box = [1, 1]\ndamage = {above = 1}"), 15, "damage needs health"},
    {"", PART("box = [1, 1]\nhealth = 1\ndamage = {abov = 1}"), 16, "did you mean 'above'?"},
    {"", PART("box = [1, 1]\npermissions = {take = [\"bob\"]}"), 15, "there is no player 'bob'"},
    {"", PART("box = [1, 1]\nowner = \"ann\"\npermissions = {push = []}"), 12, "may not push it"},
    {"",
     PART("box = [1, 1]\npermissions = {drive = []}") "[[joint]]\nname = \"j\"\nkind = "
                                                      "\"revolute\"\na = \"ground\"\nb = \"p\"\n"
                                                      "motor = {player = \"ann\", speed = 1, "
                                                      "torque = 1}\n",
     16, "may not drive 'p'"},
    // Parts
    {"", "[[part]]\nbox = [1, 1]\n", 12, "name is missing"},
    {"", "[[part]]\nname = \"a.b\"\nbox = [1, 1]\n", 13, "letters, digits"},
    {"", "[[part]]\nname = \"\"\nbox = [1, 1]\n", 13, "letters, digits"},
    {"", "[[part]]\nname = \"crate\"\nbox = [1, 1]\n", 13, "another part of this name"},
    {"", PART("position = [0, 0]"), 12, "exactly one of box"},
    {"", PART("box = [1, 1]\ncircle = 1"), 12, "exactly one of box"},
    {"", PART("box = [0, 1]"), 14, "box must be a number from 0.05 to 10, not 0"},
    {"", PART("box = [-1, 1]"), 14, "not -1"},
    {"", PART("box = [0.049, 1]"), 14, "from 0.05"},
    {"", PART("box = [11, 1]"), 14, "to 10"},
    {"size_max = 20", PART("box = [21, 1]"), 14, "to 20"},
    {"size_max = 1e9", "", 1, "to 1000"},
    {"", PART("circle = nan"), 14, "circle must be a number from 0.025 to 5, not nan"},
    {"", PART("circle = -0.5"), 14, "not -0.5"},
    {"", PART("box = [1, 1]\nposition = [0, inf]"), 15, "not inf"},
    {"", PART("box = [1, 1]\nposition = [0, 1e9]"), 15, "to 30000"},
    {"", PART("box = [1, 1]\ndensity = 0"), 15, "density must be a number from 0.01 to 100"},
    {"", PART("box = [1, 1]\nfriction = 1.1"), 15, "from 0 to 1"},
    {"", PART("box = [1, 1]\nrestitution = -0.1"), 15, "from 0 to 1"},
    {"", PART("box = [1, 1]\nspin = 95"), 15, "from -94 to 94"},
    {"", PART("box = [1, 1]\nvelocity = [100, 100]"), 15, "above the speed_limit"},
    {"", PART("box = [1, 1]\nanchored = true\nspin = 1"), 12, "cannot have velocity or spin"},
    {"", PART("box = [1, 1]\nanchored = true\nowner = \"ann\""), 16, "cannot have an owner"},
    {"", PART("box = [1, 1]\nanchored = true\ngravity_scale = 0"), 16, "has no gravity_scale"},
    {"", PART("box = [1, 1]\ncategory = 65536"), 15, "category"},
    {"", PART("box = [1, 1]\nowner = \"bob\""), 15, "there is no player 'bob'"},
    {"", PART("box = [1, 1]\nowners = [\"ann\"]\nowner = \"ann\""), 12, "both owner and owners"},
    {"", PART("box = [1, 1]\nowners = []"), 15, "owners is empty"},
    {"", PART("box = [1, 1]\nowners = [\"ann\", \"ann\"]"), 15, "need repeat"},
    {"", PART("box = [1, 1]\nrepeat = {count = 0, step = [1, 1]}"), 15, "from 1"},
    {"", PART("box = [1, 1]\nrepeat = {count = [2, 1.5], step = [1, 1]}"), 15, "integers"},
    {"", PART("box = [1, 1]\nrepeat = {count = 2}"), 15, "step is missing"},
    {"", PART("box = [1, 1]\nrepeat = {count = 65535, step = [0, 0]}"), 12, "at most 65535 parts"},
    // Polygons and chains
    {"", PART("polygon = [[0, 0], [1, 0]]"), 14, "3 to 64 points"},
    {"", PART("polygon = [[0,0],[1,0],[2,0],[3,0],[4,0],[4,1],[3,1],[2,1],[1,1]]"), 14,
     "not convex"},
    {"", PART("capsule = [1, 0.02]"), 14, "the radius at least 0.025 m"},
    {"", PART("capsule = [9, 1]"), 14, "the whole at most 10 m long"},
    {"", PART("capsule = [0, 1]"), 14, "capsule must be a number from 0.02 to 10, not 0"},
    {"", PART("wedge = [1, -1]"), 14, "a wedge's height must be positive"},
    {"", PART("wedge = [0.01, 1]"), 14, "closer than 0.02 m"},
    {"", PART("segment = [[0, 0], [1, 0], [2, 0]]"), 14, "more than 2 points"},
    {"", PART("segment = [[0, 0]]"), 14, "a segment has 2 points"},
    {"", PART("segment = [[0, 0], [0.01, 0]]"), 14, "points 1 and 2 are closer"},
    {"", PART("polygon = [[0, 0], [2, 0], [1, 0.2], [1, 2]]"), 14, "not convex"},
    {"", PART("polygon = [[0, 0], [1, 0], [2, 0], [1, 2]]"), 14, "not convex"},
    {"", PART("polygon = [[0, 2], [1, -2], [-2, 1], [2, 1], [-1, -2]]"), 14, "not convex"},
    {"", PART("polygon = [[0, 0], [1, 0], [1, 0.01], [0, 1]]"), 14, "closer than 0.02 m"},
    {"", PART("polygon = [[0, 0], [0, 0], [1, 1]]"), 14, "closer than 0.02 m"},
    {"", PART("polygon = [[0, 0], [1, 0], [2, 0]]"), 14, "width and height"},
    {"", PART("polygon = [[0, 0], [1, 1], [2, 2.0001]]"), 14, "area must be at least 0.001"},
    {"", PART("polygon = [[0, 0], [1, nan], [0, 1]]"), 14, "not nan"},
    {"", PART("chain = [[0, 0]]"), 14, "2 points or more"},
    {"", PART("chain = [[0, 0], [0.005, 0], [1, 0]]"), 14, "points 1 and 2 are closer"},
    // Joints
    {"", "[[joint]]\nkind = \"weld\"\n", 12, "name is missing"},
    {"", JOINT("string", ""), 14, "kind must be one of weld, glue, hinge, revolute"},
    {"", "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"crate\"\nb = \"nobody\"\n", 16,
     "there is no part 'nobody'"},
    {"", "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"crate\"\n", 12, "b is missing"},
    {"", "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"crate\"\nb = \"crate\"\n", 12,
     "a part with itself"},
    {"", JOINT("revolute", "limits = [1, 0.5]"), 17, "lower limit is above"},
    {"", JOINT("revolute", "axis = [1, 0]"), 17, "a revolute joint has no axis"},
    {"", JOINT("wheel", "axis = [0, 0]"), 17, "too short"},
    {"", JOINT("wheel", "frequency = 61"), 17, "from 0 to 60"},
    {"", JOINT("wheel", "damping_ratio = -1"), 17, "from 0 to 10"},
    {"", JOINT("wheel", "motor = {speed = 1}"), 17, "torque is missing"},
    {"", JOINT("wheel", "motor = {speed = 1, torque = 0}"), 17, "torque must be"},
    {"", JOINT("wheel", "motor = {player = \"eve\", speed = 1, torque = 1}"), 17,
     "no player 'eve'"},
    {"", JOINT("weld", "motor = {speed = 1, torque = 1}"), 17, "a weld joint has no motor"},
    {"", JOINT("distance", "anchor_a = [0, 2]"), 12, "give it a length"},
    {"", JOINT("distance", "length = 0"), 17, "length must be"},
    {"", JOINT("revolute", "") JOINT("revolute", ""), 19, "another joint of this name"},
    {"",
     PART("box = [1, 1]\nanchored = true") "[[joint]]\nname = \"j\"\nkind = \"revolute\"\n"
                                           "a = \"ground\"\nb = \"p\"\n",
     16, "both its parts are anchored"},
    {"",
     PART(
         "box = [1, 1]") "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"crate\"\nb = \"p\"\n"
                         "[[joint]]\nname = \"j\"\nkind = \"revolute\"\na = \"crate\"\nb = \"p\"\n",
     20, "its parts are welded together"},
    {"",
     PART("box = [1, 1]\nvelocity = [1, 0]") "[[joint]]\nname = \"w\"\nkind = \"weld\"\n"
                                             "a = \"crate\"\nb = \"p\"\n",
     12, "another velocity"},
    {"bounds = [[-2000, -10], [2000, 10]]",
     PART("circle = 0.1\nposition = [1500, 0]") "[[joint]]\nname = \"w\"\nkind = \"weld\"\n"
                                                "a = \"crate\"\nb = \"p\"\n",
     12, "over more than 1000 m"},
    {"", JOINT("prismatic", "motor = {speed = 1, torque = 1}"), 17, "unknown key 'torque'"},
    {"", JOINT("prismatic", "motor = {speed = 1, force = 1, axis = \"lift\"}"), 17,
     "an axis needs a player"},
    {"", JOINT("hinge", "motor = {player = \"ann\", axis = \"up\", speed = 1, torque = 1}"), 17,
     "axis must be 'drive' or 'lift'"},
    {"", JOINT("hinge", "limits = [-200, 0]"), 17, "from -100 to 100"},
    {"", JOINT("distance", "limits = [0, 2]"), 17, "from 0.02 to 10000"},
    {"", JOINT("rope", "frequency = 2"), 17, "a rope joint has no frequency"},
    {"", JOINT("weld", "collide = true"), 17, "a rigid weld joint has no collide"},
    {"", JOINT("weld", "strength = 3"), 17, "a weld joint has no strength"},
    {"", JOINT("glue", "strength = -1"), 17, "strength must be a number from 0 to"},
    {"", JOINT("glue", "frequency = 1"), 17, "a glue joint has no frequency"},
    {"", JOINT("motor", "force = 5"), 12, "torque is missing"},
    {"", JOINT("motor", "force = -5\ntorque = 1"), 17, "force must be a number from 0"},
    {"", JOINT("motor", "force = 5\ntorque = 1\nfollow = {reach = [0, 1]}"), 19,
     "player is missing"},
    {"", JOINT("kinematic", "turning = 1"), 15, "a kinematic joint has no a"},
    {"", KINEMATIC("crate", "turning = 1"), 12, "'crate' is not anchored"},
    {"", KINEMATIC("ground", ""), 12, "needs a path or a turning"},
    {"", KINEMATIC("ground", "turning = 95"), 16, "from -94 to 94"},
    {"", KINEMATIC("ground", "turning = 1\nperiod = 1"), 17, "a period needs a path"},
    {"", KINEMATIC("ground", "path = [[0, 0], [1, 0]]"), 12, "period is missing"},
    {"", KINEMATIC("ground", "path = [[1, 0], [1, 0]]\nperiod = 1"), 16, "leads nowhere"},
    {"", KINEMATIC("ground", "path = [[0, 0], [90, 0]]\nperiod = 1"), 17,
     "at 180 m/s, beyond the speed_limit"},
    {"",
     KINEMATIC("ground", "turning = 1") "[[joint]]\nname = \"l\"\nkind = \"kinematic\"\n"
                                        "b = \"ground\"\nturning = 1\n",
     12, "'l' moves the same assembly"},
    // Conveyors and thrust
    {"", PART("box = [1, 1]\nconveyor = 101"), 15, "conveyor must be a number from -100 to 100"},
    {"", PART("box = [1, 1]\nconveyor = {player = \"ann\"}"), 15, "speed is missing"},
    {"", PART("box = [1, 1]\nconveyor = true"), 15, "conveyor must be a number"},
    {"", THRUST("part = \"crate\""), 12, "force is missing"},
    {"", THRUST("part = \"nobody\"\nforce = [1, 0]"), 14, "there is no part 'nobody'"},
    {"", THRUST("part = \"ground\"\nforce = [1, 0]"), 12, "'ground' is anchored"},
    {"", THRUST("part = \"crate\"\nforce = [1e7, 0]"), 15, "from -1000000 to 1000000"},
    {"", THRUST("part = \"crate\"\nforce = [1, 0]\nbutton = 0"), 16, "a button needs a player"},
    {"", THRUST("part = \"crate\"\nforce = [1, 0]\nplayer = \"ann\"\nbutton = 15"), 17, "to 14"},
    {"",
     THRUST("part = \"crate\"\nforce = [1, 0]\nplayer = \"ann\"\naxis = \"lift\"\n"
            "button = 1"),
     18, "both axis and button"},
    {"", THRUST("part = \"crate\"\nforce = [1, 0]") THRUST("part = \"crate\"\nforce = [1, 0]"), 17,
     "another thrust of this name"},
    {"", PROPELLER("part = \"crate\"\npitch = 1\nturns = 1"), 12, "diameter is missing"},
    {"", PROPELLER("part = \"ground\"\ndiameter = 1\npitch = 1\nturns = 1"), 12, "is anchored"},
    {"", PROPELLER("part = \"crate\"\ndiameter = 1\npitch = 0\nturns = 1"), 16, "pitch must be"},
    {"", PROPELLER("part = \"crate\"\nalong = [0, 0]"), 15, "along must be a direction"},
    // Players
    {"", "[[player]]\n", 12, "name is missing"},
    {"", "[[player]]\nname = \"ann\"\n", 13, "another player of this name"},
    {"", "[[player]]\nname = \"a b\"\n", 13, "letters, digits"},
    {"", PLAYER("vehicle = \"tank\""), 14, "there is no part 'tank'"},
    {"", PLAYER("vehicle = \"ground\""), 12, "the vehicle 'ground' is anchored"},
    {"", PLAYER("region = [[0, 0]]"), 14, "region must be two corners"},
    {"", PLAYER("region = [[0, 0], [-1, 1]]"), 14, "region must be two corners"},
    {"", PLAYER("actions = [{button = 15, part = \"crate\", impulse = [1, 0]}]"), 14, "0 to 14"},
    {"", PLAYER("actions = [{button = 0, part = \"crate\"}]"), 14, "impulse is missing"},
    {"", PLAYER("actions = [{button = 0, part = \"ground\", impulse = [1, 0]}]"), 14, "anchored"},
    {"", PLAYER("actions = [{button = 0, part = \"crate\", impulse = [1000, 0]}]"), 14,
     "speed_limit"},
    {"", PLAYER("script = [[0, {drive = 2}]]"), 14, "drive must be a number from -1 to 1"},
    {"", PLAYER("script = [[0, {drve = 1}]]"), 14, "did you mean 'drive'?"},
    {"", PLAYER("script = [[0, {buttons = [15]}]]"), 14, "from 0 to 14"},
    {"", PLAYER("script = [[-1, {}]]"), 14, "seconds from 0"},
    {"", PLAYER("script = [[nan, {}]]"), 14, "seconds from 0"},
    {"", PLAYER("script = [[1, {}], [1.001, {}]]"), 14, "must ascend"},
    {"", PLAYER("script = [[1, {}],\n[0.5, {}]]"), 15, "must ascend"},
    {"", PLAYER("script = [1]"), 14, "each entry must be"},
    // The rest
    {"", "[[watch]]\n", 12, "one part or more"},
    {"", "[[watch]]\nstruck = \"nobody\"\n", 13, "there is no part 'nobody'"},
    {"", "[[watch]]\nstruck = \"ground\"\n", 12, "anchored"},
    {"", "[camera]\nmin = [0, 0]\nmax = [0, 0]\n", 12, "right of and above"},
    {"", "[camera]\nfollow = \"nobody\"\n", 13, "there is no part 'nobody'"},
    // Bricks
    {"", BRICKS("size = [1, 1]"), 14, "unknown key 'size'"},
    {"", BRICKS("brick = [1]"), 14, "brick must be two numbers"},
    {"", BRICKS("brick = [1, 5]"), 14, "from 0.1 to 4"},
    {"", BRICKS("brick = [0.52, 0.25]"), 14, "steps of 0.05 m"},
    {"", BRICKS("brick = [0.5, 0.25]"), 12, "exactly one of count and towers"},
    {"", BRICKS("count = [1, 1]\nbrick = [1, 1]\ntowers = {}"), 12, "exactly one of count"},
    {"", BRICKS("count = [1.5, 1]\nbrick = [1, 1]"), 14, "count must be integers"},
    {"", BRICKS("count = [2000, 1001]\nbrick = [1, 1]"), 12, "at most 2000000 bricks"},
    {"", BRICKS("position = [29999, 0]\nbrick = [1, 1]\ncount = [2, 1]"), 12, "beyond 30 km"},
    {"", BRICKS("position = [0.01, 0]\nbrick = [1, 1]\ncount = [2, 1]"), 14, "steps of 0.05"},
    {"", BRICKS("strength = -1\nbrick = [1, 1]\ncount = [2, 1]"), 14, "from 0 to 1000"},
    {"", BRICKS("featherweight = false\nbrick = [1, 1]\ncount = [260, 260]"), 14, "65535 parts"},
    {"", BRICKS("brick = [1, 1]\ncount = [2, 1]") BRICKS("brick = [1, 1]\ncount = [2, 1]"), 17,
     "other bricks of this name"},
    {"", BRICKS("brick = [1, 1]\n" TOWERS("width = [9, 8], height = [1, 2]")), 15,
     "least is above"},
    {"", BRICKS("brick = [1, 1]\n" TOWERS("width = [8, 19], height = [1, 2]")), 15, "wider than"},
    {"", BRICKS("brick = [1, 1]\n" TOWERS("width = [8, 9]")), 15, "height"},
};

TEST(SceneMistakes, NameFileLineAndReason) {
  for (const Mistake& m : kMistakes) {
    const std::string got = Complaint(Around(m.top, m.more));
    SCOPED_TRACE("in " + std::string(m.top) + "\n" + m.more);
    EXPECT_NE(got, "");
    EXPECT_EQ(got.find('\n'), std::string::npos) << got;
    EXPECT_EQ(got.substr(0, got.find(": ")), "s.toml:" + std::to_string(m.line)) << got;
    EXPECT_NE(got.find(m.says), std::string::npos) << got;
  }
  EXPECT_EQ(Complaint(Around("", "")), "");  // what they are all built on is good
}

}  // namespace scene_mistakes_test
}  // namespace seam
