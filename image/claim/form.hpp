// What a browser sends of an HTML form (application/x-www-form-urlencoded, WHATWG URL Standard).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace flexrf::claim {

/// The fields by name. None: a name stands there twice, or it is not encoded so.
std::optional<std::map<std::string, std::string>> read_form(std::string_view body);

}  // namespace flexrf::claim
