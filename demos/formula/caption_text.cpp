#include "demos/formula/caption_text.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "demos/format/formatted.h"
#include "demos/format/nearest_name.h"
#include "demos/formula/arithmetic.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::size_t kLongest = 400;
constexpr const char* kNotFinite = "–";
constexpr const char* kAccepted =
    "; accepted: \"{=arithmetic}\", \"{body:NAME.quantity}\", each with \":d\" before the \"}\" for d "
    "decimals";

/// No scene's variable: they do not begin so.
std::string bodyName(std::size_t index) {
  return "__body" + std::to_string(index);
}

BodyQuantity readQuantity(const std::string& text) {
  const std::size_t dot = text.rfind('.');
  if (dot == std::string::npos || dot == 0)
    throw InputError("\"" + text + "\" is no NAME.quantity" + kAccepted);
  const BodyQuantity quantity{text.substr(0, dot), text.substr(dot + 1)};
  const std::vector<std::string> names(std::begin(kBodyQuantities), std::end(kBodyQuantities));
  if (std::find(names.begin(), names.end(), quantity.quantity) == names.end())
    throw InputError("unknown quantity \"" + quantity.quantity + "\"" +
                     acceptedNames(quantity.quantity, names));
  return quantity;
}

/// The end of what the "[" at `open` opens; names of copies have brackets of their own.
std::size_t closingBracket(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    if (text[at] == '[') ++depth;
    if (text[at] == ']' && --depth == 0) return at;
  }
  throw InputError("a \"]\" is missing after \"" + text.substr(open) + "\"; accepted: \"[NAME.quantity]\"");
}

/// "[crate.x] - 1" becomes "__body0 - 1".
void takeBodies(const std::string& written, CaptionPart& part) {
  for (std::size_t at = 0; at < written.size();) {
    const std::size_t open = written.find('[', at);
    part.text += written.substr(at, open == std::string::npos ? open : open - at);
    if (open == std::string::npos) break;
    const std::size_t close = closingBracket(written, open);
    part.text += bodyName(part.bodies.size());
    part.bodies.push_back(readQuantity(written.substr(open + 1, close - open - 1)));
    at = close + 1;
  }
}

/// Takes ":3" off the end.
int takeDecimals(std::string& inner) {
  constexpr int kUsual = 2;
  if (inner.size() < 2 || inner[inner.size() - 2] != ':') return kUsual;
  const char digit = inner.back();
  if (digit < '0' || digit > '9') return kUsual;
  inner.resize(inner.size() - 2);
  return digit - '0';
}

CaptionPart readFigure(std::string inner) {
  constexpr std::string_view kBody = "body:";
  CaptionPart part;
  part.is_figure = true;
  part.decimals = takeDecimals(inner);
  if (inner.starts_with("=")) {
    takeBodies(inner.substr(1), part);
  } else if (inner.starts_with(kBody)) {
    part.text = bodyName(0);
    part.bodies.push_back(readQuantity(inner.substr(kBody.size())));
  } else {
    throw InputError("\"{" + inner + "}\" is no figure" + kAccepted);
  }
  return part;
}

double valueOf(const CaptionPart& part, const CaptionText& caption, const CaptionFacts& facts) {
  const KnownNames namesOf = [&] {
    std::vector<std::string> names(std::begin(kCaptionNames), std::end(kCaptionNames));
    for (const auto& [name, unused] : caption.variables) names.push_back(name);
    return names;
  };
  const NamedNumber numberOf = [&](const std::string& name) -> std::optional<double> {
    for (std::size_t i = 0; i < part.bodies.size(); ++i)
      if (name == bodyName(i)) return facts.body(part.bodies[i]);
    const auto variable = caption.variables.find(name);
    const bool is_set = variable != caption.variables.end();
    if (std::find(std::begin(kCaptionNames), std::end(kCaptionNames), name) != std::end(kCaptionNames)) {
      if (is_set)
        throw InputError(
            "\"" + name +
            "\" is a variable of the scene and the caption's own figure; accepted: a variable of "
            "another name");
      return facts.scene(name);
    }
    return is_set ? std::optional(variable->second) : std::nullopt;
  };
  return evaluate(part.text, numberOf, namesOf);
}

/// "-0.00" is "0.00".
std::string shownNumber(double value, int decimals) {
  std::string text = formatted("%.*f", decimals, value);
  if (text[0] == '-' && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  return text;
}

}  // namespace

CaptionText readCaption(std::string_view text, const std::map<std::string, double>& variables) {
  if (text.size() > kLongest)
    throw InputError(std::to_string(text.size()) + " letters; accepted: at most " + std::to_string(kLongest));
  if (text.find('\n') != std::string_view::npos) throw InputError("more than one line; accepted: one");
  CaptionText caption;
  caption.variables = variables;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find('{', at), text.size());
    if (open > at) caption.parts.push_back({std::string(text.substr(at, open - at)), false, 0, {}});
    if (open == text.size()) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string_view::npos) throw InputError(std::string("a \"}\" is missing") + kAccepted);
    caption.parts.push_back(readFigure(std::string(text.substr(open + 1, close - open - 1))));
    at = close + 1;
  }
  // Whether it can be reckoned, with any figures for what is measured.
  constexpr double kSome = 0.7310585786;
  const CaptionFacts some{[](const std::string&) { return kSome; },
                          [](const BodyQuantity&) { return kSome; }};
  for (const CaptionPart& part : caption.parts)
    if (part.is_figure) valueOf(part, caption, some);
  return caption;
}

std::string captionLine(const CaptionText& caption, const CaptionFacts& facts) {
  std::string line;
  for (const CaptionPart& part : caption.parts) {
    if (!part.is_figure) {
      line += part.text;
      continue;
    }
    try {
      line += shownNumber(valueOf(part, caption, facts), part.decimals);
    } catch (const InputError&) {
      line += kNotFinite;
    }
  }
  return line;
}

}  // namespace carom::demos
