#pragma once
// A line of text with figures in it, as a scene's "caption" gives it: what stands in braces is reckoned out
// for each frame, "{=v^2/(2*mu*g)}" from the scene's variables, "{body:crate.moved}" from a body's state.
// Nothing of scenes or bodies is known here: whoever shows the line says what a quantity is. Tested in
// tests/demos/formula/caption_text_test.cpp.

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace carom::demos {

/// "crate.x": a quantity of a body.
struct BodyQuantity {
  std::string body;
  std::string quantity;
};

/// A piece of plain text, or a figure with so many decimals.
struct CaptionPart {
  std::string text;  ///< As it is, or the arithmetic.
  bool is_figure = false;
  int decimals = 2;
  std::vector<BodyQuantity> bodies;  ///< In the arithmetic they are `bodyName(0)`, `bodyName(1)`, ...
};

struct CaptionText {
  std::vector<CaptionPart> parts;
  std::map<std::string, double> variables;  ///< Of the scene.

  bool empty() const { return parts.empty(); }
};

/// What is said of the whole scene: seconds, joules.
inline constexpr const char* kCaptionNames[] = {"time", "energy", "kinetic"};
/// What is said of a body: metres, m/s, rad/s, joules and degrees.
inline constexpr const char* kBodyQuantities[] = {
    "x", "y", "z", "vx", "vy", "vz", "speed", "wx", "wy", "wz", "spin", "energy", "tilt", "turned", "moved"};

/// Throws InputError that says what is wrong and what is accepted: braces, arithmetic, names and quantities;
/// not whether there is such a body.
CaptionText readCaption(std::string_view text, const std::map<std::string, double>& variables);

/// Who knows what the figures are in a frame.
struct CaptionFacts {
  std::function<double(const std::string& name)> scene;  ///< One of `kCaptionNames`.
  std::function<double(const BodyQuantity&)> body;
};
/// The line in a frame; a figure that is not finite there, such as a quotient by 0, is a dash.
std::string captionLine(const CaptionText& caption, const CaptionFacts& facts);

}  // namespace carom::demos
