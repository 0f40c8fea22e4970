#include "units/remote_control/rpc.hpp"

namespace flexrf::remote {
namespace {

constexpr std::size_t longest_id = 64;  // bytes of a text
constexpr std::size_t longest_shown = 80;

const char* message_of(RpcError error) noexcept {
  switch (error) {
    case RpcError::parse:
      return "Parse error";
    case RpcError::invalid_request:
      return "Invalid Request";
    case RpcError::method_not_found:
      return "Method not found";
    case RpcError::invalid_params:
      return "Invalid params";
    case RpcError::busy:
      return "Too much at a time";
    case RpcError::token_missing:
      return "The token is missing or wrong";
    case RpcError::not_remote:
      return "Remote control is off";
    case RpcError::role_missing:
      return "The role is too low";
    case RpcError::not_found:
      return "There is no such thing";
    case RpcError::refused:
      return "It is refused";
    case RpcError::stale:
      return "The values have changed since";
    case RpcError::too_large:
      return "Too much for one line";
    case RpcError::no_answer:
      return "The component does not answer";
  }
  return "Unknown error";
}

/// False: the standard permits texts, integers and null.
bool read_id(JsonElement json, std::string& id) {
  JsonWriter text(std::string{}, JsonWriter::Style::compact);
  switch (json.type()) {
    case simdjson::dom::element_type::STRING: {
      const std::string_view value = json.get_string().value_unsafe();
      if (value.size() > longest_id) return false;
      text.value(value);
      break;
    }
    case simdjson::dom::element_type::INT64:
      text.value(json.get_int64().value_unsafe());
      break;
    case simdjson::dom::element_type::UINT64:
      text.value(json.get_uint64().value_unsafe());
      break;
    case simdjson::dom::element_type::NULL_VALUE:
      text.null();
      break;
    default:
      return false;
  }
  id = text.release();
  return true;
}

RpcProblem invalid(std::string reason, std::string hint) {
  return {RpcError::invalid_request, std::move(reason), std::move(hint)};
}

}  // namespace

RpcProblem wrong_params(const Fields& params, std::string hint) {
  return {RpcError::invalid_params, params.status().cause(), std::move(hint)};
}

std::string_view shown(std::string_view text) noexcept {
  return text.substr(0, longest_shown);
}

std::string nearest_hint(std::string_view nearest, std::string_view otherwise) {
  if (nearest.empty()) return std::string{otherwise};
  return "did you mean '" + std::string{nearest} + "'?";
}

RpcReader::RpcReader() {
  [[maybe_unused]] const auto error = no_params_.parse("{}", 2).get(none_);
}

std::optional<RpcProblem> RpcReader::read(std::string_view line, RpcCall& call) {
  call.id = "null";
  call.method = {};
  call.params = none_;
  if (line.size() > JsonReader::max_bytes) {
    return invalid("the line has " + std::to_string(line.size()) + " bytes",
                   "write at most " + std::to_string(JsonReader::max_bytes) + ", in several requests");
  }
  const Result<JsonElement> root = reader_.value(line);
  if (!root) {
    return RpcProblem{RpcError::parse, root.status().cause(),
                      "write one JSON object, and a line feed at its end; NaN and infinities are no JSON"};
  }
  if (JsonArray batch; root->get(batch) == simdjson::SUCCESS) {
    return invalid("a batch is not taken",
                   "send each request as a line of its own; they may follow one another without waiting");
  }
  const Result<JsonObject> object = JsonReader::object(*root);
  if (!object) {
    return invalid(object.status().cause(),
                   R"(write {"jsonrpc": "2.0", "id": 1, "method": "list", "params": {"of": "slots"}})");
  }
  return read_object(*object, call);
}

std::optional<RpcProblem> RpcReader::read_object(JsonObject object, RpcCall& call) const {
  std::string id;
  if (JsonElement json; object.at_key("id").get(json) == simdjson::SUCCESS) {
    if (!read_id(json, id)) {
      return invalid("'id' is neither a text of at most 64 bytes nor an integer",
                     "choose another; it comes back as it is");
    }
    call.id = id;
  }
  std::string_view version;
  if (object.at_key("jsonrpc").get(version) != simdjson::SUCCESS || version != "2.0")
    return invalid("'jsonrpc' is missing or not \"2.0\"", R"(write "jsonrpc": "2.0")");
  if (object.at_key("method").get(call.method) != simdjson::SUCCESS)
    return invalid("'method' is missing or no text", R"(write "method": "list")");
  if (JsonElement params; object.at_key("params").get(params) == simdjson::SUCCESS) {
    if (params.is_array()) {
      call.id = id;
      return RpcProblem{RpcError::invalid_params, "parameters by position are not taken",
                        R"(write them by name: "params": {"slot": "tool_pose"})"};
    }
    if (params.get(call.params) != simdjson::SUCCESS)
      return invalid("'params' is no object", R"(write "params": {...}, or leave it away)");
  }
  call.id = id;
  return std::nullopt;
}

std::string error_line(std::string_view id, const RpcProblem& problem) {
  JsonWriter json(std::string{}, JsonWriter::Style::compact);
  json.begin_object().member("jsonrpc", "2.0").key("id").raw(id).key("error").begin_object();
  json.member("code", static_cast<int>(problem.error)).member("message", message_of(problem.error));
  json.key("data").begin_object().member("reason", problem.reason).member("hint", problem.hint);
  json.end_object().end_object().end_object();
  return json.release();
}

}  // namespace flexrf::remote
