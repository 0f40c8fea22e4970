// How CMocka runs the cases of a conformance suite. To be included behind what it tests: CMocka's macros
// spare no names.
#pragma once

#include <memory>

#include "tests/cmocka.hpp"
#include "tests/verdict.hpp"

namespace flexrf {

/// Tells CMocka. It leaves the caller by a jump, which must hold nothing by then that has a destructor.
inline void conclude(Verdict result) {
  if (result == Verdict::skipped) skip();
  assert_true(result == Verdict::passed);
}

/// Runs a case in a world of its own.
template <class World>
void judge(std::unique_ptr<World> (*make)(), Verdict (*run)(World&)) {
  Verdict result = Verdict::failed;
  {
    const std::unique_ptr<World> world = make();
    result = run(*world);
  }
  conclude(result);
}

}  // namespace flexrf
