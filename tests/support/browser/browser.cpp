#include "tests/support/browser/browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "common/base/json_text.h"

namespace seam {
namespace {

constexpr int kAnswerWithin_ms = 60000;

/// The text of the first `"name":"..."` of a message; "" if it has none.
std::string Field(const std::string& message, const std::string& name) {
  const std::string begin = "\"" + name + "\":\"";
  std::size_t at = message.find(begin);
  std::string text;
  if (at == std::string::npos) return text;
  for (at += begin.size(); at < message.size() && message[at] != '"'; ++at) {
    if (message[at] == '\\') ++at;
    text += message[at];
  }
  return text;
}

bool Says(const std::string& message, const std::string& text) {
  return message.find(text) != std::string::npos;
}

/// Makes `fd` the descriptor `as`, which stays open in the program that is started.
void MoveTo(int fd, int as) {
  if (fd == as) {
    fcntl(fd, F_SETFD, 0);
  } else {
    dup2(fd, as);
  }
}

}  // namespace

std::string Browser::Find() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      const std::string program = folder + "/" + name;
      if (access(program.c_str(), X_OK) == 0) return program;
    }
  }
  return "";
}

Browser::Browser(int width, int height) {
  int commands[2], answers[2];
  if (pipe2(commands, O_CLOEXEC) != 0 || pipe2(answers, O_CLOEXEC) != 0) return;
  const std::string program = Find();
  std::vector<std::string> words = {program,
                                    "--headless=new",
                                    "--no-sandbox",
                                    "--disable-gpu",
                                    "--hide-scrollbars",
                                    "--no-first-run",
                                    "--user-data-dir=" + profile_ / "profile",
                                    "--remote-debugging-pipe"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int quiet = open("/dev/null", O_RDWR);
    dup2(quiet, 1);
    dup2(quiet, 2);
    const int in = fcntl(commands[0], F_DUPFD, 10), out = fcntl(answers[1], F_DUPFD, 10);
    MoveTo(in, 3);
    MoveTo(out, 4);
    execv(program.c_str(), arguments.data());
    _exit(127);
  }
  close(commands[0]);
  close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
  const std::string target =
      Field(Call("Target.createTarget", R"({"url":"about:blank"})"), "targetId");
  session_ = Field(
      Call("Target.attachToTarget", fmt::format(R"({{"targetId":"{}","flatten":true}})", target)),
      "sessionId");
  for (const char* domain : {"Page", "Runtime", "Log", "Network"})
    Call(std::string(domain) + ".enable", "{}");
  Call("Emulation.setDeviceMetricsOverride",
       fmt::format(R"({{"width":{},"height":{},"deviceScaleFactor":1,"mobile":false}})", width,
                   height));
}

Browser::~Browser() {
  close(to_);
  close(from_);
  if (pid_ <= 0) return;
  kill(pid_, SIGTERM);
  for (int i = 0; i < 500; ++i) {
    if (waitpid(pid_, nullptr, WNOHANG) != 0) return;
    usleep(10000);
  }
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::string Browser::NextMessage() {
  std::size_t end = 0;
  while ((end = heard_.find('\0')) == std::string::npos) {
    pollfd waiting{from_, POLLIN, 0};
    char bytes[65536];
    if (poll(&waiting, 1, kAnswerWithin_ms) <= 0) return "";
    const ssize_t count = read(from_, bytes, sizeof bytes);
    if (count <= 0) return "";
    heard_.append(bytes, static_cast<std::size_t>(count));
  }
  const std::string message = heard_.substr(0, end);
  heard_.erase(0, end + 1);
  return message;
}

void Browser::Listen(const std::string& message) {
  const std::string method = Field(message, "method");
  if (method == "Runtime.exceptionThrown") complaints_.push_back(message);
  if (method == "Runtime.consoleAPICalled" && Field(message, "type") == "error")
    complaints_.push_back(message);
  if (method == "Log.entryAdded" && Field(message, "level") == "error")
    complaints_.push_back(message);
  if (method != "Network.requestWillBeSent") return;
  const std::string address = Field(message, "documentURL");
  const std::size_t request = message.find("\"request\":");
  const std::string url = request == std::string::npos ? "" : Field(message.substr(request), "url");
  const bool inside = url.rfind("data:", 0) == 0 || url.rfind("blob:", 0) == 0 ||
                      (url.rfind("file:", 0) == 0 && address.rfind(url, 0) == 0) ||
                      (!server_.empty() && url.rfind(server_, 0) == 0);
  if (!inside) complaints_.push_back("left the file: " + url);
}

std::string Browser::Call(const std::string& method, const std::string& parameters) {
  const int id = ++commands_;
  std::string command =
      fmt::format(R"({{"id":{},"method":"{}","params":{})", id, method, parameters);
  if (!session_.empty()) command += fmt::format(R"(,"sessionId":"{}")", session_);
  command += '}';
  command += '\0';
  if (write(to_, command.data(), command.size()) != static_cast<ssize_t>(command.size())) return "";
  const std::string answer = fmt::format(R"({{"id":{},)", id);
  for (;;) {
    const std::string message = NextMessage();
    if (message.empty()) ADD_FAILURE() << method << ": the browser does not answer";
    if (message.empty() || message.rfind(answer, 0) == 0) return message;
    Listen(message);
  }
}

bool Browser::Open(const std::string& path, const std::string& fragment, const std::string& ready) {
  // Over an empty page, since a change of the fragment alone loads nothing.
  Call("Page.navigate", R"({"url":"about:blank"})");
  const bool served = path.rfind("http://", 0) == 0;
  server_ = served ? path.substr(0, path.find('/', 7) + 1) : "";
  const std::string url =
      (served ? "" : "file://") + path + (fragment.empty() ? "" : "#" + fragment);
  Call("Page.navigate", fmt::format(R"({{"url":{}}})", JsonText(url)));
  for (int i = 0; i < 600; ++i) {
    if (Evaluate("String(Boolean(" + ready + "))") == "true") {
      Settle();
      return true;
    }
    usleep(50000);
  }
  return false;
}

std::string Browser::Evaluate(const std::string& expression) {
  const std::string answer =
      Call("Runtime.evaluate",
           fmt::format(R"({{"expression":{},"awaitPromise":true,"returnByValue":true}})",
                       JsonText("(async () => String(await (" + expression + ")))()")));
  if (Says(answer, "\"exceptionDetails\"")) return "exception: " + answer;
  return Field(answer, "value");
}

double Browser::Number(const std::string& expression) {
  return std::strtod(Evaluate(expression).c_str(), nullptr);
}

void Browser::Settle() {
  Evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
}

void Browser::Mouse(const std::string& type, double x, double y) {
  Call("Input.dispatchMouseEvent",
       fmt::format(R"({{"type":"{}","x":{},"y":{},"button":"left","buttons":{},"clickCount":1}})",
                   type, x, y, type == "mouseReleased" ? 0 : 1));
}

void Browser::Click(const std::string& selector) { Drag(selector, 0.5, 0.5); }

void Browser::Drag(const std::string& selector, double from_x, double to_x, double y) {
  const std::string box =
      "document.querySelector(" + JsonText(selector) + ").getBoundingClientRect()";
  Evaluate("document.querySelector(" + JsonText(selector) + ").scrollIntoView({block: 'nearest'})");
  const double left = Number(box + ".left"), width = Number(box + ".width");
  const double at = Number(box + ".top") + y * Number(box + ".height");
  Mouse("mousePressed", left + from_x * width, at);
  for (int i = 1; i <= 4 && from_x != to_x; ++i)
    Mouse("mouseMoved", left + (from_x + (to_x - from_x) * i / 4) * width, at);
  Mouse("mouseReleased", left + to_x * width, at);
  Settle();
}

void Browser::Point(const std::string& type, const std::string& selector, double x, double y) {
  const std::string box =
      "document.querySelector(" + JsonText(selector) + ").getBoundingClientRect()";
  Mouse(type, Number(box + ".left") + x * Number(box + ".width"),
        Number(box + ".top") + y * Number(box + ".height"));
  Settle();
}

void Browser::Press(const std::string& key) {
  Hold(key, true);
  Hold(key, false);
}

void Browser::PreferDark(bool dark) {
  Call("Emulation.setEmulatedMedia",
       fmt::format(R"({{"features":[{{"name":"prefers-color-scheme","value":"{}"}}]}})",
                   dark ? "dark" : "light"));
  Settle();
}

void Browser::Hold(const std::string& key, bool down) {
  Call("Input.dispatchKeyEvent",
       fmt::format(R"({{"type":"{}","key":{}}})", down ? "keyDown" : "keyUp", JsonText(key)));
  Settle();
}

}  // namespace seam
