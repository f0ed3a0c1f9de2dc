// Signals that ask a run to end: they set a flag that the loop looks at once a step, so that everything written is whole.
#pragma once

namespace nanson {

/// SIGINT, SIGTERM, SIGHUP and SIGXCPU are noted; the next one of them has its default action (ends the program at once). One that was ignored stays ignored.
/// SIGUSR1 is noted too. SIGXFSZ is ignored, so that a write beyond the file size limit fails with a reason instead of ending the program.
void catch_stop_signals();

/// The signal that came, or 0.
int stop_signal();

/// True once after every SIGUSR1, which asks for a checkpoint.
bool checkpoint_signal();

}  // namespace nanson
