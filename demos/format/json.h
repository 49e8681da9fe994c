#pragma once
// JSON values that remember where they stood, so that every complaint about a file names its line and JSON
// path. json.cpp is the only file that names the JSON library. Comments (// and /* */) are accepted; keys
// given twice are not. Tested in tests/demos/format/json_test.cpp.

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/foundation/contract.h"

namespace carom::demos {

/// A file of more values is refused.
inline constexpr int kMostJsonValues = 3000000;

/// What is wrong with a value, and where it is.
class JsonError : public InputError {
 public:
  struct Spot {
    std::string path;
    int line = 0;
    int column = 0;
    std::string origin;  ///< The file's name.
  };
  JsonError(const std::string& message, Spot where) : InputError(message), spot(std::move(where)) {}
  Spot spot;
};

class Json {
 public:
  enum class Kind { kNull, kBoolean, kNumber, kString, kArray, kObject };
  using Member = std::pair<std::string, Json>;

  Json() = default;
  Json(bool value) : kind_(Kind::kBoolean), boolean_(value) {}
  Json(double value) : kind_(Kind::kNumber), number_(value) {}
  Json(int value) : Json(static_cast<double>(value)) {}
  Json(std::string value) : kind_(Kind::kString), string_(std::move(value)) {}
  Json(const char* value) : Json(std::string(value)) {}
  static Json array(std::vector<Json> items = {});
  static Json object(std::initializer_list<Member> members = {});

  /// Parses a text; `origin` stands for the file's name in messages, `first_line` for where in it the text
  /// begins. Throws InputError for what is no JSON, nested too deeply, or of too many values.
  static Json parse(std::string_view text, const std::string& origin, int first_line = 1);

  Kind kind() const { return kind_; }
  int line() const { return line_; }
  int column() const { return column_; }
  const std::string& path() const { return path_; }

  // Reading: each throws InputError, with this value's place, when the value is of another kind.
  bool asBoolean() const;
  double asNumber() const;
  const std::string& asString() const;
  const std::vector<Json>& items() const;
  const std::vector<Member>& members() const;

  /// The member of that name, or nullptr. The value must be an object.
  const Json* find(std::string_view key) const;
  /// The member of that name; throws InputError when it is missing.
  const Json& at(std::string_view key) const;
  /// Throws InputError for the first member whose key is not one of these, with the nearest that is.
  void onlyKeys(std::initializer_list<const char*> accepted) const;

  /// Throws JsonError: "file:line:column: path: message".
  [[noreturn]] void fail(const std::string& message) const;
  /// The value as a person would write it, shortened, for messages.
  std::string shown() const;

  /// This value at the place of another: what stands for it is complained of there.
  Json movedTo(const Json& place) const;
  /// This value at the place that a member of that name would have in another.
  Json movedInto(const Json& owner, const std::string& key) const;
  /// The same without what is in it, which stays where it was written.
  Json placedAs(const Json& place) const;

  // Writing.
  void push(Json item) { items_.push_back(std::move(item)); }
  void set(std::string key, Json value) { members_.emplace_back(std::move(key), std::move(value)); }
  /// `indent` < 0 writes one line. Numbers are written so that reading them gives the same bits.
  std::string text(int indent = -1) const;
  /// Without the members and items that stood at this path; of an item, those of its list move up.
  Json without(const std::string& path) const;

 private:
  friend class JsonBuilder;
  void place(const std::string& path);

  Kind kind_ = Kind::kNull;
  bool boolean_ = false;
  double number_ = 0.0;
  std::string string_;
  std::vector<Json> items_;
  std::vector<Member> members_;
  int line_ = 0;
  int column_ = 0;  ///< Of its first letter, from 1; 0 for a value of no file.
  std::string path_;
  std::shared_ptr<const std::string> origin_;  ///< One for all values of a text.
};

}  // namespace carom::demos
