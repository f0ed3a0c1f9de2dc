// The progress line: on a terminal redrawn a few times a second, in a log a line every 10 % or 60 s.
#pragma once
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace nanson {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// Simulated time runs from t0 to t1; `quiet` shows nothing but messages.
  Progress(double t0, double t1, bool quiet, std::FILE* to = stderr, Clock::time_point start = Clock::now());
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// To be called every step. `closure` is the relative error of the energy balance where it is known.
  void update(long step, double t, double dt, std::optional<double> closure, Clock::time_point now = Clock::now());

  /// A line of its own, above the progress line; shown with `quiet` too.
  void message(std::string_view text);

  /// Leaves the progress line as it stands: what comes next begins on a line of its own.
  void end();

 private:
  bool due(double t, Clock::time_point now) const;
  double share(double t) const { return t < t1_ ? (t - t0_) / (t1_ - t0_) : 1.0; }

  double t0_, t1_;
  bool quiet_;
  std::FILE* to_;
  bool terminal_;
  std::string line_;  // what stands on the terminal's last line
  Clock::time_point shown_;
  double shown_t_;
  int tenth_ = -1;   // tenths of the way at the last line
  double rate_ = 0;  // simulated seconds a wall second, smoothed: a single slow step must not upset the estimate
};

/// 59s, 3m07s, 2h05m; -- when it is not a time or beyond 100 days.
std::string duration_text(double seconds);

}  // namespace nanson
