#include "tests/lab/relief/swarm_figures.h"

#include <cstdlib>

#include "common/base/check.h"

namespace seam {
namespace {

/// The line that begins so; throws when there is none.
std::string LineOf(const std::string& report, const std::string& begin) {
  const std::size_t at = ("\n" + report).find("\n" + begin);
  if (at == std::string::npos) throw OperatorError("seam-swarm does not say '" + begin + "'");
  return report.substr(at, report.find('\n', at) - at);
}

/// The number behind `before` in the line that begins with `begin`; throws when there is none.
double Number(const std::string& report, const std::string& begin, const std::string& before) {
  const std::string line = LineOf(report, begin);
  const std::size_t at = line.find(before);
  const char* const text = at == std::string::npos ? "" : line.c_str() + at + before.size();
  char* end = nullptr;
  const double number = std::strtod(text, &end);
  if (end == text) {
    throw OperatorError("seam-swarm says '" + line + "', without a number behind '" + before + "'");
  }
  return number;
}

}  // namespace

SwarmFigures ReadSwarm(const std::string& report) {
  SwarmFigures figures;
  figures.server_cpu = Number(report, "server cpu:", "cpu: ");
  figures.tick_p99_ms = Number(report, "server: tick", "p99 ");
  figures.late_p99_ms = Number(report, "server lateness:", "p99 ");
  figures.slowest_clock = Number(report, "server room:", "slowest clock ");
  figures.held = Number(report, "moving:", "clients hold ");
  figures.moving = Number(report, "moving:", "% of ");
  figures.client_us = Number(report, "client cpu:", "cpu: ");
  figures.swarm_cpu = Number(report, "client cpu:", "datagrams, ");
  figures.client_late_ms = Number(report, "client lateness:", "p99 ");
  figures.rejoins = Number(report, "client network:", "ms; ");
  figures.kbps = Number(report, "client bytes:", "in ");
  return figures;
}

}  // namespace seam
