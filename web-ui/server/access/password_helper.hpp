// The short-lived process that finds out whether a password is right.
#pragma once

#include <optional>

namespace flexrf::panel {

/// First argument of the application's executable when it is to be that process.
inline constexpr const char* password_helper_argument = "--panel-verify-password";

/// Its exit codes; anything else means that it could not tell.
inline constexpr int exit_right_password = 42;
inline constexpr int exit_wrong_password = 43;

/// For main(), before anything else: if the first argument says so, gives up every right, reads hash and
/// password from standard input, and gives the exit code. Null: this is an ordinary start.
std::optional<int> run_password_helper(int argument_count, char** arguments);

}  // namespace flexrf::panel
