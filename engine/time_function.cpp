// Named time functions.
#include "engine/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nanson {

double value_at(const TimeFunction& f, double t) {
  switch (f.kind) {
    case TimeKind::constant: return 1;
    case TimeKind::ramp: return std::clamp(t / f.until, 0.0, 1.0);
    case TimeKind::sine: return std::sin(2 * std::numbers::pi * f.frequency * t + f.phase);
    case TimeKind::pulse: return t >= f.from && t < f.until ? 1 : 0;
    case TimeKind::logistic: {
      if (t > f.until) return 0;
      const double g = std::exp(-std::abs(f.rate * (f.centre - t)));  // the factor is even in its argument: no overflow
      return 4 * g / ((1 + g) * (1 + g));
    }
    case TimeKind::table: {
      const auto after = std::upper_bound(f.points.begin(), f.points.end(), t,
                                          [](double s, const auto& p) { return s < p.first; });
      if (after == f.points.begin()) return f.points.front().second;
      if (after == f.points.end()) return f.points.back().second;
      const auto before = after - 1;
      return before->second + (after->second - before->second) * (t - before->first) / (after->first - before->first);
    }
  }
  return 1;
}

}  // namespace nanson
