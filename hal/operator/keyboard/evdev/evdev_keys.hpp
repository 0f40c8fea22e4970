#pragma once

#include "types/key_event.hpp"

namespace flexrf {

/// What a key of the kernel's (KEY_*) is, by its place on a US keyboard, with shift or without; Key::none:
/// one that is nothing here, as a modifier.
KeyEvent key_of_code(unsigned code, bool shift) noexcept;

}  // namespace flexrf
