// What the driver says when the kernel or libgpiod refuses, whichever version that is.
#pragma once

#include "base/status.hpp"

namespace flexrf {

/// `error`: an errno. Lifecycle thread.
Status cannot_open_chip(const char* chip, int error);
Status has_no_line(const char* chip, const char* line);
Status has_fewer_lines(const char* chip, const char* line, unsigned count);
Status is_a_double_name(const char* chip, const char* line, unsigned first, unsigned second);
/// `user`: who has the line; null: not known.
Status cannot_request_line(const char* chip, const char* line, const char* user, int error);

}  // namespace flexrf
