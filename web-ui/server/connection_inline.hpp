// Templates of connection.hpp.
#pragma once

#include <utility>

#include "web-ui/server/connection.hpp"

namespace flexrf::panel {

template <class Function>
auto Connection::under_way(Function function) {
  ++under_way_;
  return HandlerIn(handler_memory_, [this, function = std::move(function)](auto... arguments) {
    --under_way_;
    if (state_ == State::shut) {
      release_if_idle();
    } else {
      function(arguments...);
    }
  });
}

}  // namespace flexrf::panel
