// What the helper takes for a request, and how it refuses what is none.
#include "image/helper/request.hpp"

#include <memory>
#include <string>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf::helper::request_test {
namespace {

std::variant<Request, Answer> parse(const std::string& message) {
  static const auto reader = std::make_unique<JsonReader>();
  return parse_request(*reader, message);
}

Request request(const std::string& message) {
  auto parsed = parse(message);
  if (const Answer* const answer = std::get_if<Answer>(&parsed)) CHECK_EQUAL(answer->why, "");
  return std::get<Request>(parsed);
}

/// "STATUS WHY"
std::string refusal(const std::string& message) {
  const auto parsed = parse(message);
  CHECK(std::holds_alternative<Answer>(parsed));
  const Answer& answer = std::get<Answer>(parsed);
  return std::to_string(answer.status) + ' ' + answer.why;
}

void each_verb_has_its_members() {
  CHECK(request(R"({"verb":"state"})").verb == Verb::state);
  CHECK(request("{\"verb\":\"state\"}\n").verb == Verb::state);
  const Request upload = request(R"({"verb":"upload","user":"anna","password":"p\u00e4ss","size":1234})");
  CHECK(upload.verb == Verb::upload);
  CHECK_EQUAL(upload.user, "anna");
  CHECK_EQUAL(upload.password, "p\xc3\xa4ss");
  CHECK_EQUAL(upload.size, 1234U);
  const std::string bytes("\0\n{\xff", 4);
  const Request part = request("{\"verb\":\"part\",\"upload\":\"00ff\",\"offset\":61440}\n" + bytes);
  CHECK_EQUAL(part.upload, "00ff");
  CHECK_EQUAL(part.offset, 61440U);
  CHECK(part.bytes == bytes);
  CHECK(request(R"({"verb":"install","user":"a","password":"b","older":true,"other_drivers":false})").older);
  CHECK(request(R"({"verb":"install","user":"a","password":"b","older":false,"other_drivers":true})")
            .other_drivers);
  CHECK(request(R"({"verb":"choose","user":"a","password":"b","slot":"B","other_drivers":false})").slot ==
        boot::Slot::b);
  CHECK(request(R"({"password":"b","user":"a","verb":"restart"})").verb == Verb::restart);
  const Request network = request(
      R"({"verb":"network","user":"a","password":"b","interface":"enp0s2","address":"10.0.2.16/24","gateway":"10.0.2.2"})");
  CHECK(network.verb == Verb::network);
  CHECK_EQUAL(network.interface + ' ' + network.address + ' ' + network.gateway,
              "enp0s2 10.0.2.16/24 10.0.2.2");
  CHECK_EQUAL(
      request(R"({"verb":"keep-network","user":"a","password":"b","reached_by":"10.0.2.16"})").reached_by,
      "10.0.2.16");
  const Request dismiss = request(R"({"verb":"dismiss-failure","user":"a","password":"b","slot":"B"})");
  CHECK(dismiss.verb == Verb::dismiss_failure);
  CHECK(dismiss.slot == boot::Slot::b);
  CHECK_EQUAL(request(R"({"verb":"make-room","user":"a","password":"b","what":"logs"})").what, "logs");
  const Request hosts = request(R"({"verb":"hosts","user":"a","password":"b","hosts":"cell7 203.0.113.7"})");
  CHECK(hosts.verb == Verb::hosts);
  CHECK_EQUAL(hosts.hosts, "cell7 203.0.113.7");
}

void what_is_no_request_is_told_what_is_wrong() {
  CHECK_CONTAINS(refusal(""), "400 no JSON");
  CHECK_CONTAINS(refusal("{\"verb\":\"sta"), "400 no JSON");
  CHECK_CONTAINS(refusal("[]"), "no object");
  CHECK_CONTAINS(refusal("{}"), "400 'verb' is missing");
  CHECK_CONTAINS(refusal(R"({"verb":7})"), "400 'verb' is not a text");
  CHECK_CONTAINS(refusal(R"({"verb":"netwerk"})"), "400 there is no verb 'netwerk'; the verbs are state");
  CHECK_CONTAINS(refusal(R"({"verb":"state","verb":"restart"})"), "'verb' comes twice");
  CHECK_CONTAINS(refusal(R"({"verb":"state","user":"anna"})"),
                 "'state' has no member 'user'; its members are verb");
  CHECK_CONTAINS(refusal(R"({"verb":"upload","user":"a","password":"b"})"), "400 'size' is missing");
  CHECK_CONTAINS(refusal(R"({"verb":"upload","user":"a","password":"b","size":-1})"),
                 "'size' is not an integer");
  CHECK_CONTAINS(refusal(R"({"verb":"upload","user":"a","password":"b","size":1.5})"),
                 "'size' is not an integer");
  CHECK_CONTAINS(refusal(R"({"verb":"upload","user":null,"password":"b","size":1})"), "'user' is not a text");
  CHECK_CONTAINS(
      refusal(R"({"verb":"install","user":"a","password":"b","older":"no","other_drivers":false})"),
      "'older' is not true or false");
  CHECK_CONTAINS(refusal(R"({"verb":"choose","user":"a","password":"b","slot":"C","other_drivers":false})"),
                 "400 'slot' is 'C'; the slots are A and B");
  CHECK_CONTAINS(refusal(R"({"verb":"choose","user":"a","password":"b","other_drivers":false})"),
                 "400 'slot' is missing");
  CHECK_CONTAINS(refusal("{\"verb\":\"restart\",\"user\":\"a\",\"password\":\"b\"}\n{\"verb\":\"state\"}"),
                 "400 behind the line of 'restart' comes nothing");
  CHECK_CONTAINS(refusal(R"({"verb":"hosts","user":"a","password":"b"})"), "400 'hosts' is missing");
  CHECK_CONTAINS(refusal(R"({"verb":"hosts","user":"a","password":"b","hosts":["cell7"]})"),
                 "400 'hosts' is not a text");
  CHECK_CONTAINS(refusal(R"({"verb":"part","upload":"00","offset":0})"), "400 the part's bytes are missing");
}

void what_is_too_large_is_refused() {
  const std::string line = R"({"verb":"part","upload":"00","offset":0})";
  CHECK_EQUAL(request(line + '\n' + std::string(longest_part, 'x')).bytes.size(), longest_part);
  CHECK_CONTAINS(refusal(line + '\n' + std::string(longest_part + 1, 'x')), "413 a part has at most 60 KiB");
  const std::string name(longest_line, 'n');
  CHECK_CONTAINS(refusal(R"({"verb":")" + name + "\"}"), "413 the line of a request has at most 1 KiB");
  CHECK_CONTAINS(refusal(std::string(longest_line, '[')), "400 no JSON");
}

void an_answer_is_an_object() {
  CHECK_EQUAL(Answer{}.text(), R"({"ok":true})");
  CHECK_EQUAL(refuse(409, "not \"now\"").text(), R"({"ok":false,"status":409,"why":"not \"now\""})");
  Answer early = refuse(429, "wait");
  early.retry_after_s = 2;
  CHECK_EQUAL(early.text(), R"({"ok":false,"status":429,"why":"wait","retry_after":2})");
  Answer part;
  part.received = 0;
  CHECK_EQUAL(part.text(), R"({"ok":true,"received":0})");
}

}  // namespace
}  // namespace flexrf::helper::request_test

int main() {
  using namespace flexrf::helper::request_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(each_verb_has_its_members),
      CONTAINED_TEST(what_is_no_request_is_told_what_is_wrong),
      CONTAINED_TEST(what_is_too_large_is_refused),
      CONTAINED_TEST(an_answer_is_an_object),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
