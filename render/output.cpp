#include "render/output.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include "common/base/check.h"
#include "common/base/plain_file.h"

extern char** environ;

namespace seam {
namespace {

namespace fs = std::filesystem;

/// True for "frame_", at least five digits and ".png", also with ".tmp" of an interrupted run.
bool IsFrameName(std::string name) {
  const std::string head = "frame_", tail = ".png", unfinished = ".png.tmp";
  if (name.size() > unfinished.size() &&
      name.compare(name.size() - unfinished.size(), unfinished.size(), unfinished) == 0) {
    name.resize(name.size() - 4);
  }
  if (name.size() < head.size() + 5 + tail.size()) return false;
  if (name.compare(0, head.size(), head) != 0) return false;
  if (name.compare(name.size() - tail.size(), tail.size(), tail) != 0) return false;
  const std::string digits = name.substr(head.size(), name.size() - head.size() - tail.size());
  return digits.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

OutputFolder::OutputFolder(const std::string& path, bool force) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw OperatorError(path_ + " is not a folder");
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    if (force) break;
    throw OperatorError(path_ + ": holds files (" + entry.path().filename().string() +
                        "); choose another folder, or --force replaces the frames in it");
  }
  if (error) throw OperatorError(path_ + ": " + error.message());
}

void OutputFolder::Prepare() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw OperatorError(path_ + ": " + error.message());
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(path_, error))
    if (IsFrameName(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& frame : old) fs::remove(frame, error);
  if (error) throw OperatorError(path_ + ": " + error.message());
}

std::string OutputFolder::FramePath(int frame) const {
  return fmt::format("{}/frame_{:05d}.png", path_, frame);
}

void CheckOutputFile(const std::string& path, const std::string& ending, bool force,
                     const std::vector<std::string>& read) {
  const fs::path file(path);
  if (file.extension() != ending) throw OperatorError(path + ": must end in " + ending);
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) throw OperatorError(folder.string() + ": no such folder");
  RequireOutput(path, force, read);
}

void RequireFfmpeg() {
  const char* const list = std::getenv("PATH");
  std::istringstream folders(list == nullptr ? "" : list);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/ffmpeg").c_str(), X_OK) == 0) return;
  throw OperatorError("--video needs ffmpeg, which is not installed (apt-get install ffmpeg)");
}

std::string VideoEnding(const std::string& path) {
  const std::string ending = fs::path(path).extension();
  if (ending == ".mp4" || ending == ".webm" || ending == ".gif") return ending;
  throw OperatorError("--video " + path + ": must end in .mp4, .webm or .gif");
}

void EncodeVideo(const OutputFolder& folder, int fps, const std::string& path) {
  std::vector<std::string> words{
      "ffmpeg",     "-loglevel",         "error", "-y",
      "-framerate", std::to_string(fps), "-i",    folder.path() + "/frame_%05d.png"};
  const std::string ending = VideoEnding(path);
  std::vector<std::string> coding{"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18"};
  if (ending == ".webm") coding = {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"};
  if (ending == ".gif") {  // a palette from the frames: the default one lacks their colours
    coding = {"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none"};
  }
  words.insert(words.end(), coding.begin(), coding.end());
  words.push_back(path);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  const int failed = posix_spawnp(&child, "ffmpeg", nullptr, nullptr, arguments.data(), environ);
  if (failed != 0 || waitpid(child, &status, 0) != child || status != 0)
    throw OperatorError("ffmpeg could not make " + path + "; the frames are in " + folder.path());
}

}  // namespace seam
