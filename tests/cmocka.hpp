// CMocka, which wants these headers before its own and is C: include this instead.
#pragma once

// clang-format off
extern "C" {
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
}
// clang-format on

// Units and devices have a function fail(), and a macro spares none of that name. fail_msg() says why
// besides.
#undef fail
#undef fail_msg
#define fail_msg(message, ...)                                      \
  do {                                                              \
    print_error("ERROR: " message "\n" __VA_OPT__(, ) __VA_ARGS__); \
    _fail(__FILE__, __LINE__);                                      \
  } while (false)
