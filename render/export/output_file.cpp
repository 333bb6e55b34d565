#include "render/export/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"

namespace seam {

OutputFile::OutputFile(const std::string& path, bool force, const std::vector<std::string>& read)
    : path_(path == "-" ? "" : path) {
  if (path_.empty()) {
    file_ = stdout;
    return;
  }
  RequireOutput(path_, force, read);
  unfinished_ = path_ + ".part-" + std::to_string(getpid());
  file_ = OpenPlainFile(unfinished_, FileUse::kCreate);
  if (file_ == nullptr) {
    unfinished_.clear();
    Fail(errno);
  }
}

OutputFile::~OutputFile() {
  if (path_.empty()) return;
  if (file_ != nullptr) std::fclose(file_);
  if (!unfinished_.empty()) std::remove(unfinished_.c_str());
}

void OutputFile::Fail(int error) const {
  throw OperatorError((path_.empty() ? "stdout" : path_) +
                      ": cannot be written: " + std::strerror(error));
}

void OutputFile::Write(std::string_view text) {
  if (g_stop != 0) throw OperatorError("stopped: the export is not complete");
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) Fail(errno);
  bytes_ += text.size();
}

void OutputFile::Finish() {
  if (std::fflush(file_) != 0) Fail(errno);
  if (path_.empty()) return;
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) Fail(errno);
  if (std::rename(unfinished_.c_str(), path_.c_str()) != 0) Fail(errno);
  unfinished_.clear();
}

}  // namespace seam
