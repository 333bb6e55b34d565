#include "server/metrics_page.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>

#include "common/base/check.h"
#include "common/base/files/list_folder.h"
#include "common/base/limits.h"
#include "common/base/process.h"
#include "common/base/version.h"
#include "common/record/load_histograms.h"

namespace seam {
namespace {

constexpr std::int64_t kPageUs = 5000;  // between two polls
constexpr const char* kWorst = "worst:";

/// Reads "all" or "worst:20".
std::size_t MostRooms(const std::string& text) {
  if (text == "all") return std::numeric_limits<std::size_t>::max();
  const bool worst = text.rfind(kWorst, 0) == 0;
  const std::string number = worst ? text.substr(std::string(kWorst).size()) : "";
  const bool digits = !number.empty() && number.size() <= 5 &&
                      number.find_first_not_of("0123456789") == std::string::npos;
  const int most = digits ? std::atoi(number.c_str()) : 0;
  if (most < 1) throw OperatorError("--metrics-rooms takes all, or worst:N with N of at least 1");
  return static_cast<std::size_t>(most);
}

std::string Number(const std::string& name, const char* type, const char* help, double value) {
  return "# HELP " + name + " " + help + "\n# TYPE " + name + " " + type + "\n" + name + " " +
         MetricNumber(value) + "\n";
}

double ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double OpenFiles() {
  std::error_code error;
  return static_cast<double>(ListFolder("/proc/self/fd", error).size());
}

/// Returns whether the directory of the fleet answers, and the rooms for which this server stands
/// by; "" without a fleet.
std::string FleetMetrics(const FleetMember* member) {
  if (member == nullptr) return "";
  std::string page = Number("seam_directory_up", "gauge",
                            "1 if the directory of the fleet answered last.", member->up() ? 1 : 0);
  page +=
      "# HELP seam_standby_behind_ticks Ticks that a room for which this server stands by is "
      "behind its log; -1: it is not followed.\n# TYPE seam_standby_behind_ticks gauge\n";
  for (const auto& [room, ticks] : member->StandsBy()) {
    page += "seam_standby_behind_ticks{room=\"" + room + "\"} " + std::to_string(ticks) + "\n";
  }
  return page;
}

}  // namespace

std::string ProcessMetrics() {
  static const auto start = static_cast<double>(std::time(nullptr));
  const std::string build = std::string("seam_build_info{version=\"") + kVersion +
                            "\",protocol=\"" + std::to_string(kProtocolVersion) + "\"} 1\n";
  return "# HELP seam_build_info The server's version and protocol.\n"
         "# TYPE seam_build_info gauge\n" +
         build +
         Number("process_start_time_seconds", "gauge", "Start of the program, since 1970.",
                start) +
         Number("process_cpu_seconds_total", "counter", "CPU time of the program.",
                static_cast<double>(CpuUs()) * 1e-6) +
         Number("process_resident_memory_bytes", "gauge", "Memory of the program.",
                ResidentBytes()) +
         Number("process_open_fds", "gauge", "Open files and sockets.", OpenFiles());
}

std::vector<RoomLoad> WorstRooms(std::vector<RoomLoad> rooms, std::size_t most) {
  if (rooms.size() <= most) return rooms;
  std::stable_sort(rooms.begin(), rooms.end(), [](const RoomLoad& a, const RoomLoad& b) {
    return a.load.late_p99_us > b.load.late_p99_us;
  });
  rooms.resize(most);
  return rooms;
}

MetricsPage::MetricsPage(const ServerFlags& f) : most_rooms_(MostRooms(f.metrics_rooms)) {
  const bool told = !f.metrics_bind.empty() || f.metrics_rooms != "all";
  if (f.metrics_port == 0 && told) {
    throw OperatorError("--metrics-bind and --metrics-rooms are for the page of --metrics");
  }
  if (f.metrics_port == 0) return;
  page_ = std::make_unique<HttpPage>(static_cast<std::uint16_t>(f.metrics_port), f.metrics_bind);
  ProcessMetrics();  // notes the start
}

void MetricsPage::Poll(std::int64_t now_us, const Hub& hub, const FleetMember* member) {
  if (page_ == nullptr || now_us - polled_us_ < kPageUs) return;
  polled_us_ = now_us;
  page_->Poll(now_us, [&] {
    return WriteLoadPage(WorstRooms(hub.Loads(), most_rooms_)) + ProcessMetrics() +
           FleetMetrics(member);
  });
}

}  // namespace seam
