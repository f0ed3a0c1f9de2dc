// Signals that ask a run to end: they set a flag that the loop looks at once a step, so that everything written is whole.
#pragma once

namespace nanson {

/// SIGINT, SIGTERM, SIGHUP and SIGXCPU are noted; the next one of them has its default action (ends the program at once). One that was ignored stays ignored.
/// SIGXFSZ is ignored, so that a write beyond the file size limit fails with a reason instead of ending the program.
void catch_stop_signals();

/// The signal that came, or 0.
int stop_signal();

}  // namespace nanson
