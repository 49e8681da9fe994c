#include "demos/formula/arithmetic.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "demos/format/formatted.h"
#include "demos/format/nearest_name.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

using std::numbers::pi;
constexpr std::size_t kLongest = 1000;
constexpr int kDeepest = 50;
constexpr double kLargestPower = 1000.0;
constexpr double kLargestAngle_deg = 1e6;

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Multiplied out: no rounding but that of the products.
double integerPower(double base, long exponent) {
  double result = 1.0;
  for (long n = std::labs(exponent); n > 0; n /= 2) {
    if (n % 2 == 1) result *= base;
    base *= base;
  }
  return exponent < 0 ? 1.0 / result : result;
}

struct Function {
  const char* name;
  std::size_t arguments;
  double (*value)(const std::vector<double>&);
};
double radians(double degrees) {
  return degrees * pi / 180.0;
}
const std::array<Function, 11> kFunctions{{
    {"sqrt", 1, [](const std::vector<double>& x) { return std::sqrt(x[0]); }},
    {"abs", 1, [](const std::vector<double>& x) { return std::abs(x[0]); }},
    {"floor", 1, [](const std::vector<double>& x) { return std::floor(x[0]); }},
    {"ceil", 1, [](const std::vector<double>& x) { return std::ceil(x[0]); }},
    {"round", 1, [](const std::vector<double>& x) { return std::round(x[0]); }},
    {"sin", 1, [](const std::vector<double>& x) { return sineCosine(radians(x[0])).sine; }},
    {"cos", 1, [](const std::vector<double>& x) { return sineCosine(radians(x[0])).cosine; }},
    {"tan", 1,
     [](const std::vector<double>& x) {
       const SineCosine both = sineCosine(radians(x[0]));
       return both.sine / both.cosine;
     }},
    {"min", 2, [](const std::vector<double>& x) { return std::min(x[0], x[1]); }},
    {"max", 2, [](const std::vector<double>& x) { return std::max(x[0], x[1]); }},
    {"mod", 2, [](const std::vector<double>& x) { return x[0] - x[1] * std::floor(x[0] / x[1]); }},
}};

const Function* functionOf(std::string_view name) {
  for (const Function& function : kFunctions)
    if (name == function.name) return &function;
  return nullptr;
}

class Reader {
 public:
  Reader(std::string_view text, const NamedNumber& numberOf, const KnownNames& namesOf)
      : text_(text), numberOf_(numberOf), namesOf_(namesOf) {}

  double whole() {
    if (text_.size() > kLongest) fail("longer than " + std::to_string(kLongest) + " letters");
    const double value = sum();
    skipSpace();
    if (at_ < text_.size()) fail("\"" + std::string(text_.substr(at_)) + "\" is left over");
    if (!std::isfinite(value)) fail("the result is no finite number");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(
        reason + " (letter " + std::to_string(at_ + 1) + ")" +
        "; accepted: numbers, names of \"set\" and \"for\", + - * / % ^ ( ), pi, sqrt, abs, floor, "
        "ceil, round, min, max, mod, and sin, cos, tan of degrees");
  }
  void skipSpace() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool takes(char c) {
    skipSpace();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void deeper() {
    if (++depth_ > kDeepest) fail(formatted("nested deeper than %d levels", kDeepest));
  }

  double sum() {
    deeper();
    double value = product();
    for (;;) {
      if (takes('+'))
        value += product();
      else if (takes('-'))
        value -= product();
      else
        break;
    }
    --depth_;
    return value;
  }

  double product() {
    double value = sign();
    for (;;) {
      if (takes('*')) {
        value *= sign();
      } else if (takes('/')) {
        value /= divisor();
      } else if (takes('%')) {
        const double by = divisor();
        value -= by * std::floor(value / by);
      } else {
        return value;
      }
    }
  }
  double divisor() {
    const double value = sign();
    if (value == 0.0) fail("division by zero");
    return value;
  }

  double sign() {
    deeper();
    const double value = takes('-') ? -sign() : takes('+') ? sign() : power();
    --depth_;
    return value;
  }

  double power() {
    const double base = atom();
    if (!takes('^')) return base;
    const double exponent = sign();
    if (exponent != std::floor(exponent) || std::abs(exponent) > kLargestPower)
      fail("only whole powers can be reckoned");
    return integerPower(base, static_cast<long>(exponent));
  }

  double atom() {
    skipSpace();
    if (at_ >= text_.size()) fail("it ends where a number should be");
    if (takes('(')) {
      const double value = sum();
      if (!takes(')')) fail("a \")\" is missing");
      return value;
    }
    if (isDigit(text_[at_]) || text_[at_] == '.') return number();
    if (isLetter(text_[at_])) return named();
    fail(std::string("\"") + text_[at_] + "\" is no number");
  }

  double number() {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("no number can be read");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  double named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]))) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    if (const Function* function = functionOf(name)) return call(*function);
    if (name == "pi") return pi;
    if (const std::optional<double> value = numberOf_(name)) return *value;
    at_ = begin;
    throw InputError("unknown name \"" + name + "\"" + acceptedNames(name, namesOf_()));
  }

  double call(const Function& function) {
    if (!takes('(')) fail(std::string("a \"(\" is missing after ") + function.name);
    std::vector<double> arguments{sum()};
    while (takes(',')) arguments.push_back(sum());
    if (!takes(')')) fail("a \")\" is missing");
    if (arguments.size() != function.arguments)
      fail(std::string(function.name) + " takes " + std::to_string(function.arguments) +
           (function.arguments == 1 ? " number" : " numbers"));
    const std::string_view name = function.name;
    if ((name == "sin" || name == "cos" || name == "tan") && std::abs(arguments[0]) > kLargestAngle_deg)
      fail("the angle is beyond a million degrees");
    return function.value(arguments);
  }

  std::string_view text_;
  const NamedNumber& numberOf_;
  const KnownNames& namesOf_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

double evaluate(std::string_view text, const NamedNumber& numberOf, const KnownNames& namesOf) {
  return Reader(text, numberOf, namesOf).whole();
}

bool isArithmeticName(std::string_view text) {
  return !text.empty() && isLetter(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return isLetter(c) || isDigit(c); });
}

bool isArithmeticWord(std::string_view name) {
  return name == "pi" || functionOf(name) != nullptr;
}

}  // namespace carom::demos
