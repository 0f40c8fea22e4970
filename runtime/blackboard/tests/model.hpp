// A small model checker: runs every interleaving of the atomic steps of a few threads. For tests.
#pragma once

#include <cstddef>
#include <cstring>
#include <deque>
#include <string>
#include <unordered_set>

#include "tests/cmocka.hpp"

namespace flexrf::test {

/// What exploring a model found: null when nothing is wrong in any interleaving.
struct Exploration {
  const char* violation = nullptr;
  std::size_t states = 0;
};

/// Model: a struct of bytes only, with
///   static constexpr int threads;
///   bool can_step(int thread) const;       whether the thread has a step to make and is not blocked
///   const char* step(int thread);          makes it; what is wrong, or null
///   const char* at_rest() const;           what is wrong when no thread can step any more, or null
/// Steps are sequentially consistent; which weaker order suffices is for the thread sanitizer to judge.
template <class Model>
Exploration explore(const Model& initial) {
  static_assert(alignof(Model) == 1, "compared byte by byte");
  Exploration result;
  std::unordered_set<std::string> seen;
  std::deque<Model> open{initial};
  while (!open.empty()) {
    const Model state = open.front();
    open.pop_front();
    bool moved = false;
    for (int thread = 0; thread < Model::threads; ++thread) {
      if (!state.can_step(thread)) continue;
      moved = true;
      Model next = state;
      result.violation = next.step(thread);
      if (result.violation != nullptr) return result;
      if (seen.emplace(reinterpret_cast<const char*>(&next), sizeof(next)).second) open.push_back(next);
    }
    if (!moved) result.violation = state.at_rest();
    if (result.violation != nullptr) return result;
  }
  result.states = seen.size();
  return result;
}

/// No interleaving of the model does wrong, and there are enough of them to mean something.
template <class Model>
void assert_holds(Model model) {
  const Exploration result = explore(model);
  if (result.violation != nullptr) fail_msg("%s", result.violation);
  assert_true(result.states > 100);
}

/// A model with a mistake in it is found out, by this very violation.
template <class Model>
void assert_refused(Model model, const char* violation) {
  const Exploration result = explore(model);
  assert_non_null(result.violation);
  assert_string_equal(result.violation, violation);
}

}  // namespace flexrf::test
