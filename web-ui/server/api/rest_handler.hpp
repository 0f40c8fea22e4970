// Requests under /api/v1.
#pragma once

#include <string>
#include <string_view>

#include "runtime/face/component_values.hpp"
#include "runtime/json/json_reader.hpp"
#include "web-ui/server/api/image_requests.hpp"
#include "web-ui/server/api/machine_operations.hpp"
#include "web-ui/server/api/operations.hpp"
#include "web-ui/server/api/routes.hpp"
#include "web-ui/server/api/state_event.hpp"
#include "web-ui/server/api/topic_bodies.hpp"
#include "web-ui/server/fixed_reply.hpp"

namespace flexrf::panel {

/// What the handler is made of; all outlive it.
struct RestParts {
  Executive& executive;
  AccessControl& access;
  JsonReader& reader;
  Operations& operations;
  MachineOperations& machine;
  Permission& permission;
  ObservedSlots& slots;
  ComponentValues& values;
  const ImageWorker& images;
  ImageRequests& pictures;
  StateEvent& state;
  TopicBodies& topics;
  std::string_view boot;
};

/// The server's thread.
class RestHandler {
 public:
  explicit RestHandler(const RestParts& parts);

  Handled handle(const Request& request, Reply& reply, Ticket ticket);

 private:
  void serve(const Request& request, Reply& reply, const Caller& caller, Time now);
  void read(const Match& match, const Request& request, Reply& reply, const Caller& caller, Time now);
  void act(const Match& match, const Request& request, const Caller& caller, Time now);
  void put_bundle(const Request& request, const Caller& caller);
  void put_parameters(const Match& match, const Request& request, JsonObject values, const Caller& caller,
                      Time now);
  void write_health(Reply& reply);
  void write_audit(const Request& request, Reply& reply, const Caller& caller);
  void write_slot(JsonWriter& json, std::uint16_t slot);
  void ask_picture(std::uint16_t slot, const Request& request, const Caller& caller, Time now);
  /// Makes the text the reply: 304 when the client has it.
  void finish(const Request& request, Reply& reply);
  void finish_json(const Request& request, Reply& reply, JsonWriter& json);
  void finish_fixed(const Request& request, Reply& reply, const Document& document);

  RestParts parts_;
  std::string openapi_text_;
  Document openapi_;
  Document descriptor_;
};

}  // namespace flexrf::panel
