/// seam-lab check: mistakes in the text of a script, also where no run comes by: names that nothing
/// has, callbacks that nothing calls, loops without an end.

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>

#include "common/base/nearest.h"
#include "common/scene/part_rules.h"
#include "tests/lab/check/lua_words.h"
#include "tests/lab/check/script_check.h"

namespace seam {
namespace {

using Kind = LuaWord::Kind;

std::string Lower(const std::string& name) {
  std::string low;
  for (const char c : name) {
    if (c != '_') low += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return low;
}

const std::vector<std::string>& Callbacks() {
  static const std::vector<std::string> all(std::begin(kScriptCallbacks),
                                            std::end(kScriptCallbacks));
  return all;
}

/// Returns the callback that a name means; "": none.
std::string CallbackMeant(const std::string& name) {
  for (const std::string& callback : Callbacks()) {
    if (Lower(callback) == Lower(name)) return callback;
  }
  return NearestName(name, Callbacks());
}

class WordCheck {
 public:
  WordCheck(const ScriptNames& names, const ScriptSource& script, std::vector<Finding>* findings)
      : names_(names), script_(script), words_(script.code, script.line), findings_(findings) {}

  void Run() {
    FindDeclared();
    FindGlobals();
    FindCallbacks();
    FindComparisons();
    FindEndless();
  }

 private:
  void Add(int line, const std::string& text) {
    findings_->push_back({line, "script '" + script_.name + "': " + text});
  }

  /// Adds the names of a list "a <const>, b" from `i` on.
  void DeclareList(std::size_t i, std::set<std::string>* to) {
    while (words_.IsName(i) || words_.Is(i, "...")) {
      if (words_.IsName(i)) to->insert(words_.at(i).text);
      ++i;
      if (words_.Is(i, "<")) i += 3;
      if (!words_.Is(i, ",")) return;
      ++i;
    }
  }

  /// Scopes are not told apart: a name declared anywhere counts everywhere.
  void FindDeclared() {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (words_.Is(i, "local") && words_.Is(i + 1, "function")) {
        locals_.insert(words_.at(i + 2).text);
      } else if (words_.Is(i, "local") || words_.Is(i, "for")) {
        DeclareList(i + 1, &locals_);
      } else if (words_.Is(i, "function")) {
        std::size_t open = i + 1;
        if (words_.IsName(open) && words_.Is(open + 1, "(") && !words_.Is(i - 1, "local")) {
          assigned_.insert(words_.at(open).text);
        }
        while (open < words_.size() && !words_.Is(open, "(")) ++open;
        DeclareList(open + 1, &locals_);
        locals_.insert("self");
      } else if (words_.IsName(i) && !words_.IsField(i)) {
        // Also a key of a table, which is no harm.
        std::size_t last = i;
        while (words_.Is(last + 1, ",") && words_.IsName(last + 2)) last += 2;
        if (words_.Is(last + 1, "=")) {
          for (std::size_t k = i; k <= last; k += 2) assigned_.insert(words_.at(k).text);
        }
      }
    }
  }

  void FindGlobals() {
    std::set<std::string> told;
    std::vector<std::string> known = names_.fields.at("_G");
    known.push_back("room");
    known.insert(known.end(), locals_.begin(), locals_.end());
    known.insert(known.end(), assigned_.begin(), assigned_.end());
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const LuaWord& word = words_.at(i);
      if (!words_.IsName(i) || words_.IsField(i) || words_.Is(i - 1, "goto")) continue;
      if (words_.Is(i - 1, "::") || (words_.Is(i - 1, "<") && words_.Is(i + 1, ">"))) continue;
      if (std::find(known.begin(), known.end(), word.text) != known.end()) continue;
      if (!told.insert(word.text).second) continue;
      Add(word.line, "'" + word.text + "' is defined nowhere" + DidYouMean(word.text, known));
    }
  }

  /// Global functions that look like callbacks and that nothing calls.
  void FindCallbacks() {
    const std::vector<std::string>& callbacks = Callbacks();
    for (std::size_t i = 0; i < words_.size(); ++i) {
      std::size_t at = i + 1;
      if (words_.IsName(i) && words_.Is(i + 1, "=") && words_.Is(i + 2, "function"))
        at = i;
      else if (!words_.Is(i, "function") || !words_.IsName(at) || !words_.Is(at + 1, "("))
        continue;
      const LuaWord& name = words_.at(at);
      const bool is = std::find(callbacks.begin(), callbacks.end(), name.text) != callbacks.end();
      const bool local = words_.Is(at - 1, "local") || words_.Is(at - 2, "local");
      if (UsedBesides(at) || name.text == "exact" || name.text == "measured") continue;
      if (is && !local) continue;
      const std::string meant = is ? name.text : CallbackMeant(name.text);
      const bool looks = name.text.compare(0, 2, "on") == 0;
      if (is) {
        Add(name.line, "nothing calls '" + name.text + "': it is local");
      } else if (!meant.empty()) {
        Add(name.line, "nothing calls '" + name.text + "' (did you mean '" + meant + "'?)");
      } else if (looks && !local) {
        Add(name.line, "nothing calls '" + name.text + "'; " + Suggestion(name.text, callbacks));
      }
    }
  }

  bool UsedBesides(std::size_t definition) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const bool same = words_.IsName(i) && words_.at(i).text == words_.at(definition).text;
      if (same && i != definition && !words_.IsField(i) && !words_.Is(i - 1, "function") &&
          !words_.Is(i + 1, "=")) {
        return true;
      }
    }
    return false;
  }

  /// Comparisons of a callback's parameters with names.
  void FindComparisons() {
    const std::map<std::string, std::vector<char>> kinds = {{"on_join", {'y'}},
                                                            {"on_leave", {'y'}},
                                                            {"on_seat", {'y', 'e', 'w'}},
                                                            {"on_touch", {'p', 'p'}},
                                                            {"on_trigger", {'g', 'p'}}};
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const auto callback = kinds.find(words_.at(i + 1).text);
      if (!words_.Is(i, "function") || callback == kinds.end() || !words_.Is(i + 2, "(")) continue;
      std::map<std::string, char> parameters;
      std::size_t at = i + 3;
      for (const char kind : callback->second) {
        if (!words_.IsName(at)) break;
        parameters[words_.at(at).text] = kind;
        at += 2;
      }
      const std::size_t end = words_.EndOf(i);
      for (std::size_t k = at; k < end; ++k) {
        if (!words_.Is(k, "==") && !words_.Is(k, "~=")) continue;
        const bool after = words_.IsText(k + 1) && words_.IsName(k - 1) && !words_.IsField(k - 1);
        const bool before = words_.IsText(k - 1) && words_.IsName(k + 1) && !words_.Is(k + 2, ".");
        if (!after && !before) continue;
        const auto parameter = parameters.find(words_.at(after ? k - 1 : k + 1).text);
        if (parameter == parameters.end() || words_.Is(k + (after ? 2 : 3), "..")) continue;
        Compare(parameter->second, words_.at(after ? k + 1 : k - 1));
      }
    }
  }

  void Compare(char kind, const LuaWord& word) {
    const std::string mistake = NameMistake(names_, kind, word.text);
    if (!mistake.empty()) Add(word.line, mistake);
  }

  void FindEndless() {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const bool always = words_.Is(i, "while") && words_.Is(i + 2, "do") &&
                          (words_.Is(i + 1, "true") || words_.at(i + 1).kind == Kind::kNumber);
      const std::size_t end = always ? words_.EndOf(i + 2) : EndOfEndlessRepeat(i);
      if (end > i && !Leaves(i, end)) Add(words_.at(i).line, "this loop never ends");
    }
  }

  /// Returns the place of the "until" of the "repeat" at `i`, if its condition is false or nil
  /// alone; else `i`.
  std::size_t EndOfEndlessRepeat(std::size_t i) const {
    if (!words_.Is(i, "repeat")) return i;
    const std::size_t until = words_.EndOf(i);
    if (!words_.Is(until + 1, "false") && !words_.Is(until + 1, "nil")) return i;
    static const std::set<std::string> kGoOn = {"or", "and", "==", "~=", "..",
                                                "<",  ">",   "<=", ">="};
    return until + 2 < words_.size() && kGoOn.count(words_.at(until + 2).text) != 0 ? i : until;
  }

  /// True if a word may leave the loop between the two places.
  bool Leaves(std::size_t begin, std::size_t end) const {
    for (std::size_t k = begin; k < end; ++k) {
      const std::string& text = words_.at(k).text;
      if (words_.Is(k, "break") || words_.Is(k, "return") || words_.Is(k, "goto") ||
          (words_.IsName(k) && (text == "error" || text == "yield"))) {
        return true;
      }
    }
    return false;
  }

  const ScriptNames& names_;
  const ScriptSource& script_;
  const LuaWords words_;
  std::vector<Finding>* findings_;
  std::set<std::string> locals_, assigned_;
};

}  // namespace

void FindInScriptWords(const ScriptNames& names, const ScriptSource& script,
                       std::vector<Finding>* findings) {
  WordCheck(names, script, findings).Run();
}

}  // namespace seam
