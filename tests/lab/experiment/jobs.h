#pragma once
/// Runs functions in processes of their own, several at a time: one that crashes harms no other.

#include <cstddef>
#include <functional>
#include <string>

namespace seam {

/// Outcome of a job: `text` is its result or, if not `good`, one line with the reason.
struct JobResult {
  bool good = false;
  std::string text;
};

/// Calls `work` for 0..count-1 in at most `jobs` processes at a time, and `done` with their results
/// here, in the order in which they end. An OperatorError of `work` is a result that is not good;
/// so is its crash. Between results, and at least twice a second, `stop` is asked; when it says
/// true the processes are ended. Requires a program of one thread.
void RunJobs(std::size_t count, int jobs, const std::function<std::string(std::size_t)>& work,
             const std::function<void(std::size_t, const JobResult&)>& done,
             const std::function<bool()>& stop);

}  // namespace seam
