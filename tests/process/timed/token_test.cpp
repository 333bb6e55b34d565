/// Connect tokens between real processes, over UDP: seam-token makes them, a server with
/// --token-key demands them, a client with --token shows one. And the server's key, which
/// --server-key pins.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>

#include "tests/support/program.h"

namespace seam {
namespace token_test {

/// The longest that anything is waited for, s.
constexpr double kPatience = 60;

class TokenProcesses : public ::testing::Test {
 protected:
  void Start(const std::vector<std::string>& more, const std::string& bind = "127.0.0.1") {
    std::vector<std::string> words = {BuiltProgram("seam-server"),
                                      "crossing",
                                      "--lcm-url",
                                      "none",
                                      "--duration",
                                      "0",
                                      "--wait",
                                      "1",
                                      "--bind",
                                      bind + ":0"};
    words.insert(words.end(), more.begin(), more.end());
    server_ = std::make_unique<Program>(words);
    ASSERT_TRUE(server_->WaitForErrors("waiting for", kPatience)) << server_->Story();
    address_ = After(", on ", "\n");
    key_ = After("its key is ", "\n");
  }
  /// Returns the server's words between two others.
  std::string After(const std::string& mark, const std::string& end) const {
    const std::string text = server_->errors();
    const std::size_t at = text.find(mark);
    EXPECT_NE(at, std::string::npos) << text;
    const std::size_t from = std::min(text.size(), at + mark.size());
    return text.substr(from, text.find(end, from) - from);
  }
  int Run(const std::vector<std::string>& more, std::string* output, std::string* errors) const {
    std::vector<std::string> words = {BuiltProgram("seam-token")};
    words.insert(words.end(), more.begin(), more.end());
    Program token(words, folder_.path());
    EXPECT_TRUE(token.Wait(kPatience));
    *output = token.output();
    *errors = token.errors();
    return token.status();
  }
  void MakeKey(const std::string& file) const {
    std::string output, errors;
    EXPECT_EQ(Run({"--make-key", "--key", file}, &output, &errors), 0) << errors;
    EXPECT_EQ(output, "");
  }
  /// Writes a token into the file.
  void MakeToken(const std::string& file, const std::string& key, const std::string& name,
                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"--key", key, "--name", name};
    words.insert(words.end(), more.begin(), more.end());
    std::string output, errors;
    EXPECT_EQ(Run(words, &output, &errors), 0) << errors;
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1);
    folder_.Write(file, output);
  }
  std::unique_ptr<Program> Client(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {BuiltProgram("seam-client"), address_, "--lcm-url", "none"};
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Program>(words, folder_.path());
  }
  /// Returns the line of a client that must be refused.
  std::string Refused(const std::vector<std::string>& more) const {
    const std::unique_ptr<Program> client = Client(more);
    EXPECT_TRUE(client->Wait(kPatience));
    EXPECT_EQ(client->status(), 2) << client->Story();
    return client->errors();
  }

  Workspace folder_;
  std::unique_ptr<Program> server_;
  std::string address_, key_;
};

constexpr char kRefuses[] = "seam-client: the server refuses: ";

TEST_F(TokenProcesses, AServerWithAnOperatorsKeyLetsInOnlyThoseWithAGoodToken) {
  MakeKey("operator.key");
  MakeKey("other.key");
  Start({"--token-key", folder_ / "operator.key"});
  MakeToken("late", "operator.key", "bob", {"--life", "1"});
  MakeToken("ann", "operator.key", "ann");
  MakeToken("red", "operator.key", "bob", {"--room", "red"});
  MakeToken("forged", "other.key", "bob");
  MakeToken("looks", "operator.key", "bob", {"--watch"});
  EXPECT_EQ(Refused({"--name", "bob"}),
            kRefuses + std::string("a token is needed here: seam-client --token FILE\n"));
  for (const char* limit : {"--join-timeout", "--duration"}) {  // shorter than a client insists
    const std::string why = Refused({"--name", "bob", limit, "1"});
    EXPECT_EQ(why.find(kRefuses + std::string("a token is needed here")), 0u) << why;
  }
  const std::unique_ptr<Program> ann = Client({"--token", "ann"});
  ASSERT_TRUE(server_->WaitForErrors("ann is here", kPatience)) << server_->Story();
  EXPECT_EQ(Refused({"--token", "ann"}), kRefuses + std::string("the token was used before\n"));
  EXPECT_EQ(Refused({"--token", "late"}), kRefuses + std::string("the token has expired\n"));
  EXPECT_EQ(Refused({"--token", "forged"}),
            kRefuses + std::string("the token was made with another key, or was changed\n"));
  EXPECT_EQ(Refused({"--token", "looks"}),
            kRefuses + std::string("the token lets bob only look on\n"));
  const std::string red = Refused({"--token", "red"});
  EXPECT_NE(red.find("room"), std::string::npos) << red;
  EXPECT_EQ(server_->errors().find("bob is here"), std::string::npos);
  // Nobody prints a secret.
  EXPECT_EQ(server_->errors().find("SEAM TOKEN"), std::string::npos);
  ann->Signal(SIGTERM);
  EXPECT_TRUE(ann->Wait(kPatience));
  EXPECT_EQ(ann->status(), 0) << ann->Story();
}

TEST_F(TokenProcesses, MistakesAreNamedInOneLineBeforeAnythingIsSent) {
  MakeKey("operator.key");
  MakeToken("ann", "operator.key", "ann");
  address_ = "127.0.0.1:9";
  folder_.Write("cut", "5345414d20544f4b454e203100\n");
  folder_.Write("future", "5345414d20544f4b454e20320000000000\n");
  folder_.Write("none", "nonsense\n");
  EXPECT_EQ(Refused({"--token", "cut"}), "seam-client: --token cut: is cut off\n");
  EXPECT_EQ(Refused({"--token", "none"}), "seam-client: --token none: is no connect token\n");
  EXPECT_EQ(Refused({"--token", "future"}),
            "seam-client: --token future: is of another version than this program reads (1)\n");
  EXPECT_NE(Refused({"--token", "missing"}).find("--token missing: "), std::string::npos);
  EXPECT_NE(Refused({"--token", "ann", "--name", "ann"}).find("not with --name"),
            std::string::npos);
  EXPECT_NE(Refused({"--name", "ann", "--server-key", "12"}).find("64 digits"), std::string::npos);
  std::string output, errors;
  EXPECT_EQ(Run({"--make-key", "--key", "operator.key"}, &output, &errors), 2);
  EXPECT_NE(errors.find("--key operator.key: "), std::string::npos) << "is not overwritten";
  EXPECT_EQ(chmod((folder_ / "operator.key").c_str(), 0644), 0);
  EXPECT_EQ(Run({"--key", "operator.key", "--name", "ann"}, &output, &errors), 2);
  EXPECT_NE(errors.find("others may read or write it"), std::string::npos);
  EXPECT_EQ(Run({"--key", "missing.key", "--name", "ann"}, &output, &errors), 2);
  EXPECT_EQ(Run({"--name", "ann"}, &output, &errors), 2);
  EXPECT_EQ(output, "");
}

TEST_F(TokenProcesses, APinnedKeyIsTheServersAndStaysWithIdentity) {
  std::string before;
  for (int start = 0; start < 2; ++start) {
    Start({"--identity", folder_ / "server.key"});
    EXPECT_EQ(key_.size(), 64u) << server_->Story();
    EXPECT_TRUE(start == 0 || key_ == before) << "the same after a restart";
    before = key_;
    const std::unique_ptr<Program> ann = Client({"--name", "ann", "--server-key", key_});
    ASSERT_TRUE(server_->WaitForErrors("ann is here", kPatience)) << server_->Story();
    std::string other = key_;
    other[0] = other[0] == 'a' ? 'b' : 'a';
    const std::string line = Refused({"--name", "bob", "--server-key", other});
    EXPECT_NE(line.find("which is not the one of --server-key"), std::string::npos) << line;
    ann->Signal(SIGTERM);
    EXPECT_TRUE(ann->Wait(kPatience));
    server_->Signal(SIGTERM);
    EXPECT_TRUE(server_->Wait(kPatience));
  }
}

TEST_F(TokenProcesses, AServerIsReachedByIpv4AndIpv6AtOnce) {
  Start({}, "[::]");
  const std::string port = address_.substr(address_.rfind(':') + 1);
  address_ = "127.0.0.1:" + port;
  const std::unique_ptr<Program> ann = Client({"--name", "ann"});
  ASSERT_TRUE(server_->WaitForErrors("ann is here", kPatience)) << server_->Story();
  if (server_->errors().find("on 0.0.0.0:") != std::string::npos) return;  // no IPv6 here
  address_ = "[::1]:" + port;
  const std::unique_ptr<Program> bob = Client({"--name", "bob"});
  ASSERT_TRUE(server_->WaitForErrors("bob is here", kPatience)) << server_->Story();
}

}  // namespace token_test
}  // namespace seam
