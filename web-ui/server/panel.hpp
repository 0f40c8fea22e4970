// The panel of an application: what its main function brings along.
#pragma once

#include <optional>

#include "runtime/executive/observer.hpp"

namespace flexrf::panel {

/// Serves the panel of an executive's application where its options say. Prints the address to standard
/// error.
extern const ObserverPart observer;

/// For main(), before anything else: the exit code, where this process was started to be a helper of the
/// panel (it checks one password and ends); null: this is an ordinary start.
std::optional<int> run_helper(int argument_count, char** arguments);

}  // namespace flexrf::panel
