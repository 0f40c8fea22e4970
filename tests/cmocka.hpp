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
