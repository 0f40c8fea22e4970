#pragma once

namespace flexrf {

/// Returns the number that failed, for main().
int run_ft300_line_cases();

}  // namespace flexrf
