#include "model.h"

#include <algorithm>

namespace standalone {

double LoadCurve::at(double time) const {
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double t, const auto& p) { return t < p[0]; });
  if (after == points.begin()) return points.front()[1];
  if (after == points.end()) return points.back()[1];
  const auto& [t0, f0] = *(after - 1);
  const auto& [t1, f1] = *after;
  if (steps) return time == t0 ? f0 : f1;
  return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
}

double Parameter::at(double time, const std::vector<LoadCurve>& curves) const {
  return curve < 0 ? value : value * curves.at(entries(curve)).at(time);
}

std::vector<std::string> Model::node_data() const {
  std::vector<std::string> names{"x", "y", "z", "ux", "uy", "uz", "p"};
  for (std::size_t k = 1; k <= solutes.size(); ++k) names.push_back("c" + std::to_string(k));
  names.insert(names.end(), {"Rx", "Ry", "Rz"});
  return names;
}

std::vector<std::string> Model::element_data() const {
  std::vector<std::string> names{"p", "wx", "wy", "wz"};
  for (std::size_t k = 1; k <= solutes.size() + 1; ++k) {
    const std::string j = "j" + (k <= solutes.size() ? std::to_string(k) : "");
    names.insert(names.end(), {"c" + j.substr(1), j + "x", j + "y", j + "z"});
  }
  return names;
}

}  // namespace standalone
