// The time loop over a simulation.
#pragma once
#include <functional>
#include <string>

#include "engine/start.hpp"
#include "engine/step_bound.hpp"

namespace nanson {

/// What a run tells the outside; the engine itself touches no file.
struct Observer {
  std::function<void(const Simulation&)> on_step;     // after every step
  std::function<void(const Simulation&)> on_history;  // every history_every steps, at the start and at the end
  std::function<void(const Simulation&)>
      on_frame;  // every output.every, at the start and at the end; simulation.breakdown marks the broken one
  std::function<std::string()> stop;  // a reason to end after this step, or nothing
  std::function<void(const Simulation&, bool ends)>
      on_checkpoint;  // before anything is told about a sound state; `ends`: no step follows
};

/// Runs to the scene's end, from the start or from where a checkpoint was taken. Returns the status: done | breakdown | stopped, with the reason in `reason`.
std::string run(Simulation& s, const Observer& observer, std::string& reason);

/// One step of size s.state.dt.
void advance(Simulation& s);

}  // namespace nanson
