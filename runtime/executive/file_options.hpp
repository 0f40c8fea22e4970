// The files that the command line names.
#pragma once

#include "base/status.hpp"
#include "runtime/executive/options.hpp"

namespace flexrf {

/// Before anything is started: what is to be read is a file that can be read, what is to be written can be
/// written, nothing is a folder, or a pipe that would keep us waiting, and the report is no other's file. The
/// cause names the option. Main thread.
Status check_file_options(const Options& options);

}  // namespace flexrf
