#pragma once

namespace flexrf {

/// That the list of objects by which EDS files are checked is what the driver asks of a drive; returns the
/// number of cases that failed.
int run_asked_objects();

}  // namespace flexrf
