#include "web-ui/server/api/log_lines.hpp"

#include <limits>

#include "runtime/log/log.hpp"

namespace flexrf::panel {

std::uint64_t write_log_lines(JsonWriter& json, std::uint64_t after) {
  json.begin_array();
  const std::uint64_t last =
      visit_recent_log(after, &json, [](void* context, std::uint64_t number, std::string_view text) {
        auto& to = *static_cast<JsonWriter*>(context);
        to.begin_object().member("number", number).member("text", text).end_object();
      });
  json.end_array();
  return last;
}

std::uint64_t last_log_line() noexcept {
  return visit_recent_log(std::numeric_limits<std::uint64_t>::max(), nullptr,
                          [](void*, std::uint64_t, std::string_view) {});
}

}  // namespace flexrf::panel
