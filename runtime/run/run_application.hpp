// From the command line to the exit code.
#pragma once

#include "runtime/executive/application.hpp"
#include "runtime/executive/observer.hpp"

namespace flexrf {

/// The main function of every application: reads the command line, runs to the end, returns the exit code
/// (0 finished, 1 usage or table, 2 fault, 3 right missing, 128+n signal).
/// `observer`: who observes it, as the panel; null: nobody.
int run_application(const Application& application, int argument_count, char** arguments,
                    const ObserverPart* observer = nullptr);

}  // namespace flexrf
