#pragma once
// What a run found: at most one finding of each kind, the worst.

#include <sstream>
#include <string>
#include <vector>

namespace carom::explore {

/// Something that must not happen. `figure`: how bad, in the unit of the kind (README of this folder).
struct Finding {
  std::string kind;
  double figure = 0.0;
  int step = 0;  ///< After which it was seen at that figure; 0: at the start.
  std::string detail;
};

class Findings {
 public:
  void add(const char* kind, double figure, int step, const std::string& detail) {
    for (Finding& known : list_)
      if (known.kind == kind) {
        if (figure > known.figure) known = {kind, figure, step, detail};
        return;
      }
    list_.push_back({kind, figure, step, detail});
  }
  const std::vector<Finding>& list() const { return list_; }

 private:
  std::vector<Finding> list_;
};

inline std::string shown(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}

}  // namespace carom::explore
