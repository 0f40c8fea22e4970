#include "web-ui/server/api/rest_handler.hpp"

#include <algorithm>
#include <charconv>

#include "runtime/face/json_parts.hpp"
#include "web-ui/server/api/health.hpp"
#include "web-ui/server/api/log_lines.hpp"

namespace flexrf::panel {
namespace {

constexpr std::string_view prefix = "/api/v1/";

/// What stands behind `name=` in a query, as sent; null data: it is not there.
std::string_view query_text(std::string_view query, std::string_view name) noexcept {
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view part = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    if (part.substr(0, part.find('=')) == name) return part.substr(std::min(name.size() + 1, part.size()));
  }
  return {};
}

/// The integer `name=` of a query; `otherwise` without one; false: it is no integer from 0.
bool query_integer(std::string_view query, std::string_view name, std::uint64_t otherwise,
                   std::uint64_t& number) noexcept {
  number = otherwise;
  const std::string_view value = query_text(query, name);
  if (value.data() == nullptr) return true;
  const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc{} && rest == value.data() + value.size();
}

}  // namespace

RestHandler::RestHandler(const RestParts& parts)
    : parts_(parts),
      openapi_text_(openapi_document(parts.executive.cell().application().name)),
      openapi_(openapi_text_),
      descriptor_(parts.executive.cell().application().descriptor_json) {}

Handled RestHandler::handle(const Request& request, Reply& reply, Ticket ticket) {
  const Caller caller = Caller::rest(request.session, ticket);
  parts_.operations.answers.begin_request(ticket, reply);
  parts_.slots.begin_turn();
  serve(request, reply, caller, MonotonicClock::now());
  return parts_.operations.answers.end_request();
}

void RestHandler::serve(const Request& request, Reply& reply, const Caller& caller, Time now) {
  Answers& answers = parts_.operations.answers;
  if (!request.path.starts_with(prefix))
    return answers.refuse(caller, RefusalKind::not_found, "It begins with /api/v1/.");
  const Match found = match(request.method, request.path.substr(prefix.size()));
  if (found.route == nullptr) {
    return answers.refuse(
        caller, found.known_path ? Refusal::make(RefusalKind::method_not_allowed,
                                                 "openapi.json has the methods of this path.")
                                 : Refusal::make(RefusalKind::not_found,
                                                 "There is no such path; openapi.json lists what there is."));
  }
  // Bytes are for what takes them; everything else takes JSON, or nothing.
  if (found.route->method != Method::get && found.route->resource != Resource::machine_bundle &&
      !request.body.empty() && !request.content_type.starts_with("application/json")) {
    return answers.refuse(caller, RefusalKind::wrong_media_type,
                          "The body is to be JSON, with Content-Type: application/json.");
  }
  // The latch comes before everything that could go wrong.
  if (found.route->operation == "stop_motion") return parts_.operations.motion.stop_motion(caller);
  // Who supervises this machine has no login, and may not depend on one.
  if (found.route->resource == Resource::health && request.loopback) return write_health(reply);
  if (!parts_.permission.has_role(caller, Role::viewer, "see this")) return;
  if (found.route->method == Method::get) {
    read(found, request, reply, caller, now);
  } else {
    act(found, request, caller, now);
  }
}

// ---- reading

void RestHandler::read(const Match& found, const Request& request, Reply& reply, const Caller& caller,
                       Time now) {
  Answers& answers = parts_.operations.answers;
  const Directory& directory = parts_.operations.directory;
  const std::string_view name = found.segments[0];
  const auto list = [&](Topic topic) {
    const std::string_view body = parts_.topics.body(topic, now);
    reply.text.reserve(parts_.topics.room(topic));
    reply.text.assign(body);
    finish(request, reply);
  };
  reply.text.clear();
  switch (found.route->resource) {
    case Resource::openapi:
      return finish_fixed(request, reply, openapi_);
    case Resource::descriptor:
      return finish_fixed(request, reply, descriptor_);
    case Resource::state:
      parts_.state.update(now);
      reply.text.assign("{").append(parts_.state.members_for(caller.session));
      return finish(request, reply);
    case Resource::health:
      return write_health(reply);
    case Resource::machine:
      return parts_.machine.read(caller);
    case Resource::components:
      return list(Topic::components);
    case Resource::slots:
      return list(Topic::slots);
    case Resource::queues:
      return list(Topic::queues);
    case Resource::threads:
      return list(Topic::threads);
    case Resource::devices: {
      JsonWriter json(std::move(reply.text));
      parts_.topics.write_devices(json);
      return finish_json(request, reply, json);
    }
    case Resource::log: {
      std::uint64_t after = 0;
      if (!query_integer(request.query, "after", 0, after))
        return answers.refuse(caller, RefusalKind::bad_request, "'after' is the number of a line.");
      // The lines come first, as only then their last number is known.
      JsonWriter json(std::move(reply.text));
      json.begin_object().key("lines");
      const std::uint64_t last = write_log_lines(json, after);
      json.member("last", last).end_object();
      return finish_json(request, reply, json);
    }
    case Resource::audit:
      if (parts_.permission.has_role(caller, Role::admin, "read who did what"))
        write_audit(request, reply, caller);
      return;
    case Resource::slot:
    case Resource::slot_image: {
      const auto slot = directory.slot(name);
      if (!slot) return answers.refuse(caller, directory.no_slot(name));
      if (found.route->resource == Resource::slot_image) return ask_picture(*slot, request, caller, now);
      JsonWriter json(std::move(reply.text));
      write_slot(json, *slot);
      return finish_json(request, reply, json);
    }
    case Resource::component: {
      const auto component = parts_.operations.component(caller, name);
      if (!component) return;
      JsonWriter json(std::move(reply.text));
      parts_.topics.write_component(json, *component);
      return finish_json(request, reply, json);
    }
    case Resource::get_parameters: {
      const auto component = parts_.operations.component(caller, name);
      if (!component) return;
      JsonWriter json(std::move(reply.text));
      json.begin_object();
      parts_.values.write_all(json, *component);
      json.end_object();
      reply.text = json.release();
      // Of the settings alone: feedback changes all the time, and is no reason to refuse a change.
      write_etag(reply.etag, parts_.boot, parts_.values.sequence(*component));
      answers.answered();
      return;
    }
    default:
      return;
  }
}

void RestHandler::finish(const Request& request, Reply& reply) {
  answer_text(request, reply);
  parts_.operations.answers.answered();
}

void RestHandler::finish_json(const Request& request, Reply& reply, JsonWriter& json) {
  reply.text = json.release();
  finish(request, reply);
}

void RestHandler::finish_fixed(const Request& request, Reply& reply, const Document& document) {
  reply.cache_control = "no-cache";
  answer_fixed(request, reply, document.bytes());
  parts_.operations.answers.answered();
}

void RestHandler::write_health(Reply& reply) {
  const std::string why_not = why_not_healthy(parts_.executive.cell());
  reply.text.clear();
  JsonWriter json(std::move(reply.text));
  json.begin_object().member("healthy", why_not.empty()).member("why_not", why_not);
  json.member("may_move", parts_.executive.control().may_move()).end_object();
  reply.text = json.release();
  reply.status = why_not.empty() ? 200 : 503;
  parts_.operations.answers.answered();
}

void RestHandler::write_audit(const Request& request, Reply& reply, const Caller& caller) {
  std::uint64_t after = 0;
  if (!query_integer(request.query, "after", 0, after)) {
    return parts_.operations.answers.refuse(caller, RefusalKind::bad_request,
                                            "'after' is the number of an entry.");
  }
  JsonWriter json(std::move(reply.text));
  json.begin_object().key("entries").begin_array();
  std::string entry;
  const std::uint64_t last =
      parts_.executive.audit().visit(after, [&](std::uint64_t number, std::string_view text) {
        // Who can write into the file may have written anything.
        if (!parts_.reader.object(text)) return;
        entry.assign("{\"number\":").append(std::to_string(number));
        entry.append(text == "{}" ? "" : ",").append(text.substr(1));
        json.raw(entry);
      });
  json.end_array().member("last", last).end_object();
  finish_json(request, reply, json);
}

void RestHandler::write_slot(JsonWriter& json, std::uint16_t slot) {
  const SlotFigures figures = parts_.topics.statistics().slot(slot);
  const bool is_picture = parts_.images.is_image(slot);
  json.begin_object().member("name", figures.record->name).member("type", figures.type->name);
  json.member("published", figures.published);
  // A picture is asked for as such; its bytes are no JSON.
  const ObservedSlot newest = is_picture ? parts_.slots.read_header(slot) : parts_.slots.read(slot);
  write_observed(json, *figures.type, newest, parts_.slots.reason(slot, newest));
  write_readers(json, figures);
  json.end_object();
}

void RestHandler::ask_picture(std::uint16_t slot, const Request& request, const Caller& caller, Time now) {
  Answers& answers = parts_.operations.answers;
  std::uint64_t width = 0;
  if (!parts_.images.is_image(slot)) {
    return answers.refuse(caller, RefusalKind::not_found, "The slot '%s' holds no picture that is observed.",
                          parts_.operations.directory.slots()[slot].name);
  }
  if (!query_integer(request.query, "width", 640, width) || width < 1 || width > 4096)
    return answers.refuse(caller, RefusalKind::bad_request, "'width' lies from 1 to 4096 pixels.");
  parts_.pictures.ask(caller, slot, static_cast<std::uint32_t>(width), now);
}

// ---- acting

void RestHandler::act(const Match& found, const Request& request, const Caller& caller, Time now) {
  Operations& operations = parts_.operations;
  Answers& answers = operations.answers;
  if (found.route->resource == Resource::machine_bundle) return put_bundle(request, caller);
  const Result<JsonObject> body = parts_.reader.object(request.body.empty() ? "{}" : request.body);
  if (!body) {
    const bool too_large = request.body.size() > JsonReader::max_bytes;
    return answers.refuse(caller, too_large ? RefusalKind::too_large : RefusalKind::bad_request,
                          "The body: %s.", body.status().cause());
  }
  Fields fields(*body);
  Asked asked{operations, caller, fields, "The body", now, found.segments[0], found.segments[1]};
  switch (found.route->resource) {
    case Resource::put_parameters:
      return put_parameters(found, request, *body, caller, now);
    case Resource::reconfigure: {
      const auto changes = fields.array("changes");
      if (asked.is_right()) operations.edits.reconfigure(caller, *changes, now);
      return;
    }
    case Resource::action: {
      const std::string_view action = found.segments[1];
      if (action == "clone") fields.text("source");  // has to be there
      return find_operation(action == "reset" || action == "press" ? action : "action")->run(asked);
    }
    case Resource::machine_act:
      return parts_.machine.act(caller, found.route->operation, fields, request.local_end);
    case Resource::operation:
      return find_operation(found.route->operation)->run(asked);
    default:
      return;
  }
}

void RestHandler::put_bundle(const Request& request, const Caller& caller) {
  Answers& answers = parts_.operations.answers;
  if (!request.content_type.starts_with("application/octet-stream")) {
    return answers.refuse(caller, RefusalKind::wrong_media_type,
                          "The body is to be bytes, with Content-Type: application/octet-stream.");
  }
  std::uint64_t offset = 0;
  if (query_text(request.query, "offset").empty() || !query_integer(request.query, "offset", 0, offset)) {
    return answers.refuse(caller, RefusalKind::bad_request,
                          "'offset' is the number of bytes that came before this part.");
  }
  parts_.machine.put(caller, query_text(request.query, "upload"), offset, request.body);
}

void RestHandler::put_parameters(const Match& found, const Request& request, JsonObject values,
                                 const Caller& caller, Time now) {
  Operations& operations = parts_.operations;
  const auto component = operations.component(caller, found.segments[0]);
  if (!component) return;
  std::optional<std::uint64_t> expected;
  if (!request.if_match.empty() && request.if_match != "*") {
    std::string_view tag = request.if_match;
    std::uint64_t sequence = 0;
    const bool quoted = tag.size() > 2 && tag.front() == '"' && tag.back() == '"';
    if (quoted) tag = tag.substr(1, tag.size() - 2);
    const bool ours = quoted && tag.starts_with(parts_.boot) && tag.size() > parts_.boot.size() &&
                      tag[parts_.boot.size()] == '-';
    if (ours) tag.remove_prefix(parts_.boot.size() + 1);
    const auto [end, error] = std::from_chars(tag.data(), tag.data() + tag.size(), sequence);
    if (!ours || error != std::errc{} || end != tag.data() + tag.size()) {
      return operations.answers.refuse(caller, RefusalKind::stale,
                                       "If-Match is none of this run's entity tags; the application "
                                       "may have been started again. Read the parameters anew.");
    }
    expected = sequence;
  }
  operations.parameters.set(caller, *component, values, expected, now);
}

}  // namespace flexrf::panel
