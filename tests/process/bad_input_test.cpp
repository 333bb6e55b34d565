/// Mistakes of the operator, in all programs: each is one line on stderr that begins with the
/// program's name, nothing on stdout, exit status 2, and nothing written.

#include "tests/support/operator_mistakes.h"

namespace seam {
namespace bad_input_test {

TEST_F(BadInput, ScenesAreRefusedByFileAndLine) {
  std::vector<Mistake> mistakes = {ServerMistake({"missing.toml"}, "missing.toml: no such"),
                                   ServerMistake({"folder"}, "no scene \"folder\""),
                                   ServerMistake({"two\nlines.toml"}, "two?lines.toml"),
                                   ServerMistake({"good.lcm"}, "good.lcm"),
                                   ServerMistake({}, "which scene?")};
  for (const BadScene& scene : BadScenes()) {
    mistakes.push_back(ServerMistake({scene.name, "--record", "new.lcm"}, scene.says));
  }
  Judge(mistakes);
}

TEST_F(BadInput, TheServerRefusesWrongFlags) {
  UdpNet taken(Address{0x7f000001, 0});
  const std::string port = std::to_string(taken.local().port);
  const auto flags = [](Words words, const std::string& says) {
    words.insert(words.begin(), "crossing.toml");
    if (std::count(words.begin(), words.end(), "--bind") == 0 &&
        std::count(words.begin(), words.end(), "--port") == 0) {
      words.insert(words.end(), {"--bind", "127.0.0.1:0"});
    }
    return ServerMistake(std::move(words), says);
  };
  Judge(
      {flags({"--nonsense"}, "--nonsense"),
       flags({"second.toml"}, "second.toml"),
       flags({"--port"}, "--port"),
       flags({"--port", "0"}, "--port"),
       flags({"--port", "65536"}, "--port"),
       flags({"--port", "-1"}, "--port"),
       flags({"--port", "http"}, "--port"),
       flags({"--port", "80x"}, "--port"),
       flags({"--bind", "127.0.0.1", "--port", port, "--record", "new.lcm"}, "in use"),
       flags({"--bind", "192.0.2.1"}, "192.0.2.1"),
       flags({"--bind", ""}, "--bind: has an empty value"),
       flags({"--bind", "::1x"}, "::1x"),
       flags({"--mode", "magic"}, "unknown mode \"magic\""),
       flags({"--mode", ""}, "--mode: has an empty value"),
       flags({"--reconcile", "magic"}, "unknown reconciler \"magic\""),
       flags({"--mode", "strict", "--reconcile", "snap"}, "belongs to --mode buffer"),
       flags({"--mode", "central", "--reconcile", "fade"}, "belongs to --mode buffer"),
       flags({"--mode", "oracle", "--reconcile", "magic"}, "--mode"),
       flags({"--predict", "all"}, "--predict belongs to --mode central, not to --mode buffer"),
       flags({"--mode", "strict", "--predict", "own"}, "--predict belongs to --mode central"),
       flags({"--mode", "central", "--predict", "some"}, "unknown prediction \"some\""),
       flags({"--input-delay", "13"}, "--input-delay"),
       flags({"--input-delay", "-1"}, "--input-delay"),
       flags({"--input-delay", "1.5"}, "--input-delay"),
       flags({"--impair", "magic"}, "no network profile \"magic\""),
       flags({"--impair", ""}, "--impair: has an empty value"),
       flags({"--impair", "loss=200%"}, "loss=200%"),
       flags({"--impair", "delay=nan"}, "delay=nan"),
       flags({"--impair", "delay=50ms,"}, "impairment"),
       flags({"--room", "two words"}, "--room"),
       flags({"--room", ""}, "--room: has an empty value"),
       flags({"--room", "a.b"}, "--room"),
       flags({"--room", std::string(33, 'r')}, "--room"),
       flags({"--room", std::string(32, 'r'), "--rooms", "2"}, "--room"),
       flags({"--rooms", "0"}, "--rooms"),
       flags({"--rooms", "5000"}, "--rooms"),
       flags({"--workers", "2"}, "--workers: one room has one thread"),
       flags({"--rooms", "2", "--workers", "0"}, "--workers"),
       flags({"--metrics", "0"}, "--metrics"),
       flags({"--metrics", "http"}, "--metrics"),
       flags({"--metrics-rooms", "worst:5"}, "--metrics-bind and --metrics-rooms are for"),
       flags({"--metrics", "9474", "--metrics-rooms", "best"}, "--metrics-rooms takes"),
       flags({"--metrics", "9474", "--metrics-bind", "moon"}, "moon port 9474"),
       flags({"--bus-rooms", "some"}, "--bus-rooms"),
       flags({"--wait", "3"}, "--wait 3"),
       flags({"--wait", "-1"}, "--wait"),
       flags({"--send-hz", "0"}, "--send-hz"),
       flags({"--budget", "64kX"}, "--budget"),
       flags({"--budget", "-3"}, "--budget"),
       flags({"--publish", "some"}, "--publish"),
       flags({"--seed", "-1"}, "--seed"),
       flags({"--seed", "1.5"}, "--seed"),
       flags({"--duration", "-1"}, "--duration"),
       flags({"--duration", "nan"}, "--duration"),
       flags({"--duration", "inf"}, "--duration"),
       flags({"--duration", "soon"}, "--duration"),
       flags({"--record", "words.lcm"}, "words.lcm: exists"),
       flags({"--record", "folder"}, "folder: exists"),
       flags({"--record", "folder", "--force"}, "folder: is a folder"),
       flags({"--record", "no/such.lcm"}, "no/such.lcm: cannot be created"),
       flags({"--record", "words.lcm/x.lcm"}, "words.lcm/x.lcm: cannot be created"),
       flags({"--record", "words.lcm", "--force", "--bind", "127.0.0.1", "--port", port}, "in use"),
       flags({"--lcm-url", "magic"}, "LCM url \"magic")});
}

TEST_F(BadInput, TheClientRefusesWrongFlags) {
  const std::string nobody = "127.0.0.1:9";  // the discard port: nobody answers
  const auto flags = [&](Words words, const std::string& says) {
    words.insert(words.begin(), {nobody, "--join-timeout", "0.5"});
    return ClientMistake(std::move(words), says);
  };
  Judge({ClientMistake({}, "which server?"),
         ClientMistake({"127.0.0.1:0"}, "port 0"),
         ClientMistake({"127.0.0.1:65536"}, "65536"),
         ClientMistake({"127.0.0.1:"}, "port"),
         ClientMistake({"127.0.0.1:7777:1"}, "host:port"),
         ClientMistake({"300.1.1.1"}, "300.1.1.1"),
         ClientMistake({":7777"}, "host"),
         ClientMistake({"no.such.host.invalid"}, "no.such.host.invalid"),
         ClientMistake({nobody, "--join-timeout", "0"}, "--join-timeout"),
         ClientMistake({nobody, "--join-timeout", "nan"}, "--join-timeout"),
         flags({"--nonsense"}, "--nonsense"),
         flags({"more"}, "more"),
         flags({"--name", "two words"}, "--name"),
         flags({"--name", ""}, "--name: has an empty value"),
         flags({"--name", std::string(33, 'n')}, "--name"),
         flags({"--name", "m\xc3\xbc"}, "--name"),
         flags({"--room", "a.b"}, "--room"),
         flags({"--smooth", "maybe"}, "--smooth"),
         flags({"--impair", "magic"}, "no network profile \"magic\""),
         flags({"--duration", "nan"}, "--duration"),
         flags({"--duration", "-1"}, "--duration"),
         flags({"--drive", "keyboard"}, "--drive keyboard needs a terminal"),
         flags({"--record", "words.lcm"}, "words.lcm: exists"),
         flags({"--record", "no/such.lcm"}, "no/such.lcm: cannot be created"),
         flags({"--lcm-url", "magic"}, "LCM url \"magic"),
         flags({}, "no answer from 127.0.0.1:9; gave up after 0.5 s"),
         flags({"--record", "new.lcm"}, "no answer from"),
         flags({"--record", "words.lcm", "--force"}, "no answer from")});
}

TEST_F(BadInput, TheSwarmAndTopRefuseWrongFlags) {
  const auto swarm = [](Words words, const std::string& says) {
    words.insert(words.begin(), {"seam-swarm", "127.0.0.1:9"});
    return Mistake{words, says};
  };
  Judge({{{"seam-swarm"}, "which server?"},
         {{"seam-swarm", "127.0.0.1:65536"}, "65536"},
         swarm({"--nonsense"}, "--nonsense"),
         swarm({"--clients", "0"}, "--clients"),
         swarm({"--drive", "keyboard"}, "--drive"),
         swarm({"--for", "soon"}, "--for takes a time"),
         swarm({"--for", "0s"}, "--for takes a time"),
         swarm({"--for", "nan"}, "--for takes a time"),
         swarm({"--threads", "0"}, "--threads"),
         swarm({"--room", "a.b"}, "--room"),
         swarm({"--rooms", "0"}, "--rooms"),
         swarm({"--metrics", "127.0.0.1:65536"}, "65536"),
         swarm({"--lcm-url", "magic"}, "LCM url \"magic"),
         {{"seam-top", "127.0.0.1:65536"}, "65536"},
         {{"seam-top", "--lcm-url", "magic"}, "LCM url \"magic"},
         {{"seam-top", "--times", "-1"}, "--times"}});
}

TEST_F(BadInput, TheMeasuresRefuseWrongLogsAndFlags) {
  Judge({Measure({}, "which log?"),
         Measure({"--nonsense"}, "--nonsense"),
         Measure({"good.lcm", "--nonsense"}, "--nonsense"),
         Measure({"missing.lcm"}, "missing.lcm: "),
         Measure({"nothing.lcm"}, "not an LCM log"),
         Measure({"words.lcm"}, "not an LCM log"),
         Measure({"folder"}, "folder: "),
         Measure({"crossing.toml"}, "not an LCM log"),
         Measure({"roomless.lcm"}, "no Seam2D room"),
         Measure({"sceneless.lcm"}, "bad"),
         Measure({"good.lcm", "missing.lcm"}, "missing.lcm"),
         Measure({"good.lcm", "missing.lcm", "--csv", "new.csv"}, "missing.lcm"),
         Measure({"good.lcm", "--oracle", "missing.lcm"}, "missing.lcm"),
         Measure({"good.lcm", "--oracle", "good.lcm"}, "--mode oracle"),
         Measure({"good.lcm", "--oracle", "stack.lcm", "--csv", "new.csv"}, "scene"),
         Measure({"good.lcm", "--csv", "no/such.csv"}, "no/such.csv"),
         Measure({"good.lcm", "--csv", "folder"}, "folder"),
         Measure({"good.lcm", "--csv", "other.csv"}, "other.csv"),
         Measure({"good.lcm", "--csv", "other.csv", "--append"}, "other columns"),
         Measure({"--csv", "good.lcm", "stack.lcm"}, "good.lcm: exists"),
         Measure({"good.lcm", "--append"}, "--csv"),
         Measure({"good.lcm", "--names", "one,two"}, "--names")});
}

TEST_F(BadInput, TheRendererRefusesWrongLogsAndFlags) {
  const auto good = [](Words words, const std::string& says) {
    words.insert(words.begin(), {"good.lcm", "-o", "new", "--size", "320x240"});
    return Render(std::move(words), says);
  };
  const auto log = [](const std::string& path, const std::string& says) {
    return Render({path, "-o", "new"}, says);
  };
  Judge({Render({}, "-o"),
         Render({"good.lcm"}, "-o"),
         Render({"-o", "new"}, "no log"),
         good({"--nonsense"}, "--nonsense"),
         log("missing.lcm", "missing.lcm: "),
         log("nothing.lcm", "not an LCM log"),
         log("words.lcm", "not an LCM log"),
         log("folder", "folder: "),
         log("roomless.lcm", "no Seam2D room"),
         log("viewless.lcm", "no views"),
         log("sceneless.lcm", "bad"),
         Render({"good.lcm", "-o", "words.lcm"}, "not a folder"),
         Render({"good.lcm", "-o", "words.lcm/new"}, "words.lcm/new"),
         Render({"good.lcm", "-o", "pictures"}, "holds files"),
         Render({"good.lcm", "stack.lcm", "-o", "new"}, "--compare"),
         good({"--oracle", "missing.lcm"}, "missing.lcm"),
         good({"--oracle", "good.lcm"}, "no oracle"),
         good({"--oracle", "stack.lcm"}, "not the one of stack.lcm"),
         good({"--fps", "0"}, "--fps"),
         good({"--fps", "many"}, "--fps"),
         good({"--size", "1x1"}, "--size"),
         good({"--view", "7"}, "--view 7"),
         good({"--view", "-1"}, "--view"),
         good({"--from", "5"}, "--from"),
         good({"--from", "0.2", "--to", "0.1"}, "--from"),
         good({"--threads", "-1"}, "--threads"),
         good({"--seconds", "nan"}, "--seconds"),
         good({"--room", "other"}, "no room \"other\""),
         good({"--fonts", "folder"}, "no font"),
         good({"--every", "2"}, "--every"),
         Render({"--strobe", "good.lcm", "-o", "new"}, ".png"),
         Render({"--strobe", "good.lcm", "-o", "no/new.png"}, "no such folder"),
         Render({"--strobe", "good.lcm", "-o", "new.png", "--view", "all"}, "--view all"),
         Render({"--live", "good.lcm", "-o", "new"}, "--live"),
         Render({"--live", "-o", "new", "--lcm-url", "magic"}, "LCM url \"magic"),
         Render({"--live", "-o", "pictures"}, "holds files"),
         Render({"--live", "-o", "new", "--oracle", "good.lcm"}, "no oracle")});
}

TEST_F(BadInput, HelpIsNoMistake) {
  for (const char* name : {"seam-server", "seam-token", "seam-relay", "seam-client", "seam-swarm",
                           "seam-top", "seam-measure", "seam-render", "seam-export"}) {
    Program program({BuiltProgram(name), "--help"}, made_->path());
    ASSERT_TRUE(program.Wait(30));
    EXPECT_EQ(program.status(), 0) << program.Story();
    EXPECT_EQ(program.errors(), "");
    EXPECT_NE(program.output().find("--help"), std::string::npos);
  }
}

TEST(ServerProgram, PrintsTheReasonThatAScriptStopped) {
  const Workspace folder;
  folder.Write("s.toml",
               "[[part]]\nname = \"a\"\nbox = [1, 1]\n[[script]]\nname = \"bad\"\n"
               "code = \"function on_tick(t) error('no') end\"\n");
  Program run({BuiltProgram("seam-server"), "s.toml", "--bind", "127.0.0.1:0", "--wait", "0",
               "--duration", "0.2", "--lcm-url", "none"},
              folder.path());
  ASSERT_TRUE(run.Wait(30)) << run.Story();
  EXPECT_EQ(run.status(), 1) << run.Story();
  EXPECT_NE(run.errors().find("seam-server: script bad is stopped: s.toml:6: "), std::string::npos)
      << run.Story();
}

}  // namespace bad_input_test
}  // namespace seam
