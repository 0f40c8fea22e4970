// For tests in the guest: files of devices, and waiting for what a device does. Nothing is waited for without
// an end; what does not come fails the test. A process that ends closes what a failed test left open.
#pragma once

namespace flexrf {

/// Opens a file for reading and writing, not blocking. The test fails, and says which file it was, when that
/// is refused.
int open_device(const char* path);

/// Waits until the file has something to read or to take as urgent (an event), 30 s at most, else fails the
/// test.
void await_input(int descriptor);

/// Reads exactly `bytes`, waiting for them as above.
void read_exactly(int descriptor, void* into, unsigned long bytes);

}  // namespace flexrf
