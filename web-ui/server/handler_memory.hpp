// Memory for the operations that one connection has under way, so that none comes from the system.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

namespace flexrf::panel {

/// A few blocks of fixed size. What is larger, or one too many, comes from the heap: nothing fails, and the
/// test that counts allocations notices.
class HandlerMemory {
 public:
  HandlerMemory() = default;
  HandlerMemory(const HandlerMemory&) = delete;
  HandlerMemory& operator=(const HandlerMemory&) = delete;

  void* allocate(std::size_t size) {
    if (size <= block_size) {
      for (std::size_t i = 0; i < blocks; ++i) {
        if ((used_ & (1U << i)) != 0) continue;
        used_ |= 1U << i;
        return memory_[i].bytes;
      }
    }
    return ::operator new(size);
  }

  void free(void* memory) noexcept {
    for (std::size_t i = 0; i < blocks; ++i) {
      if (memory != memory_[i].bytes) continue;
      used_ &= ~(1U << i);
      return;
    }
    ::operator delete(memory);
  }

 private:
  // A live connection's read, write, close, and what each composed operation starts within.
  static constexpr std::size_t blocks = 8;
  static constexpr std::size_t block_size = 1024;

  struct Block {
    alignas(std::max_align_t) std::byte bytes[block_size];
  };

  std::array<Block, blocks> memory_;
  std::uint32_t used_ = 0;
};

/// The allocator that Asio and Beast find with a handler.
template <class Value>
class HandlerAllocator {
 public:
  using value_type = Value;

  explicit HandlerAllocator(HandlerMemory& memory) noexcept : memory_(&memory) {}
  template <class Other>
  HandlerAllocator(const HandlerAllocator<Other>& other) noexcept : memory_(other.memory_) {}

  Value* allocate(std::size_t count) const {
    return static_cast<Value*>(memory_->allocate(sizeof(Value) * count));
  }
  void deallocate(Value* memory, std::size_t) const noexcept { memory_->free(memory); }

  template <class Other>
  bool operator==(const HandlerAllocator<Other>& other) const noexcept {
    return memory_ == other.memory_;
  }

 private:
  template <class Other>
  friend class HandlerAllocator;

  HandlerMemory* memory_;
};

/// A handler whose operation lives in this memory.
template <class Function>
class HandlerIn {
 public:
  using allocator_type = HandlerAllocator<void>;

  HandlerIn(HandlerMemory& memory, Function function) : memory_(&memory), function_(std::move(function)) {}
  allocator_type get_allocator() const noexcept { return allocator_type{*memory_}; }
  template <class... Arguments>
  void operator()(Arguments&&... arguments) {
    function_(std::forward<Arguments>(arguments)...);
  }

 private:
  HandlerMemory* memory_;
  Function function_;
};

}  // namespace flexrf::panel
