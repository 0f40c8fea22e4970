#include "image/helper/request.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace flexrf::helper {
namespace {

struct Shape {
  Verb verb;
  std::string_view name;
  std::array<std::string_view, 5> members;  // beside the verb
};

constexpr std::array<Shape, 11> shapes = {
    {{Verb::state, "state", {}},
     {Verb::upload, "upload", {"user", "password", "size"}},
     {Verb::part, "part", {"upload", "offset"}},
     {Verb::install, "install", {"user", "password", "older", "other_drivers"}},
     {Verb::choose, "choose", {"user", "password", "slot", "other_drivers"}},
     {Verb::restart, "restart", {"user", "password"}},
     {Verb::network, "network", {"user", "password", "interface", "address", "gateway"}},
     {Verb::keep_network, "keep-network", {"user", "password", "reached_by"}},
     {Verb::dismiss_failure, "dismiss-failure", {"user", "password", "slot"}},
     {Verb::make_room, "make-room", {"user", "password", "what"}},
     {Verb::hosts, "hosts", {"user", "password", "hosts"}}}};

Answer malformed(const std::string& what) {
  return refuse(400, what + "; a request is a JSON object with a verb and its members in one line");
}

std::string names_of(const Shape& shape) {
  std::string names = "verb";
  for (const std::string_view member : shape.members) {
    if (!member.empty()) names.append(", ").append(member);
  }
  return names;
}

/// Empty: all is known.
std::string foreign_member_of(const JsonObject& object, const Shape& shape) {
  for (const auto member : object) {
    if (member.key != "verb" &&
        std::find(shape.members.begin(), shape.members.end(), member.key) == shape.members.end())
      return std::string{member.key};
  }
  return {};
}

Request taken(Fields& fields, const Shape& shape) {
  Request request;
  request.verb = shape.verb;
  for (const std::string_view member : shape.members) {
    if (member == "user") request.user = fields.text(member);
    if (member == "password") request.password = fields.text(member);
    if (member == "upload") request.upload = fields.text(member);
    if (member == "interface") request.interface = fields.text(member);
    if (member == "address") request.address = fields.text(member);
    if (member == "gateway") request.gateway = fields.text(member);
    if (member == "what") request.what = fields.text(member);
    if (member == "reached_by") request.reached_by = fields.text(member);
    if (member == "hosts") request.hosts = fields.text(member);
    if (member == "size") request.size = fields.integer(member);
    if (member == "offset") request.offset = fields.integer(member);
    if (member == "older") request.older = fields.boolean(member);
    if (member == "other_drivers") request.other_drivers = fields.boolean(member);
  }
  return request;
}

}  // namespace

const char* name_of(Verb verb) noexcept {
  return shapes[static_cast<std::size_t>(verb)].name.data();
}

std::variant<Request, Answer> parse_request(JsonReader& reader, std::string_view message) {
  const std::size_t end = message.find('\n');
  const std::string_view line = message.substr(0, end);
  const std::string_view rest = end == std::string_view::npos ? std::string_view{} : message.substr(end + 1);
  if (line.size() > longest_line)
    return refuse(413, "the line of a request has at most 1 KiB; send a shorter one");
  const Result<JsonObject> object = reader.object(line);
  if (!object) return malformed(object.status().cause());
  Fields fields(*object);
  const std::string_view verb = fields.text("verb");
  if (!fields.status()) return malformed(fields.status().cause());
  const auto* const shape =
      std::find_if(shapes.begin(), shapes.end(), [&](const Shape& one) { return one.name == verb; });
  if (shape == shapes.end())
    return refuse(400, "there is no verb " + in_quotes(verb) +
                           "; the verbs are state, upload, part, install, choose, restart, network, "
                           "keep-network, dismiss-failure, make-room, hosts");
  if (const std::string foreign = foreign_member_of(*object, *shape); !foreign.empty())
    return refuse(400, in_quotes(verb) + " has no member " + in_quotes(foreign) + "; its members are " +
                           names_of(*shape));
  Request request = taken(fields, *shape);
  if (shape->verb == Verb::choose || shape->verb == Verb::dismiss_failure) {
    const std::string_view name = fields.text("slot");
    const std::optional<boot::Slot> slot = boot::slot_named(name);
    if (fields.status() && !slot)
      return refuse(400, "'slot' is " + in_quotes(name) + "; the slots are A and B");
    request.slot = slot.value_or(boot::Slot::a);
  }
  if (!fields.status()) return malformed(fields.status().cause());
  if (shape->verb != Verb::part && !rest.empty())
    return refuse(400,
                  "behind the line of " + in_quotes(verb) + " comes nothing; only a part has bytes there");
  if (shape->verb == Verb::part && rest.empty())
    return refuse(400, "the part's bytes are missing; they come behind the line and its line feed");
  if (rest.size() > longest_part) return refuse(413, "a part has at most 60 KiB; send smaller ones");
  request.bytes = rest;
  return request;
}

}  // namespace flexrf::helper
