/// seam-lab check: calls of a script to functions that are not there, or with wrong arguments.

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "common/base/nearest.h"
#include "common/scene/part_rules.h"
#include "tests/lab/check/lua_words.h"
#include "tests/lab/check/script_check.h"

namespace seam {
namespace {

using Kind = LuaWord::Kind;
using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

/// Returns the parameters of the functions of `world`, one letter each; capitals may be left out:
///   p part, y player, c character, j joint of a script or scene, q player or part, k key of a
///   value, s text, n number, l number or boolean, t table
const std::map<std::string, std::string>& Signatures() {
  static const std::map<std::string, std::string> all = {
      {"tick", ""},         {"time", ""},       {"part", "p"},        {"parts", "S"},
      {"players", ""},      {"input", "y"},     {"seat", "y"},        {"unseat", "y"},
      {"impulse", "pnnS"},  {"force", "pnnS"},  {"blast", "nnnnN"},   {"limp", "cL"},
      {"get", "qk"},        {"set", "qkn"},     {"score", "qN"},      {"health", "qN"},
      {"say", "s"},         {"add_part", "t"},  {"add_joint", "t"},   {"weld", "ppN"},
      {"unweld", "pp"},     {"hinge", "sppNN"}, {"distance", "sppN"}, {"remove_part", "p"},
      {"remove_joint", "j"}};
  return all;
}

class CallCheck {
 public:
  CallCheck(const ScriptNames& names, const ScriptSource& script, std::vector<Finding>* findings)
      : names_(names), script_(script), words_(script.code, script.line), findings_(findings) {
    words_.Resolve();
  }

  /// world.name(...), string.name and the like.
  void Run() {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::string library = words_.at(i).text;
      const auto known = names_.fields.find(library);
      if (!words_.IsName(i) || words_.IsField(i) || known == names_.fields.end()) continue;
      if (library == "_G" || !words_.IsName(i + 2)) continue;
      const LuaWord& name = words_.at(i + 2);
      const bool has =
          std::find(known->second.begin(), known->second.end(), name.text) != known->second.end();
      if (words_.Is(i + 1, ":") && library == "world") {
        Add(name.line, "write world." + name.text + ", with a point");
      } else if (!words_.Is(i + 1, ".")) {
        continue;
      } else if (!has && !words_.Is(i + 3, "=")) {
        Add(name.line,
            library + " has no '" + name.text + "'" + DidYouMean(name.text, known->second));
      } else if (library == "world" && has) {
        CheckCall(name, i + 3);
      }
    }
  }

 private:
  void Add(int line, const std::string& text) {
    findings_->push_back({line, "script '" + script_.name + "': " + text});
  }

  /// Splits the arguments of a call at `open`; nothing if it is no call.
  std::optional<Ranges> Arguments(std::size_t open) {
    Ranges all;
    if (words_.IsText(open)) all.emplace_back(open, open + 1);
    if (words_.Is(open, "{")) all.emplace_back(open, words_.CloseOf(open) + 1);
    if (!all.empty()) return all;
    if (!words_.Is(open, "(")) return std::nullopt;
    const std::size_t close = words_.CloseOf(open);
    std::size_t begin = open + 1;
    for (std::size_t i = begin; i < close; ++i) {
      if (words_.Is(i, "(") || words_.Is(i, "{") || words_.Is(i, "[")) i = words_.CloseOf(i);
      if (words_.Is(i, "function")) i = words_.EndOf(i);
      if (words_.Is(i, ",")) {
        all.emplace_back(begin, i);
        begin = i + 1;
      }
    }
    if (begin < close) all.emplace_back(begin, close);
    return all;
  }

  void CheckCall(const LuaWord& function, std::size_t open) {
    const auto found = Signatures().find(function.text);
    const auto arguments = Arguments(open);
    if (found == Signatures().end() || !arguments) return;
    const std::string& signature = found->second;
    const auto needed =
        static_cast<std::size_t>(std::count_if(signature.begin(), signature.end(), [](char c) {
          return std::islower(static_cast<unsigned char>(c)) != 0;
        }));
    // A call or ... at the end may give several values.
    const bool open_end = !arguments->empty() && (words_.Is(arguments->back().second - 1, ")") ||
                                                  words_.Is(arguments->back().second - 1, "..."));
    if (arguments->size() < needed && !open_end) {
      return Add(function.line, "world." + function.text + " takes " + std::to_string(needed) +
                                    " arguments, not " + std::to_string(arguments->size()));
    }
    for (std::size_t i = 0; i < std::min(arguments->size(), signature.size()); ++i) {
      const auto& [begin, end] = (*arguments)[i];
      CheckArgument(function, i, signature[i], begin, end);
    }
  }

  void CheckArgument(const LuaWord& function, std::size_t index, char wanted, std::size_t begin,
                     std::size_t end) {
    const LuaWord& word = words_.at(begin);
    const bool optional = std::isupper(static_cast<unsigned char>(wanted)) != 0;
    const char letter = static_cast<char>(std::tolower(static_cast<unsigned char>(wanted)));
    const bool joined = word.kind == Kind::kText && words_.Is(begin + 1, "..");
    if (joined && letter == 'p' && !names_.any_part) {
      if (!BeginsAPart(word.text)) Add(word.line, "no part begins with '" + word.text + "'");
      return;
    }
    if (end - begin != 1 && !words_.Is(begin, "{")) return;  // more than a literal
    const bool is_text = word.kind == Kind::kText;
    const bool truth = words_.Is(begin, "true") || words_.Is(begin, "false");
    const bool nil = words_.Is(begin, "nil"), table = words_.Is(begin, "{");
    if (word.kind == Kind::kName || (nil && optional)) return;
    const auto wrong = [&](const char* should) {
      const std::string is = is_text ? "'" + word.text + "'" : table ? "a table" : word.text;
      Add(word.line, "argument " + std::to_string(index + 1) + " of world." + function.text +
                         " is " + is + ", not " + should);
    };
    if (letter == 'n' || letter == 'l') {
      const bool number = word.kind == Kind::kNumber || (is_text && IsNumber(word.text));
      if (!number && !(letter == 'l' && truth)) wrong("a number");
    } else if (letter == 't') {
      if (!table) wrong("a table");
    } else if (truth || nil || table) {
      wrong("a name or text");
    } else if (is_text) {
      const std::string mistake = NameMistake(names_, letter, word.text);
      if (!mistake.empty()) Add(word.line, mistake);
    }
  }

  static bool IsNumber(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && end != nullptr && *end == '\0';
  }

  bool BeginsAPart(const std::string& prefix) const {
    return std::any_of(names_.parts.begin(), names_.parts.end(), [&](const std::string& part) {
      return part.compare(0, prefix.size(), prefix) == 0;
    });
  }

  const ScriptNames& names_;
  const ScriptSource& script_;
  LuaWords words_;
  std::vector<Finding>* findings_;
};

}  // namespace

void FindInScriptCalls(const ScriptNames& names, const ScriptSource& script,
                       std::vector<Finding>* findings) {
  CallCheck(names, script, findings).Run();
}

}  // namespace seam
