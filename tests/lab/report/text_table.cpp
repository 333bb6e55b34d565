#include "tests/lab/report/text_table.h"

#include <fmt/format.h>

#include <cmath>

#include "common/base/check.h"

namespace seam {
namespace {

std::string EscapeMarkdown(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string MarkdownRow(const std::vector<std::string>& fields) {
  std::string line = "|";
  for (const std::string& field : fields) line += ' ' + EscapeMarkdown(field) + " |";
  return line + '\n';
}

std::string HtmlRow(const std::vector<std::string>& fields, const char* cell) {
  std::string line = "<tr>";
  for (const std::string& field : fields) {
    line += fmt::format("<{}>{}</{}>", cell, EscapeHtml(field), cell);
  }
  return line + "</tr>\n";
}

}  // namespace

std::string Markdown(const TextTable& table) {
  std::string out = MarkdownRow(table.header) + "|---|";
  for (std::size_t i = 1; i < table.header.size(); ++i) out += "---:|";
  out += '\n';
  for (const auto& row : table.rows) out += MarkdownRow(row);
  if (!table.note.empty()) out += '\n' + EscapeMarkdown(table.note) + '\n';
  if (!table.command.empty()) out += "\n    " + table.command + '\n';
  return out;
}

std::string Html(const TextTable& table) {
  std::string out = "<div class=\"scroll\"><table>\n<thead>" + HtmlRow(table.header, "th") +
                    "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) out += HtmlRow(row, "td");
  out += "</tbody></table></div>\n";
  if (!table.note.empty()) out += "<p class=\"note\">" + EscapeHtml(table.note) + "</p>\n";
  if (!table.command.empty()) {
    out += "<details class=\"command\"><summary>command</summary><pre>" +
           EscapeHtml(table.command) + "</pre></details>\n";
  }
  return out;
}

std::string EscapeHtml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string Digits(double value) {
  if (!std::isfinite(value)) return "failed";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 9.995e-4 || size >= 999500) return fmt::format("{:.1e}", value);
  if (size >= 99.95) {  // whole, rounded to three digits
    const double unit = std::pow(10, std::floor(std::log10(size * 1.0005)) - 2);
    return fmt::format("{:.0f}", std::round(value / unit) * unit);
  }
  return fmt::format("{:.3g}", value);
}

std::string DigitsOrDash(const std::optional<double>& value) {
  return value ? Digits(*value) : "–";
}

std::string Digits(const std::optional<Quartiles>& value) {
  if (!value) return "–";
  const std::string median = Digits(value->median), low = Digits(value->low),
                    high = Digits(value->high);
  return low == median && high == median ? median : fmt::format("{} ({}–{})", median, low, high);
}

std::string FillIn(const std::string& text, const std::string& path,
                   const std::vector<const TextTable*>& tables, std::vector<std::string>* missing) {
  const std::string begin = "<!-- report:", close = " -->";
  std::string out;
  std::size_t at = 0;
  for (;;) {
    const std::size_t mark = text.find(begin, at);
    if (mark == std::string::npos) return out + text.substr(at);
    const std::size_t name_at = mark + begin.size();
    const std::size_t name_end = text.find(close, name_at);
    const std::string name = text.substr(name_at, name_end - name_at);
    const std::string end_mark = "<!-- /report:" + name + close;
    const std::size_t end = name_end == std::string::npos ? name_end : text.find(end_mark, mark);
    if (end == std::string::npos) {
      throw OperatorError(path + ": the place report:" + name.substr(0, 60) + " does not end");
    }
    const std::size_t inner = name_end + close.size();
    const TextTable* found = nullptr;
    for (const TextTable* table : tables) {
      if (table->name == name) found = table;
    }
    if (found == nullptr) missing->push_back(name);
    out += text.substr(at, inner - at);
    out += found == nullptr ? text.substr(inner, end - inner) : "\n" + Markdown(*found);
    out += end_mark;
    at = end + end_mark.size();
  }
}

}  // namespace seam
