// The host by which a PC was claimed, and a helper that declares it or not.
#include "image/claim/host_declaration.hpp"

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "runtime/executive/tests/checks.hpp"
#include "web-ui/server/access/host_file.hpp"
#include "web-ui/server/machine/tests/played_helper.hpp"

namespace flexrf::claim {
namespace {

/// flexrf-helper, which notes what it is asked, and says this.
class Helper {
 public:
  explicit Helper(std::string answer)
      : says_(std::move(answer)), played_(place_.path(), [this](const std::string& line, const std::string&) {
          const std::lock_guard lock(mutex_);
          asked_.push_back(line);
          return panel::PlayedHelper::Reaction{panel::PlayedHelper::How::answers, says_};
        }) {}

  const std::string& path() const { return place_.path(); }
  std::string hosts_file() const { return place_.path() + ".hosts"; }
  void say(std::string answer) {
    const std::lock_guard lock(mutex_);
    says_ = std::move(answer);
  }
  std::vector<std::string> asked() {
    const std::lock_guard lock(mutex_);
    return asked_;
  }

 private:
  panel::SocketPlace place_;
  std::mutex mutex_;
  std::string says_;
  std::vector<std::string> asked_;
  panel::PlayedHelper played_;
};

void a_host_is_added_to_those_that_are_declared() {
  Helper helper(R"({"ok":true})");
  const std::string file = helper.hosts_file();
  const HostDeclaration declaration(helper.path(), file);
  const Admin admin{"anna", "p\"w"};
  CHECK(declaration.declare(admin, "Cell7.example.org"));
  CHECK_EQUAL(helper.asked().at(0),
              R"({"verb":"hosts","user":"anna","password":"p\"w","hosts":"cell7.example.org"})");
  CHECK(panel::write_hosts(file, {"cell7.example.org", "cell8"}));
  CHECK(declaration.declare(admin, "203.0.113.7"));
  CHECK_CONTAINS(helper.asked().at(1), R"("hosts":"cell7.example.org cell8 203.0.113.7"})");
  // The helper is not asked about a host that is declared already.
  CHECK(declaration.declare(admin, "CELL8"));
  CHECK_EQUAL(helper.asked().size(), 2U);
}

void why_a_host_is_not_declared_is_told() {
  Helper helper(R"({"ok":false,"status":503,"why":"there is no room"})");
  const std::string file = helper.hosts_file();
  const HostDeclaration declaration(helper.path(), file);
  const auto why_not = [&](const HostDeclaration& one, const std::string& host) {
    const Status status = one.declare({"anna", "p"}, host);
    CHECK(!status);
    return std::string{status.cause()};
  };
  CHECK_EQUAL(why_not(declaration, "cell7"), "there is no room");
  helper.say("rubbish");
  CHECK_CONTAINS(why_not(declaration, "cell7"), "no JSON");
  CHECK_EQUAL(helper.asked().size(), 2U);
  CHECK_CONTAINS(why_not(declaration, "fd00::7"), "'fd00::7' is no host");
  CHECK(panel::write_hosts(file, {"a", "b", "c", "d", "e", "f", "g", "h"}));
  CHECK_CONTAINS(why_not(declaration, "cell7"), "at most 8 hosts");
  CHECK_EQUAL(helper.asked().size(), 2U);
  CHECK(panel::write_hosts(file, {}));
  CHECK_CONTAINS(why_not(HostDeclaration(file, file), "cell7"), "the PC's helper is not there");
}

}  // namespace
}  // namespace flexrf::claim

int main() {
  using namespace flexrf::claim;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_host_is_added_to_those_that_are_declared),
      CONTAINED_TEST(why_a_host_is_not_declared_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
