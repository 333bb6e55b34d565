#include "client/front/edit.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "client/front/child.h"
#include "client/front/verbs.h"
#include "common/base/check.h"
#include "common/base/entropy.h"
#include "common/base/find_scene.h"
#include "common/base/hex.h"
#include "common/base/process.h"
#include "common/net/http_server.h"

namespace seam {
namespace {

/// Between two looks for a signal and for the end of a played room, ms.
constexpr int kLookMs = 100;
/// An editor writes a file in several steps; the file is read when none follows for so long, ms.
constexpr int kSettledMs = 5;

/// Notices that a file is saved, also by an editor that puts another one in its place.
class SaveWatch {
 public:
  explicit SaveWatch(const std::string& path)
      : name_(std::filesystem::path(path).filename().string()), fd_(inotify_init1(IN_CLOEXEC)) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const char* const watched = folder.empty() ? "." : folder.c_str();
    if (fd_ < 0 || inotify_add_watch(fd_, watched, IN_CLOSE_WRITE | IN_MOVED_TO) < 0) {
      if (fd_ >= 0) close(fd_);
      throw OperatorError(std::string(watched) + ": this folder cannot be watched");
    }
  }
  ~SaveWatch() { close(fd_); }
  SaveWatch(const SaveWatch&) = delete;
  SaveWatch& operator=(const SaveWatch&) = delete;

  /// Waits for a save; true if there was one, and no further one follows.
  bool Saved() {
    bool saved = false;
    for (int wait_ms = kLookMs;; wait_ms = kSettledMs) {
      pollfd ready{fd_, POLLIN, 0};
      if (poll(&ready, 1, wait_ms) <= 0) return saved;
      saved = Read() || saved;
      if (!saved) return false;
    }
  }

 private:
  /// Takes the events that are there; true if one is of the file.
  bool Read() const {
    alignas(inotify_event) char events[4096];
    const ssize_t bytes = read(fd_, events, sizeof events);
    bool ours = false;
    for (ssize_t at = 0; at + ssize_t(sizeof(inotify_event)) <= bytes;) {
      const auto* const event = reinterpret_cast<const inotify_event*>(events + at);
      ours = ours || (event->len > 0 && name_ == event->name);
      at += ssize_t(sizeof(inotify_event)) + event->len;
    }
    return ours;
  }

  const std::string name_;
  const int fd_;
};

class Editing {
 public:
  explicit Editing(const EditOptions& options)
      : options_(options), path_(FindScene(options.scene)), watch_(path_) {
    if (!options_.play) return;
    OsEntropy entropy;
    token_ = SecretDigits(entropy);
    port_ = options_.room.port != 0 ? options_.room.port : HttpServer(0).port();
  }

  int Run() {
    Look();
    while (g_stop == 0) {
      if (watch_.Saved()) Look();
      if (room_ == nullptr || room_->running()) continue;
      status_ = room_->status() == 1 ? 1 : 0;
      room_.reset();
    }
    return room_ != nullptr && room_->End() == 1 ? 1 : status_;
  }

 private:
  /// Checks the file, says the result, and plays it if it loads.
  void Look() {
    const std::int64_t begin_us = SteadyClockUs();
    ChildFiles files;
    files.output = STDOUT_FILENO;
    files.errors = STDERR_FILENO;
    std::fflush(stdout);
    Child check({"seam-lab", "check", path_}, files);
    while (check.running() && g_stop == 0) SleepUs(1000);
    if (g_stop != 0) return;
    const double took_ms = static_cast<double>(SteadyClockUs() - begin_us) * 1e-3;
    const bool loads = check.status() == 0 || check.status() == 1;
    std::fprintf(stderr, "seam: %s, checked in %.0f ms; waiting for the next save\n",
                 check.status() == 0 ? "ok"
                 : loads             ? "it loads, but see above"
                                     : "it does not load",
                 took_ms);
    if (options_.play && loads) Play();
  }

  void Play() {
    room_.reset();  // ends the room of before
    status_ = 0;
    const PlayOptions& o = options_.room;
    std::vector<std::string> words = {
        "seam",    "play", path_,    "--no-browser",         "--impair", o.impair,
        "--mode",  o.mode, "--bots", std::to_string(o.bots), "--port",   std::to_string(port_),
        "--token", "-"};
    if (!o.name.empty()) words.insert(words.end(), {"--name", o.name});
    ChildFiles files;
    files.errors = STDERR_FILENO;
    files.input = ReadableText(token_ + "\n");
    room_ = std::make_unique<Child>(words, files);
    close(files.input);
  }

  const EditOptions options_;
  const std::string path_;
  SaveWatch watch_;
  // Of all rooms, so that the open page goes on with the next one.
  std::string token_;
  int port_ = 0;
  std::unique_ptr<Child> room_;  // `seam play`
  int status_ = 0;               // of the last one, if it has ended
};

}  // namespace

int EditScene(const EditOptions& options) {
  StopOnSignals();
  return Editing(options).Run();
}

}  // namespace seam
