// Claiming a PC: the code, the tries, the file that it leaves, and what a browser is shown.
#include "image/claim/claim.hpp"

#include <stdlib.h>  // mkdtemp
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "image/claim/claim_page.hpp"
#include "image/claim/claim_service.hpp"
#include "image/claim/form.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::claim {
namespace {

namespace fs = std::filesystem;
using panel::Method;
using std::chrono::milliseconds;
using std::chrono::seconds;

const std::string password = "a long password of anna";

class NewPc {
 public:
  NewPc() {
    char name[] = "/tmp/flexrf-claim-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
    users = path_ + "/panel-users";
  }
  NewPc(const NewPc&) = delete;
  NewPc& operator=(const NewPc&) = delete;
  ~NewPc() { fs::remove_all(path_); }

  std::string users;

 private:
  std::string path_;
};

const panel::Address near = *panel::Address::parse("192.168.1.7");
const panel::Address far = *panel::Address::parse("10.0.2.9");

Wish wish_with(const std::string& code) {
  return {code, "anna", password, password};
}

/// One that is not the code.
std::string wrong(const Claim& claim) {
  std::string code = claim.code().text();
  code.back() = code.back() == 'A' ? 'B' : 'A';
  return code;
}

void codes_are_easy_to_type_and_hard_to_guess() {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) {
    const ClaimCode code;
    const std::string text = code.text();
    CHECK_EQUAL(text.size(), 11U);
    CHECK(text[5] == '-' && text.find_first_of("ILOU") == std::string::npos);
    CHECK(seen.insert(text).second);
    CHECK(code.is(text));
    CHECK(code.is(text.substr(0, 5) + " " + text.substr(6)));
    CHECK(!code.is(text + "0"));
    CHECK(!code.is(text.substr(1)));
    CHECK(!code.is(""));
    std::string other = text;
    for (char& one : other) {
      if (one == '0') one = 'o';
      if (one == '1') one = 'l';
      if (one >= 'A' && one <= 'Z') one = static_cast<char>(one - 'A' + 'a');
    }
    CHECK(code.is(other));
  }
}

void the_right_code_makes_an_admin_once() {
  const NewPc pc;
  Claim claim(pc.users);
  const Answer answer = claim.attempt(wish_with(claim.code().text()), near, Time{seconds{100}});
  CHECK_EQUAL(answer.status, 200U);
  CHECK(claim.is_done());
  const Result<panel::Users> users = panel::read_users(pc.users);
  CHECK(users && users->list.size() == 1);
  CHECK(users->list.front().name == "anna" && users->list.front().role == Role::admin);
  CHECK(panel::is_right_password(users->list.front().password_hash, password));
  struct stat about {};
  CHECK(stat(pc.users.c_str(), &about) == 0 && (about.st_mode & 0777U) == 0600U);
  CHECK_EQUAL(claim.attempt(wish_with(claim.code().text()), near, Time{seconds{200}}).status, 403U);
}

void slips_cost_no_try() {
  const NewPc pc;
  Claim claim(pc.users);
  const std::string code = claim.code().text();
  const auto told = [&](const Wish& wish) {
    const Answer answer = claim.attempt(wish, near, Time{seconds{100}});
    CHECK_EQUAL(answer.status, 400U);
    return answer.text;
  };
  for (int i = 0; i < 20; ++i) {
    CHECK_CONTAINS(told({"", "anna", password, password}), "The code is missing");
    CHECK_CONTAINS(told({code, "anna", password, password + "x"}), "not the same");
    CHECK_CONTAINS(told({code, "anna", "short", "short"}), "12");
    CHECK_CONTAINS(told({code, "an:na", password, password}), "an:na");
  }
  CHECK_EQUAL(claim.code().text(), code);
  CHECK_EQUAL(claim.attempt(wish_with(code), near, Time{seconds{100}}).status, 200U);
}

void wrong_codes_delay_their_own_address() {
  const NewPc pc;
  Claim claim(pc.users);
  Time now{seconds{100}};
  unsigned refused = 0;
  for (int i = 0; i < 100; ++i) {
    const Answer answer = claim.attempt(wish_with(wrong(claim)), near, now);
    if (answer.status == 429) {
      ++refused;
      CHECK_CONTAINS(answer.text, "Try again in ");
      CHECK(answer.wait_s >= 1 && answer.wait_s <= 2);
    } else {
      CHECK_EQUAL(answer.status, 403U);
      CHECK_CONTAINS(answer.text, "not the code");
    }
    now += milliseconds{500};
  }
  CHECK(refused > 50);
  CHECK_EQUAL(claim.attempt(wish_with(claim.code().text()), far, now).status, 200U);
}

/// Each of them as often as the network lets it, and a person who types the code in a minute.
void two_hundred_and_fifty_who_guess_keep_nobody_out() {
  for (int times = 0; times < 3; ++times) {
    const NewPc pc;
    Claim claim(pc.users);
    Time now{seconds{100}};
    const std::string read = claim.code().text();
    for (int i = 0; i < 6'000; ++i) {
      const std::string address = "10.0.3." + std::to_string(1 + i % 250);
      CHECK(claim.attempt(wish_with(wrong(claim)), *panel::Address::parse(address), now).status != 200U);
      now += milliseconds{10};
    }
    CHECK_EQUAL(claim.attempt(wish_with(read), near, now).status, 200U);
  }
}

void a_code_that_was_tried_too_often_is_replaced_after_two_minutes() {
  const NewPc pc;
  Claim claim(pc.users);
  const std::string first = claim.code().text();
  const std::string guess = wrong(claim);
  Time now{seconds{100}};
  const Time began = now;
  // By as many addresses as there are, so that none has a delay.
  unsigned asked = 0;
  const auto ask = [&] {
    const std::string address =
        "2001:db8:" + std::to_string(asked / 9999) + ":" + std::to_string(asked % 9999) + "::1";
    ++asked;
    return claim.attempt(wish_with(guess), *panel::Address::parse(address), now);
  };
  for (unsigned i = 0; i < Claim::tries; ++i) CHECK_EQUAL(ask().status, 403U);
  CHECK_EQUAL(claim.code().text(), first);
  now = began + Claim::shortest_life;
  CHECK_CONTAINS(ask().text, "shows a new one now");
  CHECK(claim.code().text() != first);
  // The old one is worth nothing any more.
  CHECK_EQUAL(claim.attempt(wish_with(first), near, now).status, 403U);
  CHECK(!fs::exists(pc.users));
  CHECK_EQUAL(claim.attempt(wish_with(claim.code().text()), far, now).status, 200U);
}

void a_file_that_is_there_is_not_overruled() {
  const NewPc pc;
  Claim claim(pc.users);
  std::ofstream(pc.users) << "somebody's";
  CHECK_EQUAL(claim.attempt(wish_with(claim.code().text()), near, Time{seconds{100}}).status, 503U);
  CHECK(!claim.is_done());
  CHECK_EQUAL(fs::file_size(pc.users), 10U);
}

void a_file_that_cannot_be_written_is_told() {
  const NewPc pc;
  Claim claim(pc.users + "/none/at/all");
  const Answer answer = claim.attempt(wish_with(claim.code().text()), near, Time{seconds{100}});
  CHECK_EQUAL(answer.status, 503U);
  CHECK_CONTAINS(answer.text, pc.users);
  CHECK(!claim.is_done());
}

void forms_are_read_as_browsers_write_them() {
  const auto form = read_form("code=7QK2M-9XR4T&user=anna&password=a+%2B%26%3D%C3%A4&repeated=");
  CHECK(form.has_value());
  CHECK_EQUAL(form->at("code"), "7QK2M-9XR4T");
  CHECK_EQUAL(form->at("password"), "a +&=\xC3\xA4");
  CHECK_EQUAL(form->at("repeated"), "");
  CHECK(read_form("")->empty());
  for (const char* const wrong : {"user", "user=%", "user=%4", "user=%GG", "user=a&user=b", "us%er=a"})
    CHECK(!read_form(wrong).has_value());
}

// ---- what is served

struct Served {
  explicit Served(const std::string& users)
      : claim(users), service(claim, "cell<7>", [this](const Admin& admin, const std::string& declared_host) {
          CHECK(claim.is_done());  // the helper asks for the password that the claim has set
          declared.push_back(admin.user + '/' + admin.password + '@' + declared_host);
          return why_not_declared;
        }) {}

  panel::Reply ask(Method method, const std::string& path, const std::string& body = "",
                   const std::string& content_type = "application/x-www-form-urlencoded") {
    panel::Request request;
    request.method = method;
    request.path = path;
    request.body = body;
    request.content_type = content_type;
    request.host = host;
    request.remote_address = "192.168.1.7";
    request.local_end = *panel::Address::parse("192.168.1.9");
    panel::Reply reply;
    panel::SessionIndex session = panel::no_session;
    if (service.admit(request, session, reply)) service.handle(request, reply, {});
    return reply;
  }
  std::string token() {
    const std::string page = ask(Method::get, "/").text;
    const std::string before = "name=\"token\" value=\"";
    const std::size_t at = page.find(before);
    CHECK(at != std::string::npos);
    return page.substr(at + before.size(), 32);
  }
  std::string form(const std::string& code) {
    return "token=" + token() + "&code=" + code +
           "&user=anna&password=a+long+password+of+anna&repeated=a+long+password+of+anna";
  }

  std::string host = "192.168.1.9:8443";
  std::vector<std::string> declared;
  Status why_not_declared;
  Claim claim;
  ClaimService service;
};

void nothing_but_the_page_is_served() {
  const NewPc pc;
  Served served(pc.users);
  const panel::Reply page = served.ask(Method::get, "/");
  CHECK_EQUAL(page.status, 200U);
  CHECK_CONTAINS(page.content_type, "text/html");
  CHECK_CONTAINS(page.text, "<h1>cell&lt;7&gt;</h1>");
  CHECK_EQUAL(served.ask(Method::get, "/claim.css").content_type, std::string_view{"text/css"});
  for (const char* const path : {"/api/v1/state", "/api/v1/health", "/api/v1/login"}) {
    CHECK_EQUAL(served.ask(Method::get, path).status, 503U);
    CHECK_EQUAL(served.ask(Method::post, path, "{}").status, 503U);
  }
  CHECK_EQUAL(served.ask(Method::get, "/application/arm.urdf").status, 404U);
  CHECK_EQUAL(served.ask(Method::put, "/claim", served.form(served.claim.code().text())).status, 404U);
  CHECK(!served.claim.is_done());
}

void a_form_of_another_page_costs_no_try() {
  const NewPc pc;
  Served served(pc.users);
  const std::string code = served.claim.code().text();
  const std::string form = served.form(code);
  const std::string foreign = "token=00000000000000000000000000000000" + form.substr(38);
  for (int i = 0; i < 20; ++i) {
    const panel::Reply reply = served.ask(Method::post, "/claim", foreign);
    CHECK_EQUAL(reply.status, 403U);
    CHECK_CONTAINS(reply.text, "This form was of before");
    CHECK_EQUAL(served.ask(Method::post, "/claim", form.substr(39)).status, 403U);
    CHECK_EQUAL(served.ask(Method::post, "/claim", form, "text/plain").status, 400U);
  }
  CHECK_EQUAL(served.claim.code().text(), code);
  CHECK_EQUAL(served.ask(Method::post, "/claim", form).status, 200U);
}

void the_page_says_what_was_wrong_and_repeats_no_secret() {
  const NewPc pc;
  Served served(pc.users);
  const panel::Reply reply = served.ask(Method::post, "/claim", served.form(wrong(served.claim)));
  CHECK_EQUAL(reply.status, 403U);
  CHECK_CONTAINS(reply.text, "role=\"alert\">That is not the code on the PC's screen.");
  CHECK_CONTAINS(reply.text, "value=\"anna\"");
  CHECK(reply.text.find("a long password") == std::string::npos);
  const panel::Reply odd = served.ask(
      Method::post, "/claim", "token=" + served.token() + "&code=x&user=%22%3E%3Cb%3E&password=&repeated=");
  CHECK_EQUAL(odd.status, 400U);
  CHECK(odd.text.find("<b>") == std::string::npos);
  CHECK_CONTAINS(odd.text, "&quot;&gt;&lt;b&gt;");
}

void the_server_may_end_when_the_answer_is_there() {
  const NewPc pc;
  Served served(pc.users);
  served.service.on_tick(MonotonicClock::now() + seconds{100});
  CHECK(!served.service.may_end());
  const Time before_answer = MonotonicClock::now();
  CHECK_EQUAL(served.ask(Method::post, "/claim", served.form(served.claim.code().text())).status, 200U);
  served.service.on_tick(before_answer);
  CHECK(!served.service.may_end());
  served.service.on_tick(MonotonicClock::now() + seconds{100});
  CHECK(served.service.may_end());
}

// ---- the host by which the code was typed

void the_page_answers_to_any_host_that_is_one() {
  const NewPc pc;
  Served served(pc.users);
  for (const char* const host :
       {"192.168.1.9", "localhost:18443", "203.0.113.7:8443", "Cell7.example.org", "[fd00::7]:8443"}) {
    served.host = host;
    CHECK_EQUAL(served.ask(Method::get, "/").status, 200U);
  }
  for (const char* const host : {"", ":8443", "cell7:", "cell 7", "user@cell7", "<b>", "[::1"}) {
    served.host = host;
    CHECK_EQUAL(served.ask(Method::get, "/").status, 421U);
    CHECK_EQUAL(served.ask(Method::post, "/claim", "code=x").status, 421U);
  }
  CHECK(!served.claim.is_done() && served.declared.empty());
}

void the_host_by_which_the_code_was_typed_is_declared() {
  const NewPc pc;
  Served served(pc.users);
  served.host = "Cell7.example.org:8443";
  CHECK_EQUAL(served.ask(Method::post, "/claim", served.form(wrong(served.claim))).status, 403U);
  CHECK(served.declared.empty());
  const panel::Reply reply = served.ask(Method::post, "/claim", served.form(served.claim.code().text()));
  CHECK_EQUAL(reply.status, 200U);
  CHECK(served.declared == std::vector<std::string>{"anna/" + password + "@Cell7.example.org"});
  CHECK_CONTAINS(reply.text, "The panel answers at <b>Cell7.example.org</b>, too");
  CHECK(reply.text.find("class=\"wrong\"") == std::string::npos);
}

void a_host_of_the_pcs_own_needs_no_declaration() {
  for (const char* const host : {"192.168.1.9:8443", "localhost:18443"}) {
    const NewPc pc;
    Served served(pc.users);
    served.host = host;
    const panel::Reply reply = served.ask(Method::post, "/claim", served.form(served.claim.code().text()));
    CHECK_EQUAL(reply.status, 200U);
    CHECK(served.declared.empty());
    CHECK(reply.text.find("The panel") == std::string::npos);
  }
}

void a_host_that_cannot_be_declared_does_not_undo_the_claim() {
  const NewPc pc;
  Served served(pc.users);
  served.host = "203.0.113.7";
  served.why_not_declared = Status::error(StatusCode::unavailable, "no <helper>");
  const panel::Reply reply = served.ask(Method::post, "/claim", served.form(served.claim.code().text()));
  CHECK_EQUAL(reply.status, 200U);
  CHECK(served.claim.is_done());
  CHECK_CONTAINS(reply.text, "<b>anna</b> is its admin");
  CHECK_CONTAINS(
      reply.text,
      "<p class=\"wrong\">The panel may not answer at <b>203.0.113.7</b>, by which you opened this "
      "page: no &lt;helper&gt;. Open it by another address");
}

}  // namespace
}  // namespace flexrf::claim

int main() {
  using namespace flexrf::claim;
  if (!flexrf::panel::prepare_cryptography()) return 1;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(codes_are_easy_to_type_and_hard_to_guess),
      CONTAINED_TEST(the_right_code_makes_an_admin_once),
      CONTAINED_TEST(slips_cost_no_try),
      CONTAINED_TEST(wrong_codes_delay_their_own_address),
      CONTAINED_TEST(two_hundred_and_fifty_who_guess_keep_nobody_out),
      CONTAINED_TEST(a_code_that_was_tried_too_often_is_replaced_after_two_minutes),
      CONTAINED_TEST(a_file_that_is_there_is_not_overruled),
      CONTAINED_TEST(a_file_that_cannot_be_written_is_told),
      CONTAINED_TEST(forms_are_read_as_browsers_write_them),
      CONTAINED_TEST(nothing_but_the_page_is_served),
      CONTAINED_TEST(a_form_of_another_page_costs_no_try),
      CONTAINED_TEST(the_page_says_what_was_wrong_and_repeats_no_secret),
      CONTAINED_TEST(the_server_may_end_when_the_answer_is_there),
      CONTAINED_TEST(the_page_answers_to_any_host_that_is_one),
      CONTAINED_TEST(the_host_by_which_the_code_was_typed_is_declared),
      CONTAINED_TEST(a_host_of_the_pcs_own_needs_no_declaration),
      CONTAINED_TEST(a_host_that_cannot_be_declared_does_not_undo_the_claim),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
