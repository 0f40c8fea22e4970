// What every driver of NewInterface must do. A driver's test makes a world, which is the driver and what it
// switches, and runs the cases in it.
#pragma once

#include <memory>

#include "hal/new_interface/interface/new_interface.hpp"

namespace flexrf {

class NewInterfaceWorld {
 public:
  virtual ~NewInterfaceWorld() = default;

  virtual Status start() = 0;
  virtual NewInterface& device() = 0;
  virtual const NewInterfaceInterface::Feedback& feedback() = 0;
  /// A cycle of its thread: receive, then what the unit commands, then send.
  virtual void cycle(const bool* command) = 0;
  /// What is switched says so, whatever the driver believes.
  virtual bool is_on() = 0;
};

using MakeNewInterfaceWorld = std::unique_ptr<NewInterfaceWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_new_interface_conformance(const char* driver, MakeNewInterfaceWorld make);

}  // namespace flexrf
