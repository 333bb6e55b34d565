#include "server/script/saved_script.h"

#include <cstring>

#include "common/base/state_archive.h"
#include "common/codec/validate.h"

namespace seam {
namespace {

/// Longest error of a script, bytes, with its file: it must fit an Event.
constexpr std::size_t kErrorBytesMax = 600;

void PersistValue(StateArchive& a, ScriptValue* value, int depth) {
  a.Int(&value->kind, 0, static_cast<std::int64_t>(ScriptValue::Kind::kTable));
  switch (value->kind) {
    case ScriptValue::Kind::kBoolean: return a.Flag(&value->boolean);
    case ScriptValue::Kind::kInteger: return a.Int(&value->integer, INT64_MIN, INT64_MAX);
    case ScriptValue::Kind::kNumber: {
      std::uint64_t bits = 0;  // any number, infinite ones too
      std::memcpy(&bits, &value->number, sizeof bits);
      a.Word(&bits);
      std::memcpy(&value->number, &bits, sizeof bits);
      return;
    }
    case ScriptValue::Kind::kText: return a.Text(&value->text, kScriptRoomBytesMax);
    case ScriptValue::Kind::kTable: break;
  }
  a.Require(depth < kScriptRoomDepthMax, "tables are nested too deeply");
  a.List(&value->entries, a.ok() ? kScriptRoomBytesMax : 0, [&](auto* entry) {
    if (!a.ok()) return;
    PersistValue(a, &entry->first, kScriptRoomDepthMax);
    a.Require(entry->first.kind == ScriptValue::Kind::kInteger ||
                  entry->first.kind == ScriptValue::Kind::kText,
              "a key is neither a whole number nor a text");
    if (a.ok()) PersistValue(a, &entry->second, depth + 1);
  });
}

}  // namespace

void Persist(StateArchive& a, SavedScript* script) {
  a.Flag(&script->stopped);
  a.Text(&script->error, kErrorBytesMax);
  a.Require(!a.reading() || IsPrintable(script->error, kErrorBytesMax),
            "an error is no plain text");
  PersistValue(a, &script->room, 0);
  a.Require(script->room.kind == ScriptValue::Kind::kTable, "room is no table");
  for (std::uint64_t& word : script->random) a.Word(&word);
}

}  // namespace seam
