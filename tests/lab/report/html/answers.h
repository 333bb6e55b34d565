#pragma once
/// The report's first answer: for a latency and a loss, which method errs least and what it costs,
/// from the sweeps along what a network does.

#include <optional>
#include <string>
#include <vector>

#include "tests/lab/report/page.h"
#include "tests/lab/report/sweep_section.h"

namespace seam {

/// Medians over seeds of one method in one scene over one network.
struct Answer {
  std::string scene;  ///< "crossing", "crossing, bots"
  double one_way_ms = 0, loss_percent = 0;
  std::string method;
  double error_m = 0;                                ///< of what clients see of others
  std::optional<double> cpu_ms_per_s, kbytes_per_s;  ///< server and clients; of a client
  std::optional<double> response_ms;                 ///< from the own button to the own screen
};

/// One for each scene, network and method of the sweeps along latency or loss; of a network that
/// two sweeps have in common, the first.
std::vector<Answer> FindAnswers(const std::vector<Sweep>& sweeps);

/// "answers", the first section; without items where there are no such sweeps.
Section AnswersSection(const std::vector<Sweep>& sweeps);

}  // namespace seam
