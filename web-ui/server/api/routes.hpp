// What there is under /api/v1: one table for answering requests and for openapi.json.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/core/parameter_descriptor.hpp"
#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

enum class Resource : std::uint8_t {
  openapi,
  descriptor,
  state,
  health,  ///< open to this machine
  components,
  component,
  get_parameters,
  put_parameters,
  action,
  reconfigure,
  slots,
  slot,
  slot_image,
  queues,
  threads,
  devices,
  log,
  audit,
  machine,         ///< the PC, of its helper
  machine_act,     ///< `operation`: as the helper calls it
  machine_bundle,  ///< a part of an update; its body is no JSON
  operation,       ///< of the table in operations.cpp
  access,          ///< described here, answered by AccessEndpoints
};

struct Route {
  Resource resource;
  Method method;
  std::string_view path;  ///< below /api/v1/; "{...}" stands for one segment
  std::string_view summary;
  Role role;
  bool control;               ///< needs the control token
  std::string_view request;   ///< name of the schema of the body, or its type; empty: no body
  std::string_view response;  ///< likewise of the answer; empty: {}; "204": no body
  std::string_view query;     ///< name of its integer parameter in the query; empty: none
  std::string_view operation{};
};

std::span<const Route> routes() noexcept;

/// What a path means.
struct Match {
  const Route* route = nullptr;                ///< null: no such path, or not for this method
  bool known_path = false;                     ///< some other method is for it
  std::array<std::string_view, 2> segments{};  ///< what stood for each "{...}"
};
/// `path`: percent-decoded, below /api/v1/. Routes of Resource::access are left out.
Match match(Method method, std::string_view path) noexcept;

/// The document that describes them all (OpenAPI 3.1).
std::string openapi_document(std::string_view application);

}  // namespace flexrf::panel
