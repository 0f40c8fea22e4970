// What an operator reads in the log, for tests of a process in which nobody else drains it.
#pragma once

#include <string_view>

#include "runtime/log/log.hpp"

namespace flexrf {

/// Hears what is said from its construction on.
class LogEar {
 public:
  LogEar() : before_(last_line()) {}

  bool has_heard(std::string_view part) const {
    Search search{part, false};
    last_line();
    visit_recent_log(before_, &search, [](void* context, std::uint64_t /*number*/, std::string_view text) {
      Search& wanted = *static_cast<Search*>(context);
      wanted.found = wanted.found || text.find(wanted.part) != std::string_view::npos;
    });
    return search.found;
  }

 private:
  struct Search {
    std::string_view part;
    bool found;
  };

  static std::uint64_t last_line() {
    while (drain_log(-1) > 0) {
    }
    return visit_recent_log(0, nullptr, [](void*, std::uint64_t, std::string_view) {});
  }

  std::uint64_t before_;
};

}  // namespace flexrf
