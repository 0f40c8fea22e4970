// Bytes of what the runtime makes slots, histories and queues of. config-gen knows nothing of the runtime, so
// tests/generator/footprint_test.cpp compares each with the size that the compiler gives.
#pragma once

#include <bit>
#include <cstddef>

namespace flexrf::config_gen {

constexpr std::size_t cache_line = 64;
constexpr std::size_t page = 4096;
constexpr std::size_t large_payload = 4096;  // payload of this size and more starts on a page

constexpr std::size_t round_up(std::size_t value, std::size_t to) {
  return (value + to - 1) / to * to;
}

// Control blocks.
constexpr std::size_t item_header = 16;  // sequence and time
constexpr std::size_t slot_control = 256;
constexpr std::size_t history_control = 32;
constexpr std::size_t ring_control = 192;
constexpr std::size_t ring_set = 32;  // of a queue with several writers' rings
constexpr std::size_t job_control = 192;
constexpr std::size_t job_sink = 128;  // one per writer
constexpr std::size_t job_cell = 48;
constexpr std::size_t helper_stack = 256 * 1024;  // guard page included

// Bytes of one buffer of a slot: payload and header rounded up to cache lines, or apart and to pages.
constexpr std::size_t buffer_size(std::size_t payload) {
  return payload >= large_payload ? round_up(payload, page) + cache_line
                                  : round_up(round_up(payload, 8) + item_header, cache_line);
}

constexpr std::size_t slot_memory(std::size_t payload, std::size_t buffers) {
  const std::size_t counters = 4 * buffers;  // taken, and on lines of their own given back
  const std::size_t bytes =
      round_up(buffers * buffer_size(payload) + counters, cache_line) + round_up(counters, cache_line);
  return round_up(bytes, payload >= large_payload ? page : cache_line);
}

// Of a ring: position, sequence and time before the value.
constexpr std::size_t entry_size(std::size_t payload) {
  return 3 * 8 + round_up(payload, 8);
}
constexpr std::size_t history_memory(std::size_t payload, std::size_t entries) {
  return entries * entry_size(payload);
}
constexpr std::size_t ring_memory(std::size_t payload, std::size_t capacity) {
  return std::bit_ceil(capacity) * entry_size(payload);
}
constexpr std::size_t job_memory(std::size_t payload, std::size_t capacity) {
  return round_up(capacity * job_cell, cache_line) + capacity * round_up(payload, cache_line);
}

}  // namespace flexrf::config_gen
