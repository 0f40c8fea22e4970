#pragma once

#include "porter_unit.hpp"

namespace flexrf::user {

class Porter final : public PorterUnit {
 public:
  void step(const Tick& /*tick*/) override {
    for (const SocketSession session : door->sessions()) {
      while (const std::optional<std::string_view> line = door->read_line(session)) {
        if (helper->write_line(*line)) visitor_ = session;
      }
    }
    ProcessLine line;
    while (helper->read_line(line)) door->write_line(visitor_, line.content_view());
  }

 private:
  SocketSession visitor_ = 0;  // who spoke last
};

}  // namespace flexrf::user
