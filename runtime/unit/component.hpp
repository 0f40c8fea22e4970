// What units and devices have in common: a name, parameters, a fault with its cause.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>

#include "base/status.hpp"
#include "runtime/core/parameter_descriptor.hpp"
#include "runtime/unit/port_binding.hpp"
#include "runtime/unit/restraint.hpp"

namespace flexrf {

/// A component's number, as in requests: units in table order, then devices.
using ComponentIndex = std::uint16_t;

class Component {
 public:
  Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  virtual ~Component() = default;

  /// Open, allocate, seed. Lifecycle thread; may block within initialise_timeout. Configuration is valid
  /// here.
  virtual Status initialise() { return {}; }
  /// Undo initialise(). Lifecycle thread, after the last step.
  virtual void stop() {}

  const char* name() const noexcept { return name_; }
  const Status& fault() const noexcept { return fault_; }

  /// What is declared of it, with ranges as the application's table narrows them: what checks and shows
  /// values goes by this.
  const ComponentType& type_in_force() const noexcept {
    return type_in_force_ != nullptr ? *type_in_force_ : component_type();
  }

  // ---- for the executive; the generated base implements them

  virtual const ComponentType& component_type() const noexcept = 0;
  virtual ParameterMemory parameter_memory() noexcept = 0;
  /// The author's accept(proposed), untyped: may refuse a set of runtime parameters as a whole. Owning
  /// thread.
  virtual Status accept_runtime(const void* /*proposed*/) noexcept { return {}; }
  /// What its n-th input (of a slot, in the order of its table; of a range: its member) read since it was
  /// connected: a unit when it was constructed, a device also when it was initialised. Any thread.
  virtual InputCounters input_counters(std::size_t /*input*/, std::size_t /*member*/) const noexcept {
    return {};
  }

  void set_name(const char* name) noexcept { name_ = name; }
  /// `type` outlives the component. Before anything else asks for it.
  void set_type_in_force(const ComponentType& type) noexcept { type_in_force_ = &type; }
  void set_fault(const Status& cause) noexcept { fault_ = cause; }
  void clear_fault() noexcept { fault_ = {}; }
  /// restrain() said something since it was asked last. Owning thread.
  bool is_restrained() const noexcept { return restraint_.reason != nullptr; }
  /// What that was. Owning thread.
  Restraint take_restraint() noexcept { return std::exchange(restraint_, Restraint{}); }

 protected:
  /// Puts this component in fault after the current call returns; `cause` is what the operator reads.
  void fail(const Status& cause) noexcept {
    if (fault_.is_ok()) fault_ = cause;
  }
  /// This cycle it does not do all that it was commanded: a command is clamped, refused or without effect.
  /// Said in each cycle in which that is so. The operator sees it on the component's page, the log says it
  /// once. Not for inhibition, which the cell tells. `reason` lives for ever. Owning thread; no cost worth
  /// counting.
  void restrain(const char* reason, double asked = std::numeric_limits<double>::quiet_NaN(),
                double given = std::numeric_limits<double>::quiet_NaN()) noexcept {
    restraint_ = {reason, asked, given};
  }
  /// The same; nothing where there is none.
  void restrain(const Restraint& restraint) noexcept {
    if (restraint.reason != nullptr) restraint_ = restraint;
  }

 private:
  const char* name_ = "";
  const ComponentType* type_in_force_ = nullptr;  // null: its own
  Status fault_;
  Restraint restraint_;
};

}  // namespace flexrf
