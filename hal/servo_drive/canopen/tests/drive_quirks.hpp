#pragma once

namespace flexrf {

/// Drives that lack what others have, and are driven all the same once their configuration says so; returns
/// the number of cases that failed.
int run_drive_quirks();

}  // namespace flexrf
