// The checks of a resolved application, one file per family, and the words they share.
#pragma once

#include <string>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

void check_class_names(const Model& model, Diagnostics& diagnostics);  // of any run, not only applications
void check_slots(const Model& model, Diagnostics& diagnostics);
void check_queues(const Model& model, Diagnostics& diagnostics);
void check_inputs(const Model& model, Diagnostics& diagnostics);
void check_devices(const Model& model, Diagnostics& diagnostics);
void check_options(const Model& model, Diagnostics& diagnostics);
void check_threads(const Model& model, Diagnostics& diagnostics);
void check_triggers(const Model& model, Diagnostics& diagnostics);
void check_cycles(const Model& model, Diagnostics& diagnostics);
void check_memory(const Model& model, Diagnostics& diagnostics);
// Sets Thread::response_time.
void check_schedule(Model& model, Diagnostics& diagnostics);

// "output 'target' of unit 'jog'", "output 'joints' of driver 'simulated' of device 'arm'"
std::string describe(const Model& model, const Writer& writer);
// "input 'target' of unit 'robot'"
std::string describe(const Model& model, const InputReference& input);
Position declared_at(const Model& model, const Writer& writer);

// The shortest time between two releases of a thread, 0 when nothing bounds it.
Nanoseconds interval_of(const Thread& thread);

// While it lives, errors name the group instance in which `name` ("axis[2].drive") lies.
class InInstance {
 public:
  InInstance(Diagnostics& diagnostics, const Model& model, const std::string& name);
  ~InInstance();
  InInstance(const InInstance&) = delete;
  InInstance& operator=(const InInstance&) = delete;

 private:
  Diagnostics& diagnostics_;
  bool active_ = false;
};

}  // namespace flexrf::config_gen
