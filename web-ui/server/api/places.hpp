// A fixed number of places for those who wait, or what lives for a while.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace flexrf::panel {

/// Allocates nothing. Any one thread.
template <class Value, std::size_t capacity>
class Places {
 public:
  bool is_empty() const noexcept { return count_ == 0; }
  bool is_full() const noexcept { return count_ == capacity; }

  /// False: all places are taken.
  bool add(const Value& value) {
    for (std::optional<Value>& place : places_) {
      if (place) continue;
      place = value;
      ++count_;
      return true;
    }
    return false;
  }
  /// The first that `is(value)` is true of; null: none.
  template <class Is>
  Value* find(Is&& is) {
    for (std::optional<Value>& place : places_) {
      if (place && is(*place)) return &*place;
    }
    return nullptr;
  }
  /// Takes out each that `is(value)` is true of, and gives it to `then(value)`.
  template <class Is, class Then>
  void take(Is&& is, Then&& then) {
    if (is_empty()) return;
    for (std::optional<Value>& place : places_) {
      if (!place || !is(*place)) continue;
      const Value value = *place;
      place.reset();
      --count_;
      then(value);
    }
  }

 private:
  std::array<std::optional<Value>, capacity> places_{};
  std::size_t count_ = 0;
};

}  // namespace flexrf::panel
