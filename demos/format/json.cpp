#include "demos/format/json.h"

#include <cmath>
#include <iterator>
#include <set>

#include <nlohmann/json.hpp>

#include "demos/format/nearest_name.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

/// Where the parser is in a text. It reads one character past a number, so a line break counts only once the
/// character after it has been read, and a value's place is that of its first letter.
struct TextPlace {
  explicit TextPlace(int first_line) : line(first_line) {}

  void take(char c) {
    if (after_break_) ++line, column_ = 0;
    after_break_ = c == '\n';
    ++column_;
    const bool in_comment = comment_ != '\0';
    if (in_comment) {
      if (comment_ == '/' ? c == '\n' : (last_ == '*' && c == '/')) comment_ = '\0';
    } else if (in_string_) {
      if (c == '"' && !escaped_) in_string_ = false;
      escaped_ = c == '\\' && !escaped_;
    } else if (last_ == '/' && (c == '/' || c == '*')) {
      comment_ = c;
    } else if (c == '"') {
      in_string_ = true, escaped_ = in_word_ = false;
      scalar = column_;
    } else if (c == '[' || c == '{') {
      bracket = column_, in_word_ = false;
    } else {
      const bool is_word = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           c == '-' || c == '+' || c == '.';
      if (is_word && !in_word_) scalar = column_;
      in_word_ = is_word;
    }
    last_ = in_comment && comment_ == '\0' ? '\0' : c;
  }

  int line;
  int scalar = 0;   ///< Column of the last text, number or word that has begun.
  int bracket = 0;  ///< Column of the last bracket that has opened.

 private:
  int column_ = 0;
  bool after_break_ = false, in_string_ = false, escaped_ = false, in_word_ = false;
  char comment_ = '\0';  ///< Its second letter; none.
  char last_ = '\0';
};

/// Hands characters to the parser and tells where it is.
class PlacedText {
 public:
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  using iterator_category = std::input_iterator_tag;

  PlacedText(const char* at, TextPlace* place) : at_(at), place_(place) {}
  reference operator*() const { return *at_; }
  PlacedText& operator++() {
    place_->take(*at_);
    ++at_;
    return *this;
  }
  bool operator==(const PlacedText& other) const { return at_ == other.at_; }
  bool operator!=(const PlacedText& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  TextPlace* place_;
};

const char* kindName(Json::Kind kind) {
  switch (kind) {
    case Json::Kind::kNull:
      return "null";
    case Json::Kind::kBoolean:
      return "a boolean";
    case Json::Kind::kNumber:
      return "a number";
    case Json::Kind::kString:
      return "a string";
    case Json::Kind::kArray:
      return "an array";
    case Json::Kind::kObject:
      return "an object";
  }
  return "";
}

/// The library's message without its own numbering: of "[json.exception.parse_error.101] parse error at line
/// 3, column 9: syntax error ..." only the end.
std::string parserReason(const std::string& message) {
  const std::size_t bracket = message.find("] ");
  std::string reason = message.substr(bracket == std::string::npos ? 0 : bracket + 2);
  const std::size_t colon = reason.find(": ");
  if (reason.rfind("parse error", 0) == 0 && colon != std::string::npos) reason.erase(0, colon + 2);
  for (char& c : reason)
    if (c == '\n') c = ' ';
  return reason;
}

nlohmann::ordered_json toLibrary(const Json& value) {
  switch (value.kind()) {
    case Json::Kind::kBoolean:
      return value.asBoolean();
    case Json::Kind::kString:
      return value.asString();
    case Json::Kind::kNumber: {
      const double number = value.asNumber();
      if (number == std::floor(number) && std::abs(number) < 1e15) return static_cast<std::int64_t>(number);
      return number;
    }
    case Json::Kind::kArray: {
      nlohmann::ordered_json array = nlohmann::ordered_json::array();
      for (const Json& item : value.items()) array.push_back(toLibrary(item));
      return array;
    }
    case Json::Kind::kObject: {
      nlohmann::ordered_json object = nlohmann::ordered_json::object();
      for (const auto& [key, member] : value.members()) object[key] = toLibrary(member);
      return object;
    }
    case Json::Kind::kNull:
      break;
  }
  return nullptr;
}

/// As much of a value as `budget` values and letters allow; for what is cut off after fewer letters.
Json abridged(const Json& value, std::size_t& budget) {
  if (budget > 0) --budget;
  Json part = value.kind() == Json::Kind::kObject ? Json::object() : Json::array();
  switch (value.kind()) {
    case Json::Kind::kString:
      return value.asString().substr(0, 4 * budget + 4);  // whole characters take up to four bytes
    case Json::Kind::kArray:
      for (std::size_t i = 0; i < value.items().size() && budget > 0; ++i)
        part.push(abridged(value.items()[i], budget));
      return part;
    case Json::Kind::kObject:
      for (std::size_t i = 0; i < value.members().size() && budget > 0; ++i)
        part.set(value.members()[i].first, abridged(value.members()[i].second, budget));
      return part;
    default:
      return value;
  }
}

}  // namespace

/// Receives the parser's events and builds the tree.
class JsonBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonBuilder(const std::string& origin, const TextPlace* at)
      : origin_(std::make_shared<const std::string>(origin)), at_(at) {}

  bool null() override { return add(Json()); }
  bool boolean(bool value) override { return add(Json(value)); }
  bool number_integer(number_integer_t value) override { return add(Json(static_cast<double>(value))); }
  bool number_unsigned(number_unsigned_t value) override { return add(Json(static_cast<double>(value))); }
  bool number_float(number_float_t value, const string_t&) override { return add(Json(value)); }
  bool string(string_t& value) override {
    requireText(value);
    return add(Json(value));
  }
  bool binary(binary_t&) override { return false; }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool end_array() override { return close(); }
  bool end_object() override { return close(); }

  bool key(string_t& name) override {
    requireText(name);
    if (!open_.back().keys.insert(name).second) fail("key \"" + name + "\" is given twice");
    open_.back().key = name;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
    fail(parserReason(error.what()));
  }

  Json take() {
    root_.place("");
    return std::move(root_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(*origin_ + ":" + std::to_string(at_->line) + ": " + reason);
  }
  /// No name of a file, and no message, goes on after a zero.
  void requireText(const std::string& text) const {
    if (text.find('\0') != std::string::npos) fail("a string holds \\u0000; accepted: text without it");
  }
  Json placed(Json value) {
    // Far beyond any scene of as many bodies as are accepted; each takes some 200 bytes.
    if (++values_ > kMostJsonValues) fail("more than " + std::to_string(kMostJsonValues) + " values");
    value.line_ = at_->line;
    const bool is_container = value.kind() == Json::Kind::kArray || value.kind() == Json::Kind::kObject;
    value.column_ = is_container ? at_->bracket : at_->scalar;
    value.origin_ = origin_;
    return value;
  }
  bool open(Json container) {
    constexpr std::size_t kDeepest =
        64;  // far beyond any scene; keeps hostile files from exhausting the stack
    if (open_.size() >= kDeepest) fail("nested deeper than " + std::to_string(kDeepest) + " levels");
    open_.push_back({placed(std::move(container)), {}, {}});
    return true;
  }
  bool close() {
    Json done = std::move(open_.back().container);
    open_.pop_back();
    return insert(std::move(done));
  }
  bool add(Json value) { return insert(placed(std::move(value))); }
  bool insert(Json value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (auto& [container, key, keys] = open_.back(); container.kind() == Json::Kind::kArray) {
      container.push(std::move(value));
    } else {
      container.set(key, std::move(value));
    }
    return true;
  }

  struct Open {
    Json container;
    std::string key;             // pending
    std::set<std::string> keys;  // of an object, so far
  };
  std::shared_ptr<const std::string> origin_;
  const TextPlace* at_;
  int values_ = 0;
  Json root_;
  std::vector<Open> open_;  // containers not closed yet
};

Json Json::array(std::vector<Json> items) {
  Json value;
  value.kind_ = Kind::kArray;
  value.items_ = std::move(items);
  return value;
}

Json Json::object(std::initializer_list<Member> members) {
  Json value;
  value.kind_ = Kind::kObject;
  value.members_ = members;
  return value;
}

Json Json::parse(std::string_view text, const std::string& origin, int first_line) {
  TextPlace place(first_line);
  JsonBuilder builder(origin, &place);
  nlohmann::json::sax_parse(PlacedText(text.data(), &place), PlacedText(text.data() + text.size(), &place),
                            &builder, nlohmann::json::input_format_t::json, true, true);
  return builder.take();
}

void Json::place(const std::string& path) {
  path_ = path;
  for (std::size_t i = 0; i < items_.size(); ++i) items_[i].place(path + "[" + std::to_string(i) + "]");
  for (auto& [key, value] : members_) value.place(path.empty() ? key : path + "." + key);
}

void Json::fail(const std::string& message) const {
  std::string where;
  if (origin_ != nullptr && !origin_->empty()) {
    where = *origin_ + ":" + std::to_string(line_) + ":";
    if (column_ > 0) where += std::to_string(column_) + ":";
    where += " ";
  }
  if (!path_.empty()) where += path_ + ": ";
  throw JsonError(where + message, {path_, line_, column_, origin_ == nullptr ? "" : *origin_});
}

Json Json::placedAs(const Json& place) const {
  Json moved = *this;
  moved.line_ = place.line_;
  moved.column_ = place.column_;
  moved.path_ = place.path_;
  moved.origin_ = place.origin_;
  return moved;
}

Json Json::movedTo(const Json& place) const {
  Json moved = placedAs(place);
  for (Json& item : moved.items_) item = item.movedTo(place);
  for (auto& [key, value] : moved.members_) value = value.movedTo(place);
  return moved;
}

Json Json::movedInto(const Json& owner, const std::string& key) const {
  Json moved = movedTo(owner);
  moved.place(owner.path_.empty() ? key : owner.path_ + "." + key);
  return moved;
}

Json Json::without(const std::string& path) const {
  Json rest = *this;
  rest.items_.clear();
  rest.members_.clear();
  for (const Json& item : items_)
    if (item.path_ != path) rest.items_.push_back(item.without(path));
  for (const auto& [key, value] : members_)
    if (value.path_ != path) rest.members_.emplace_back(key, value.without(path));
  return rest;
}

std::string Json::shown() const {
  constexpr std::size_t kLongest = 60;
  std::size_t budget = kLongest;  // a value takes a letter at least
  const std::string whole = abridged(*this, budget).text();
  if (whole.size() <= kLongest) return whole;
  std::size_t end = kLongest;  // not within a character
  while (end > 0 && (static_cast<unsigned char>(whole[end]) & 0xc0) == 0x80) --end;
  return whole.substr(0, end) + "...";
}

bool Json::asBoolean() const {
  if (kind_ != Kind::kBoolean) fail(shown() + " is " + kindName(kind_) + "; accepted: true or false");
  return boolean_;
}

double Json::asNumber() const {
  if (kind_ != Kind::kNumber) fail(shown() + " is " + kindName(kind_) + "; accepted: a finite number");
  return number_;
}

const std::string& Json::asString() const {
  if (kind_ != Kind::kString) fail(shown() + " is " + kindName(kind_) + "; accepted: a string");
  return string_;
}

const std::vector<Json>& Json::items() const {
  if (kind_ != Kind::kArray) fail(shown() + " is " + kindName(kind_) + "; accepted: an array");
  return items_;
}

const std::vector<Json::Member>& Json::members() const {
  if (kind_ != Kind::kObject) fail(shown() + " is " + kindName(kind_) + "; accepted: an object");
  return members_;
}

const Json* Json::find(std::string_view key) const {
  for (const auto& [name, value] : members())
    if (name == key) return &value;
  return nullptr;
}

const Json& Json::at(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) fail("key \"" + std::string(key) + "\" is missing");
  return *value;
}

void Json::onlyKeys(std::initializer_list<const char*> accepted) const {
  const std::vector<std::string> names(accepted.begin(), accepted.end());
  for (const auto& [key, value] : members()) {
    bool known = false;
    for (const std::string& name : names) known = known || name == key;
    if (!known) value.fail("unknown key \"" + key + "\"" + acceptedNames(key, names));
  }
}

std::string Json::text(int indent) const {
  return toLibrary(*this).dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace carom::demos
