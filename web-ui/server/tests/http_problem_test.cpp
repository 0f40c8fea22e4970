#include "web-ui/server/http_problem.hpp"

#include "tests/cmocka.hpp"
#include "web-ui/server/api/problem.hpp"

namespace flexrf::panel {
namespace {

void a_problem_is_the_whole_reply(void**) {
  Reply reply;
  reply.text = "what was begun";
  reply.etag = "\"1\"";
  reply.content_encoding = "gzip";
  reply.set_cookie = "a=b";
  answer_problem(reply, 421, "not called \"a\\b\"\n\xFF");
  assert_int_equal(reply.status, 421);
  assert_string_equal(reply.text.c_str(),
                      R"({"type":"about:blank","title":"Misdirected Request","status":421,)"
                      R"("detail":"not called \"a\\b\"\n)"
                      "\xEF\xBF\xBD\"}");
  assert_true(reply.content_type == "application/problem+json");
  assert_true(reply.etag.empty() && reply.content_encoding.empty());
  assert_string_equal(reply.set_cookie.c_str(), "a=b");
}

void each_refusal_has_a_status_with_a_title(void**) {
  for (int kind = 0; kind <= static_cast<int>(RefusalKind::not_stored); ++kind) {
    Reply reply;
    write_problem(reply, Refusal::make(static_cast<RefusalKind>(kind), "No."));
    const bool has_title = title_of(reply.status) != "Unknown";
    if (!has_title) print_error("%u has no title\n", reply.status);
    assert_true(has_title);
  }
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_problem_is_the_whole_reply),
      cmocka_unit_test(each_refusal_has_a_status_with_a_title),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
