// When a line is due, and what stands in it.
#include "io/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "io/print.hpp"

namespace nanson {
namespace {

double seconds(Progress::Clock::duration d) { return std::chrono::duration<double>(d).count(); }

constexpr std::string_view clear_line = "\r\033[K";

}  // namespace

Progress::Progress(double t0, double t1, bool quiet, std::FILE* to, Clock::time_point start)
    : t0_(t0), t1_(t1), quiet_(quiet), to_(to), terminal_(::isatty(::fileno(to)) == 1), shown_(start), shown_t_(t0) {}

void Progress::end() {
  if (!line_.empty()) std::fputs("\n", to_);
  std::fflush(to_);
  line_.clear();
}

bool Progress::due(double t, Clock::time_point now) const {
  const double since = seconds(now - shown_);
  if (t >= t1_) return tenth_ < 10;
  return terminal_ ? since >= 0.2 : int(10 * share(t)) > tenth_ || since >= 60;
}

void Progress::update(long step, double t, double dt, std::optional<double> closure, Clock::time_point now) {
  if (quiet_ || !due(t, now)) return;
  const double rate = (t - shown_t_) / std::max(seconds(now - shown_), 1e-9);
  rate_ = rate_ > 0 ? 0.7 * rate_ + 0.3 * rate : rate;
  shown_ = now;
  shown_t_ = t;
  tenth_ = std::min(10, int(10 * share(t)));
  const std::string balance = closure ? fmt::format("  dE/E {:+.1e}", *closure) : "";
  const std::string line = fmt::format("{:5.1f} %  step {:>8}  t {:.4e} s  dt {:.2e} s{}  ETA {}", 100 * share(t), step,
                                       t, dt, balance, duration_text((t1_ - t) / rate_));
  const std::string drawn = fmt::format("{}{}{}", terminal_ ? clear_line : "", line, terminal_ ? "" : "\n");
  std::fputs(drawn.c_str(), to_);
  std::fflush(to_);
  if (terminal_) line_ = line;
}

void Progress::message(std::string_view text) {
  const std::string shown = printable(text);
  const std::string drawn = line_.empty() ? shown + "\n" : fmt::format("{}{}\n{}", clear_line, shown, line_);
  std::fputs(drawn.c_str(), to_);
  std::fflush(to_);
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0) || seconds > 8.64e6) return "--";
  const long n = std::lround(seconds);
  if (n >= 3600) return fmt::format("{}h{:02}m", n / 3600, n / 60 % 60);
  return n >= 60 ? fmt::format("{}m{:02}s", n / 60, n % 60) : fmt::format("{}s", n);
}

}  // namespace nanson
