// A sum whose error does not grow with the number of its terms: equal ones are rounded the same way each time, so a plain sum over 6e6 tets is off by 1e-10.
#pragma once
#include <cmath>

namespace nanson {

/// What each addition rounds away is summed beside it (Neumaier, Z. angew. Math. Mech. 54 (1974), 39-51).
class CompensatedSum {
 public:
  CompensatedSum& operator+=(double x) {
    const double sum = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
    return *this;
  }
  operator double() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

}  // namespace nanson
