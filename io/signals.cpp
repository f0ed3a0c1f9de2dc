// The handler and its flag.
#include "io/signals.hpp"

#include <array>
#include <csignal>

namespace nanson {
namespace {

constexpr std::array stopping{SIGINT, SIGTERM, SIGHUP, SIGXCPU};
volatile std::sig_atomic_t received = 0;
volatile std::sig_atomic_t caught[stopping.size()] =
    {};  // those that were not ignored when the run began (nohup, background jobs)

volatile std::sig_atomic_t asked = 0;

extern "C" void note_checkpoint(int) { asked = 1; }

extern "C" void note_signal(int signal) {
  received = signal;
  for (std::size_t i = 0; i < stopping.size(); ++i)
    if (caught[i]) std::signal(stopping[i], SIG_DFL);
}

}  // namespace

void catch_stop_signals() {
  received = 0;
  for (std::size_t i = 0; i < stopping.size(); ++i) {
    struct sigaction before {};
    struct sigaction now {};
    now.sa_handler = note_signal;
    now.sa_flags = SA_RESTART;
    for (const int other : stopping) sigaddset(&now.sa_mask, other);
    sigaction(stopping[i], nullptr, &before);
    caught[i] = before.sa_handler != SIG_IGN;
    if (caught[i]) sigaction(stopping[i], &now, nullptr);
  }
  struct sigaction checkpoint {};
  checkpoint.sa_handler = note_checkpoint;
  checkpoint.sa_flags = SA_RESTART;
  asked = 0;
  sigaction(SIGUSR1, &checkpoint, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

int stop_signal() { return received; }

bool checkpoint_signal() {
  const bool was = asked != 0;
  asked = 0;
  return was;
}

}  // namespace nanson
