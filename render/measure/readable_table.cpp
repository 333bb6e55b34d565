#include "render/measure/readable_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "common/sync/method.h"
#include "render/playback/format.h"

namespace seam {
namespace {

using Value = std::optional<double>;

std::string Share(double value) {
  return fmt::format(value < 0.0995 ? "{:.1f} %" : "{:.0f} %", 100 * value);
}
std::string Milliseconds(double value) { return fmt::format("{:.0f} ms", value); }
std::string Acceleration(double value) {
  return fmt::format(value < 9.95 ? "{:.2f} m/s²" : "{:.0f} m/s²", value);
}
std::string Count(double value) { return fmt::format("{:.0f}", value); }
std::string Rate(double bytes) {
  if (bytes < 1000) return fmt::format("{:.0f} B/s", bytes);
  return fmt::format(bytes < 9950 ? "{:.1f} kB/s" : "{:.0f} kB/s", bytes / 1000);
}
/// CPU time per second, us, as a share of one processor.
std::string Processor(double us) { return fmt::format("{:.1f} % of a CPU", us / 1e4); }
std::string Ratio(double value) { return fmt::format("{:.2f}", value); }

Value Known(std::int64_t count) { return static_cast<double>(count); }
Value Whole(const std::optional<std::int64_t>& count) {
  return count ? Value(static_cast<double>(*count)) : std::nullopt;
}
Value Positive(double value) { return value > 0 ? Value(value) : std::nullopt; }

/// A line of the table.
struct Row {
  const char* name;
  Value (*value)(const Measures&);
  std::string (*text)(double);
  bool least_is_best;  ///< else no value is better
};

const std::vector<Row>& Rows() {
  using M = const Measures&;
  static const std::vector<Row> rows = {
      {"others' error, as shown", [](M m) { return m.path_error_rms_m; }, FormatLength, true},
      {"  shown so long ago", [](M m) { return m.view_age_ms; }, Milliseconds, false},
      {"others' error, present", [](M m) { return m.error_others_m; }, FormatLength, true},
      {"  from the server's view", [](M m) { return m.error_served_m; }, FormatLength, true},
      {"own error", [](M m) { return m.error_own_m; }, FormatLength, true},
      {"error of all", [](M m) { return Value(m.error_rms_m); }, FormatLength, true},
      {"  95 % are below", [](M m) { return Value(m.error_p95_m); }, FormatLength, true},
      {"  at most", [](M m) { return Value(m.error_max_m); }, FormatLength, true},
      {"errors seen", [](M m) { return m.seen; }, Share, true},
      {"stutter, as shown", [](M m) { return Value(m.stutter_shown_mps2); }, Acceleration, true},
      {"stutter, present", [](M m) { return Value(m.stutter_mps2); }, Acceleration, true},
      {"backsteps", [](M m) { return Known(m.backsteps); }, Count, true},
      {"overlap, 99 % below", [](M m) { return m.overlap_p99_m; }, FormatLength, true},
      {"rebound (truth: 1)", [](M m) { return m.rebound; }, Ratio, false},
      {"own input to screen", [](M m) { return m.response_own_ms; }, Milliseconds, true},
      {"  to others' screens", [](M m) { return m.response_other_ms; }, Milliseconds, true},
      {"inputs too late", [](M m) { return Whole(m.inputs_late); }, Count, true},
      {"traffic of a client", [](M m) { return Positive(m.bytes_per_s); }, Rate, true},
      {"CPU of a peer", [](M m) { return Positive(m.cpu_us_per_s); }, Processor, true}};
  return rows;
}

std::string MethodOf(const Room& room) {
  const std::string variant = VariantOf(room);
  return variant.empty() ? room.mode : room.mode + "/" + variant;
}

/// The runs of a column.
struct Column {
  std::vector<const MeasuredRun*> runs;
  bool valid() const { return runs.front()->valid.empty(); }
  const Room& room() const { return runs.front()->room; }
  std::string name() const {
    if (runs.size() == 1) return runs.front()->run;
    return fmt::format("median of {}", runs.size());
  }
  std::string seeds() const {
    std::string text;
    for (const MeasuredRun* run : runs) {
      text += (text.empty() ? "" : " ") + std::to_string(run->room.seed);
      if (text.size() > 12) return fmt::format("{} seeds", runs.size());
    }
    return text;
  }
  /// Returns the nearest-rank median of the runs that have a value.
  Value Median(const Row& row) const {
    std::vector<double> values;
    for (const MeasuredRun* run : runs) {
      if (!run->valid.empty() || run->measures.compared == 0) continue;
      if (const Value value = row.value(run->measures)) values.push_back(*value);
    }
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    return values[(values.size() - 1) / 2];
  }
};

std::vector<Column> ColumnsOf(const std::vector<MeasuredRun>& runs, bool medians) {
  std::vector<Column> columns;
  std::map<std::vector<std::string>, std::size_t> by_setting;
  for (const MeasuredRun& run : runs) {
    const Room& r = run.room;
    const std::vector<std::string> setting = {r.scene_name,
                                              r.scene_text,
                                              MethodOf(r),
                                              r.impair,
                                              std::to_string(r.input_delay_ticks),
                                              std::to_string(r.send_hz)};
    if (medians && run.valid.empty()) {
      const auto [at, first] = by_setting.emplace(setting, columns.size());
      if (!first) {
        columns[at->second].runs.push_back(&run);
        continue;
      }
    }
    columns.push_back(Column{{&run}});
  }
  return columns;
}

/// Returns the number of characters, not bytes, of UTF-8 text.
std::size_t Characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string Padded(const std::string& text, std::size_t width, bool right) {
  const std::size_t have = Characters(text);
  const std::string space(have < width ? width - have : 0, ' ');
  return right ? space + text : text + space;
}

using Lines = std::vector<std::vector<std::string>>;  // [line][name, then columns]

/// Adds the lines that tell the columns apart; what they have in common stands above the table.
void AddSettings(const std::vector<Column>& columns, Lines* lines) {
  const auto add = [&](const char* name, auto&& text, bool always) {
    std::vector<std::string> line = {name};
    std::set<std::string> different;
    for (const Column& column : columns) {
      line.push_back(text(column) + "  ");
      different.insert(line.back());
    }
    if (always || different.size() > 1) lines->push_back(line);
  };
  add(
      "", [](const Column& c) { return c.name(); }, true);
  add(
      "scene", [](const Column& c) { return c.room().scene_name; }, false);
  add(
      "method", [](const Column& c) { return MethodOf(c.room()); }, true);
  add(
      "network", [](const Column& c) { return c.room().impair; }, false);
  add(
      "seed", [](const Column& c) { return c.seeds(); }, true);
}

/// Adds a line of values; a star follows the best of several that read differently.
void AddRow(const std::vector<Column>& columns, const Row& row, Lines* lines) {
  std::vector<Value> values;
  for (const Column& column : columns) values.push_back(column.Median(row));
  Value best;
  std::set<std::string> texts;
  for (const Value& value : values) {
    if (!value) continue;
    best = std::min(best.value_or(*value), *value);
    texts.insert(row.text(*value));
  }
  if (texts.empty()) return;
  const bool marks = row.least_is_best && texts.size() > 1;
  std::vector<std::string> line = {row.name};
  for (const Value& value : values) {
    const std::string text = value ? row.text(*value) : "–";
    const bool is_best = marks && value && text == row.text(*best);
    line.push_back(text + (is_best ? " *" : "  "));
  }
  lines->push_back(line);
}

/// Returns the columns of the lines in blocks of at most `width` characters.
std::string InBlocks(const Lines& lines, std::size_t width) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      widths[i] = std::max(widths[i], Characters(line[i]) + (i == 0 ? 0 : 2));
    }
  }
  std::string out;
  for (std::size_t begin = 1; begin < widths.size();) {
    std::size_t end = begin, used = widths[0];
    while (end < widths.size() && (end == begin || used + widths[end] <= width)) {
      used += widths[end++];
    }
    if (begin > 1) out += '\n';
    for (const auto& line : lines) {
      std::string text = Padded(line[0], widths[0], false);
      for (std::size_t i = begin; i < end; ++i) text += Padded(line[i], widths[i], true);
      out += text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
    }
    begin = end;
  }
  return out;
}

/// Says what is to be done about a run that is not valid.
std::string Remedy(const std::string& reason) {
  if (reason.rfind("no contact", 0) == 0) {
    return "its scene is about such a contact; the players did not drive into it";
  }
  if (reason == "no hand-over") return "its scene is about one; let it run longer";
  if (reason == "no edit") return "its scene is about bodies that break or join";
  return "was it recorded with --publish none, or cut short?";
}

std::string Notes(const std::vector<MeasuredRun>& runs) {
  std::string notes;
  for (const MeasuredRun& run : runs) {
    if (!run.valid.empty()) {
      notes += fmt::format("{} is not valid: {}: {}\n", run.run, run.valid, Remedy(run.valid));
    } else if (!run.lacks.empty()) {
      notes += fmt::format("{} lacks {}: its figures are of the rest\n", run.run, run.lacks);
    }
  }
  return notes;
}

}  // namespace

std::string FormatReadable(const std::vector<MeasuredRun>& runs, std::size_t width, bool medians) {
  if (runs.empty()) return "";
  const std::vector<Column> columns = ColumnsOf(runs, medians);
  std::set<std::string> scenes, networks;
  for (const MeasuredRun& run : runs) {
    scenes.insert(run.room.scene_name);
    networks.insert(run.room.impair);
  }
  std::string title = scenes.size() == 1 ? *scenes.begin() : "";
  if (networks.size() == 1) title += (title.empty() ? "" : ", ") + ("network " + *networks.begin());
  Lines lines;
  AddSettings(columns, &lines);
  const std::size_t settings = lines.size();
  for (const Row& row : Rows()) AddRow(columns, row, &lines);
  const bool figures = lines.size() > settings;
  std::string out = title.empty() ? "" : title + '\n';
  out += InBlocks(lines, width);
  if (figures && columns.size() > 1) out += "* the best; less is better; --wide: one line a run\n";
  return out + Notes(runs);
}

}  // namespace seam
