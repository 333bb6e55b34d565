#pragma once
/// What a script can see and do of a room: the interface between Lua and the server.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "common/scene/toml/toml_tree.h"
#include "common/scene/types.h"

namespace seam {

/// A request of a script that cannot be done; it becomes an error in the script, at its line.
class ScriptRefusal : public std::runtime_error {
 public:
  explicit ScriptRefusal(const std::string& what) : std::runtime_error(what) {}
};

/// Parts, joints and players by their names of the scene. Functions throw ScriptRefusal (or
/// OperatorError "file:line: what", for parts and joints that a scene would not allow either) and
/// change nothing then. Strings that are returned live until the next call.
class ScriptHost {
 public:
  virtual ~ScriptHost() = default;

  virtual std::int64_t Tick() const = 0;
  virtual float dt() const = 0;  ///< s per tick

  /// False when there is no such part (any more).
  virtual bool ReadPart(const std::string& part, BodyState* state) const = 0;
  virtual std::size_t PartCount() const = 0;  ///< parts that were there; some may be gone
  virtual const std::string& PartName(std::size_t index) const = 0;
  virtual std::size_t PlayerCount() const = 0;
  virtual const std::string& PlayerName(std::size_t player) const = 0;
  virtual bool Present(const std::string& player) const = 0;
  virtual Input ReadInput(const std::string& player) const = 0;

  /// A push of `impulse` N s at the part's assembly's centre of mass, `why` it is given its name.
  virtual void Push(const std::string& part, const Vec2& impulse, const std::string& why) = 0;
  /// The active character of this name goes limp for `seconds`, above 0; below 0: it ends.
  virtual void Limp(const std::string& character, float seconds) = 0;
  /// Sets the bricks within `radius` m free that it would make faster than their strength, thrown
  /// outwards with up to `speed` m/s; what the blast sees is pushed by up to `impulse` N s for each
  /// metre of silhouette.
  virtual void Blast(const Vec2& centre, float radius, float speed, float impulse) = 0;
  /// `table`: as a [[part]] or [[joint]] of the scene, without `repeat`; its line is the script's.
  virtual void AddPart(const TomlNode& table) = 0;
  virtual void AddJoint(const TomlNode& table) = 0;
  /// Makes two parts one body as they are now; it holds up to `strength` N (0: for ever).
  virtual void Weld(const std::string& a, const std::string& b, float strength) = 0;
  /// Ends what is rigid between the two.
  virtual void Unweld(const std::string& a, const std::string& b) = 0;
  virtual void RemovePart(const std::string& part) = 0;
  virtual void RemoveJoint(const std::string& joint) = 0;

  /// A value of a player or part ("score", "health", ...: metadata.h); 0 when it was never set.
  virtual float Get(const std::string& subject, const std::string& key) const = 0;
  virtual void Set(const std::string& subject, const std::string& key, float value) = 0;

  /// A line of text for people, as an event of the bus.
  virtual void Say(const std::string& text) = 0;
};

/// `[[kind]]` and the table's entries, as a scene writes them. Throws ScriptRefusal for what cannot
/// be written so.
std::string ToToml(const std::string& kind, const TomlNode& table);

}  // namespace seam
