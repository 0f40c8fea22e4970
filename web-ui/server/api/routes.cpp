#include "web-ui/server/api/routes.hpp"

#include <algorithm>

#include "base/json_writer.hpp"

namespace flexrf::panel {
namespace {

/// In place of a body's schema.
constexpr std::string_view bytes = "application/octet-stream";

constexpr Route table[] = {
    {Resource::openapi, Method::get, "openapi.json", "This document", Role::viewer, false, "", "Any", ""},
    {Resource::descriptor, Method::get, "descriptor",
     "Types, slots, components and parameters of the application", Role::viewer, false, "", "Any", ""},
    {Resource::state, Method::get, "state", "Mode, motion, faults, who is in control", Role::viewer, false,
     "", "State", ""},
    {Resource::health, Method::get, "health",
     "200: it runs, and nothing is in fault; 503: why not. To this machine without a login", Role::viewer,
     false, "", "Health", ""},
    {Resource::components, Method::get, "components", "All units and devices with their state", Role::viewer,
     false, "", "Components", ""},
    {Resource::component, Method::get, "components/{name}", "One unit or device", Role::viewer, false, "",
     "Component", ""},
    {Resource::get_parameters, Method::get, "components/{name}/parameters",
     "Configuration, runtime parameters in force, feedback", Role::viewer, false, "", "Parameters", ""},
    {Resource::put_parameters, Method::put, "components/{name}/parameters",
     "Changes runtime parameters, all or none; If-Match refuses what changed since", Role::operator_, true,
     "Values", "Parameters", ""},
    {Resource::action, Method::post, "components/{name}/actions/{action}",
     "start, stop, initialise (engineer), activate, retire, clone, reset, press", Role::operator_, true,
     "Action", "Parameters", ""},
    {Resource::reconfigure, Method::post, "reconfigure",
     "Changes configuration parameters as one transaction while nothing moves", Role::engineer, true,
     "Changes", "Reconfiguration", ""},
    {Resource::slots, Method::get, "slots", "All slots with counters", Role::viewer, false, "", "Slots", ""},
    {Resource::slot, Method::get, "slots/{name}", "One slot with its newest value", Role::viewer, false, "",
     "Slot", ""},
    {Resource::slot_image, Method::get, "slots/{name}/image", "The newest picture of an image slot",
     Role::viewer, false, "", "image/jpeg", "width"},
    {Resource::queues, Method::get, "queues", "All queues with counters", Role::viewer, false, "", "Queues",
     ""},
    {Resource::threads, Method::get, "threads", "All threads with histograms", Role::viewer, false, "",
     "Threads", ""},
    {Resource::devices, Method::get, "devices", "All devices with drivers and owners", Role::viewer, false,
     "", "Devices", ""},
    {Resource::log, Method::get, "log", "Recent lines of the log", Role::viewer, false, "", "Log", "after"},
    {Resource::audit, Method::get, "audit", "Who did what: the newest entries", Role::admin, false, "",
     "Audit", "after"},
    {Resource::operation, Method::post, "stop-motion",
     "Stop motion: a latch; neither an emergency stop nor an enabling device", Role::viewer, false, "", "",
     "", "stop_motion"},
    {Resource::operation, Method::post, "clear-stop-motion", "Clears the latch; nothing moves before Start",
     Role::operator_, true, "", "", "", "clear_stop_motion"},
    {Resource::operation, Method::post, "start-motion", "Start: actuators may move", Role::operator_, true,
     "", "", "", "start_motion"},
    {Resource::operation, Method::post, "save-values",
     "Save now: what was set goes into the configuration file; answered when it is there", Role::operator_,
     true, "", "Saved", "", "save_values"},
    {Resource::operation, Method::post, "control/take", "Takes the control token, or asks its holder for it",
     Role::operator_, false, "", "Taken", "", "take_control"},
    {Resource::operation, Method::post, "control/release", "Gives the control token up", Role::viewer, false,
     "", "", "", "release_control"},
    {Resource::operation, Method::post, "control/answer", "Answers who asks for the control token",
     Role::operator_, true, "Grant", "", "", "answer_control"},
    {Resource::machine, Method::get, "machine",
     "The industrial PC: versions, slots, an update that is under way; 404: it runs on none", Role::viewer,
     false, "", "Machine", ""},
    {Resource::machine_act, Method::post, "machine/upload",
     "Begins to upload an update, in place of one that was begun before", Role::admin, false, "Upload",
     "Uploading", "", "upload"},
    {Resource::machine_bundle, Method::put, "machine/bundle",
     "The next part of the update, at most 60 KiB; 409 tells in `received` where to go on", Role::admin,
     false, bytes, "Received", ""},
    {Resource::machine_act, Method::post, "machine/install",
     "Installs what was uploaded and verified, while nothing may move", Role::admin, false, "Install", "", "",
     "install"},
    {Resource::machine_act, Method::post, "machine/choose",
     "Chooses which slot starts next, while nothing may move", Role::admin, false, "Choose", "", "",
     "choose"},
    {Resource::machine_act, Method::post, "machine/restart", "Restarts the PC, while nothing may move",
     Role::admin, false, "Password", "", "", "restart"},
    {Resource::machine_act, Method::post, "machine/network",
     "Sets an interface's address on trial for 2 min, while nothing may move", Role::admin, false, "Network",
     "", "", "network"},
    {Resource::machine_act, Method::post, "machine/keep-network", "Keeps the address that is on trial",
     Role::admin, false, "Password", "", "", "keep-network"},
    {Resource::machine_act, Method::post, "machine/dismiss-failure",
     "Hides why a slot's version failed; 409: nothing is shown of it", Role::admin, false, "DismissFailure",
     "", "", "dismiss-failure"},
    {Resource::machine_act, Method::post, "machine/make-room",
     "Removes old logs from the partition for data; 409: there are none", Role::admin, false, "MakeRoom",
     "Freed", "", "make-room"},
    {Resource::machine_act, Method::post, "machine/hosts",
     "Declares the other names and addresses of this PC, in place of those declared before", Role::admin,
     false, "Hosts", "", "", "hosts"},
    {Resource::access, Method::get, "session", "Who is logged in; 401: nobody", Role::viewer, false, "",
     "LoggedIn", ""},
    {Resource::access, Method::post, "login",
     "Begins a session, which is in the answer's cookie; 409: there are no passwords", Role::viewer, false,
     "Login", "LoggedIn", ""},
    {Resource::access, Method::post, "logout", "Ends the session", Role::viewer, false, "", "204", ""},
};

constexpr std::string_view schemas = R"json({
"Any":{"type":"object"},
"Problem":{"type":"object","required":["type","title","status","detail"],"properties":{"type":{"type":"string"},"title":{"type":"string"},"status":{"type":"integer"},"detail":{"type":"string"},"parameter":{"type":"string"},"reason":{"type":"string"},"moving":{"type":"array","items":{"type":"string"}},"received":{"type":"integer"}}},
"Values":{"type":"object","description":"PATH (gain, gains[2], limits.low): value","additionalProperties":true,"minProperties":1},
"Parameters":{"type":"object","properties":{"sequence":{"type":"integer"},"configuration":{"type":["object","null"]},"runtime":{"type":["object","null"]},"feedback":{"type":["object","null"]}}},
"Action":{"type":"object","properties":{"source":{"type":"string"},"parameters":{"type":"array","items":{"type":"string"}},"parameter":{"type":"string"},"count":{"type":"integer","minimum":1,"maximum":100}}},
"Changes":{"type":"object","required":["changes"],"properties":{"changes":{"type":"array","items":{"type":"object","required":["component","values"],"properties":{"component":{"type":"string"},"values":{"$ref":"#/components/schemas/Values"}}}}}},
"Reconfiguration":{"type":"object","required":["outcome","causes","owners"],"properties":{"outcome":{"enum":["done","refused","rolled_back","fault"]},"causes":{"type":"array","items":{"type":"string"}},"owners":{"type":"array","items":{"type":"string"}}}},
"Grant":{"type":"object","required":["grant"],"properties":{"grant":{"type":"boolean"}}},
"Taken":{"type":"object","required":["taken"],"properties":{"taken":{"type":"boolean"}}},
"Saved":{"type":"object","required":["saved_at_ms"],"properties":{"saved_at_ms":{"type":"integer","description":"since 1970"}}},
"Login":{"type":"object","required":["user","password"],"additionalProperties":false,"properties":{"user":{"type":"string"},"password":{"type":"string"}}},
"LoggedIn":{"type":"object","required":["name","role","local","user"],"properties":{"name":{"type":"string"},"role":{"enum":["viewer","operator","engineer","admin"]},"local":{"type":"boolean"},"user":{"type":"string"}}},
"Session":{"type":["object","null"],"properties":{"name":{"type":"string"},"user":{"type":"string"},"address":{"type":"string"},"local":{"type":"boolean"},"you":{"type":"boolean"}}},
"State":{"type":"object","required":["mode","cause","motion","faults","values","control","edit","server"],"properties":{"mode":{"enum":["starting","running","finishing","stopping","safe","ended"]},"cause":{"type":"string"},"motion":{"type":"object","required":["stopped","may_move","start_refused","stopped_by"],"properties":{"stopped":{"type":"boolean"},"may_move":{"type":"boolean"},"start_refused":{"type":"string"},"stopped_by":{"type":["object","null"],"properties":{"who":{"type":"string"},"at_ms":{"type":"integer"}}}}},"faults":{"type":"array","items":{"type":"object","required":["component","kind","cause","since_ns"],"properties":{"kind":{"enum":["unit","device","thread","process"]},"since_ns":{"type":"integer"}}}},"values":{"type":"object","required":["file","on","unsaved","saved_at_ms","writings","failure"],"properties":{"file":{"type":"boolean"},"on":{"enum":["change","command"]},"unsaved":{"type":"boolean"},"saved_at_ms":{"type":["integer","null"]},"writings":{"type":"integer","description":"of the file since the start"},"failure":{"type":"string"}}},"control":{"type":"object","properties":{"holder":{"$ref":"#/components/schemas/Session"},"wanted_by":{"$ref":"#/components/schemas/Session"},"answer_within_ms":{"type":"integer"}}},"edit":{"type":["object","null"]},"server":{"type":"object"}}},
"Health":{"type":"object","required":["healthy","why_not","may_move"],"properties":{"healthy":{"type":"boolean"},"why_not":{"type":"string"},"may_move":{"type":"boolean","description":"whether actuators may move now"}}},
"Machine":{"type":"object","required":["application","version","slot","boot","confirmed","slots","motion","development_key","notices","update"],"properties":{"application":{"type":"string"},"version":{"type":"string"},"built":{"type":"integer","description":"s since 1970"},"drivers":{"type":"string","description":"that the version chooses: axis_x=canopen,camera=v4l2"},"slot":{"enum":["A","B"]},"boot":{"enum":["confirmed","only","trial","fallback","manual","unknown"]},"confirmed":{"type":"boolean"},"slots":{"type":"object","additionalProperties":{"type":"object","properties":{"version":{"type":"string"},"whole":{"type":"boolean"},"primary":{"type":"boolean"},"driver_changes":{"type":"array","description":"against what runs","items":{"type":"object","properties":{"device":{"type":"string"},"from":{"type":"string","description":"empty: there is no such device, or its driver is not told"},"to":{"type":"string"}}}}}}},"claimed":{"type":"boolean"},"motion":{"type":"string","description":"permitted, or why not"},"development_key":{"type":"boolean"},"notices":{"type":"array","items":{"type":"string"}},"healthy_for_s":{"type":"integer"},"healthy_needed_s":{"type":"integer"},"why_not_healthy":{"type":"string"},"network":{"type":"array","items":{"type":"object","properties":{"interface":{"type":"string"},"mac":{"type":"string"},"link":{"type":"boolean"},"addresses":{"type":"array","items":{"type":"string"}},"setting":{"enum":["image","dhcp","fixed"]},"address":{"type":"string"},"gateway":{"type":"string"}}}},"network_trial":{"type":"object","properties":{"interface":{"type":"string"},"remaining_s":{"type":"integer","description":"then the setting before it returns"}}},"hosts":{"type":"array","description":"declared: further names and IPv4 addresses at which the panel answers","items":{"type":"string"}},"data":{"type":"object","description":"bytes on the partition for data, at most a minute old","properties":{"size":{"type":"integer"},"used":{"type":"integer"},"free":{"type":"integer","description":"for the application"},"configuration":{"type":"integer"},"audit":{"type":"integer"},"journal":{"type":"integer"},"old_logs":{"type":"integer","description":"of the journal, what make-room would remove"},"updates":{"type":"integer"},"other":{"type":"integer"},"complete":{"type":"boolean","description":"false: not all entries were counted"}}},"last_failure":{"type":"object","description":"of a version from which the PC fell back; not there: none","properties":{"slot":{"enum":["A","B"]},"version":{"type":"string"},"starts":{"type":"integer","description":"that came to nothing"},"start":{"type":"integer","description":"which of them left the reason; 0: none"},"began":{"type":"integer","description":"s since 1970"},"reason":{"type":"string"},"lines":{"type":"array","items":{"type":"string"}},"why_no_lines":{"type":"string"}}},"update":{"type":"object","properties":{"phase":{"enum":["none","receiving","verifying","verified","installing","installed","failed"]},"received":{"type":"integer"},"size":{"type":"integer"},"percent":{"type":"integer"},"version":{"type":"string"},"application":{"type":"string"},"older":{"type":"boolean"},"driver_changes":{"type":"array","description":"against what runs","items":{"type":"object","properties":{"device":{"type":"string"},"from":{"type":"string","description":"empty: there is no such device, or its driver is not told"},"to":{"type":"string"}}}},"why":{"type":"string"}}}}},
"Upload":{"type":"object","required":["password","size"],"properties":{"password":{"type":"string"},"size":{"type":"integer","description":"bytes"}}},
"Uploading":{"type":"object","required":["upload"],"properties":{"upload":{"type":"string","description":"32 hexadecimal digits"}}},
"Received":{"type":"object","required":["received"],"properties":{"received":{"type":"integer","description":"bytes so far"}}},
"Install":{"type":"object","required":["password"],"properties":{"password":{"type":"string"},"older":{"type":"boolean","description":"also one that is older than what runs"},"other_drivers":{"type":"boolean","description":"also one whose devices have other drivers than those that run"}}},
"MakeRoom":{"type":"object","required":["password","what"],"properties":{"password":{"type":"string"},"what":{"enum":["logs"]}}},
"Freed":{"type":"object","required":["freed"],"properties":{"freed":{"type":"integer","description":"bytes"}}},
"DismissFailure":{"type":"object","required":["password","slot"],"properties":{"password":{"type":"string"},"slot":{"enum":["A","B"]}}},
"Choose":{"type":"object","required":["password","slot"],"properties":{"password":{"type":"string"},"slot":{"enum":["A","B"]}}},
"Network":{"type":"object","required":["password","interface","address"],"properties":{"password":{"type":"string"},"interface":{"type":"string"},"address":{"type":"string","description":"dhcp, image (as the version that runs says), or as 192.168.1.10/24"},"gateway":{"type":"string"}}},
"Hosts":{"type":"object","required":["password","hosts"],"properties":{"password":{"type":"string"},"hosts":{"type":"string","description":"names and IPv4 addresses, separated by blanks, at most 8: cell7.example.org 203.0.113.7"}}},
"Password":{"type":"object","required":["password"],"properties":{"password":{"type":"string"}}},
"Component":{"type":"object","required":["name","kind","life","fault","active","member","steps","execution"],"properties":{"name":{"type":"string"},"kind":{"enum":["unit","device"]},"type":{"type":"string"},"driver":{"type":"string"},"life":{"enum":["created","initialised","running","stopped","fault","waiting"]},"fault":{"type":"string"},"restraint":{"type":"string"},"restraints":{"type":"integer"},"budget_overruns":{"type":"integer"},"active":{"type":"boolean"},"member":{"type":["object","null"]},"steps":{"type":"integer"},"execution":{"type":"object"}}},
"Components":{"type":"array","items":{"$ref":"#/components/schemas/Component"}},
"Slot":{"type":"object","required":["name","type","published","reason","sequence","sampled_at_ns","value","readers"],"properties":{"name":{"type":"string"},"type":{"type":"string"},"published":{"type":"integer"},"reason":{"type":"string"},"sequence":{"type":"integer"},"sampled_at_ns":{"type":"integer"},"value":{"type":["object","null"]},"readers":{"type":"array"}}},
"Slots":{"type":"array","items":{"type":"object","required":["name","published","readers"]}},
"Queues":{"type":"array","items":{"type":"object","required":["name","capacity","fill","writers","readers"]}},
"Threads":{"type":"array","items":{"type":"object","required":["name","cycles","overruns","skipped","skipped_time_ns","longest_standstill_ns","allocations","budget_ns","lateness","execution"]}},
"Devices":{"type":"array","items":{"type":"object","required":["name","interface","driver","kind","life"]}},
"Audit":{"type":"object","required":["last","entries"],"properties":{"last":{"type":"integer"},"entries":{"type":"array","items":{"type":"object","required":["number","at","who","did"],"properties":{"number":{"type":"integer"},"at":{"type":"string"},"who":{"type":"string"},"did":{"type":"string"},"what":{"type":"string"},"before":{},"after":{},"count":{"type":"integer"}}}}}},
"Log":{"type":"object","required":["last","lines"],"properties":{"last":{"type":"integer"},"lines":{"type":"array","items":{"type":"object","required":["number","text"]}}}}
})json";

/// In place of an answer's schema.
constexpr std::string_view no_content = "204";

constexpr std::string_view words_of_methods[] = {"get", "head", "put", "post", "other"};
constexpr std::string_view words_of_roles[] = {"viewer", "operator", "engineer", "admin"};

/// The first segment of a path, which is taken off.
std::string_view take_segment(std::string_view& path) noexcept {
  const std::size_t end = std::min(path.find('/'), path.size());
  const std::string_view segment = path.substr(0, end);
  path.remove_prefix(std::min(end + 1, path.size()));
  return segment;
}

bool matches(std::string_view pattern, std::string_view path, Match& match) noexcept {
  std::size_t place = 0;
  while (!pattern.empty() && !path.empty()) {
    const std::string_view wanted = take_segment(pattern);
    const std::string_view segment = take_segment(path);
    if (wanted.front() == '{') {
      match.segments[place++] = segment;
    } else if (wanted != segment) {
      return false;
    }
  }
  return pattern.empty() && path.empty();
}

void write_content(JsonWriter& json, std::string_view schema) {
  json.key("content").begin_object();
  if (schema == "image/jpeg" || schema == bytes) {
    json.key(schema).begin_object().end_object();
  } else {
    json.key("application/json").begin_object().key("schema").begin_object();
    json.member("$ref", "#/components/schemas/" + std::string{schema.empty() ? "Any" : schema});
    json.end_object().end_object();
  }
  json.end_object();
}

void write_parameter(JsonWriter& json, std::string_view name, const char* in, const char* type,
                     bool is_required) {
  json.begin_object().member("name", name).member("in", in).member("required", is_required);
  json.key("schema").begin_object().member("type", type);
  json.end_object().end_object();
}

void write_operation(JsonWriter& json, const Route& route) {
  json.key(words_of_methods[static_cast<std::size_t>(route.method)]).begin_object();
  json.member("summary", route.summary);
  // Whoever asks for access has no role yet.
  if (route.resource != Resource::access)
    json.member("x-role", words_of_roles[static_cast<std::size_t>(route.role)]);
  json.member("x-needs-control", route.control).key("parameters").begin_array();
  std::string_view path = route.path;
  while (!path.empty()) {
    const std::string_view segment = take_segment(path);
    if (segment.front() == '{')
      write_parameter(json, segment.substr(1, segment.size() - 2), "path", "string", true);
  }
  if (route.resource == Resource::machine_bundle) {
    write_parameter(json, "upload", "query", "string", true);
    write_parameter(json, "offset", "query", "integer", true);
  } else if (!route.query.empty()) {
    write_parameter(json, route.query, "query", "integer", false);
  }
  if (route.resource == Resource::put_parameters)
    write_parameter(json, "If-Match", "header", "string", false);
  json.end_array();
  if (!route.request.empty()) {
    json.key("requestBody").begin_object();
    write_content(json, route.request);
    json.end_object();
  }
  const bool has_content = route.response != no_content;
  json.key("responses").begin_object().key(has_content ? "200" : no_content).begin_object();
  json.member("description", "Done");
  if (has_content) write_content(json, route.response);
  json.end_object().key("default").begin_object().member("description", "Refused, and why (RFC 9457)");
  json.key("content").begin_object().key("application/problem+json").begin_object().key("schema");
  json.begin_object().member("$ref", "#/components/schemas/Problem").end_object().end_object().end_object();
  json.end_object().end_object().end_object();
}

}  // namespace

std::span<const Route> routes() noexcept {
  return table;
}

Match match(Method method, std::string_view path) noexcept {
  const Method wanted = method == Method::head ? Method::get : method;
  Match found;
  for (const Route& route : table) {
    if (route.resource == Resource::access || !matches(route.path, path, found)) continue;
    found.known_path = true;
    if (route.method != wanted) continue;
    found.route = &route;
    break;
  }
  return found;
}

std::string openapi_document(std::string_view application) {
  JsonWriter json({}, JsonWriter::Style::compact);
  json.begin_object().member("openapi", "3.1.0").key("info").begin_object();
  json.member("title", "Panel of " + std::string{application}).member("version", "1");
  json.member(
      "description",
      "Values, counters and acts of a FlexRF application. Acts need the role and, where x-needs-control "
      "says so, the control token; requests of a page need an Origin of the server's own.");
  json.end_object().key("servers").begin_array().begin_object().member("url", "/api/v1").end_object();
  json.end_array().key("paths").begin_object();
  std::string_view open;
  for (const Route& route : table) {
    if (route.path != open) {
      if (!open.empty()) json.end_object();
      json.key("/" + std::string{route.path}).begin_object();
      open = route.path;
    }
    write_operation(json, route);
  }
  json.end_object().end_object().key("components").begin_object().key("schemas").raw(schemas);
  json.end_object().end_object();
  return json.release();
}

}  // namespace flexrf::panel
