#pragma once

namespace flexrf {

/// Drives that lack what others have, and moments that are awkward for an axis. The number of failed cases.
int run_odd_drives();

}  // namespace flexrf
