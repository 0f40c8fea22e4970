// The helper's decisions: its word, the version's confirmation, the turn that is given up. The panel, the
// clock and the restart are the test's.
#include "image/helper/helper.hpp"

#include <stdlib.h>  // mkdtemp

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "image/boot/folder_medium.hpp"
#include "image/boot/verbs.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::helper {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

const std::string admin =
    "anna:admin:$argon2id$v=19$m=65536,t=2,p=1$c29tZXNhbHRzb21lc2FsdA$"
    "GpZ3sK/oH9p7VIiV56G/64Zo/8GaUw434IimaPqxwCo\n";

class Pc {
 public:
  Pc() {
    char name[] = "/tmp/flexrf-helper-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
    files.word = path_ + "/motion";
    files.users = path_ + "/panel-users";
    files.choice = path_ + "/choice";
    files.command_line = path_ + "/cmdline";
    fs::create_directory(files.choice);
    choose({"create"});
    boots("A", "only");
  }
  Pc(const Pc&) = delete;
  Pc& operator=(const Pc&) = delete;
  ~Pc() { fs::remove_all(path_); }

  /// As flexrf-boot-choice does it.
  void choose(const std::vector<std::string>& words) const {
    boot::FolderMedium medium;
    CHECK(medium.open(files.choice, seconds{1}));
    CHECK(boot::perform(words, medium, {}).exit == boot::Exit::done);
  }
  bool says(const std::string& line) const {
    boot::FolderMedium medium;
    CHECK(medium.open(files.choice, seconds{1}));
    return boot::perform({"status"}, medium, {}).answer.find(line + '\n') != std::string::npos;
  }
  void boots(const std::string& slot, const std::string& why) const {
    std::ofstream(files.command_line)
        << "quiet rauc.slot=" << slot << " flexrf.boot=" << why << " flexrf.trial=0000000001\n";
  }
  void claim() const {
    std::ofstream(files.users) << admin;
    fs::permissions(files.users, fs::perms::owner_read | fs::perms::owner_write);
  }
  std::string word() const {
    std::ifstream file(files.word);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  Files files;
  std::string why_not;  // what the panel answers
  int restarts = 0;
  std::vector<std::string> said;
  Time now{seconds{100}};
  Helper helper() {
    return {files,
            {},
            {[this] { return why_not; }, [this](const std::string& line) { said.push_back(line); },
             [this] { ++restarts; }},
            now};
  }
  /// A look a second.
  void run(Helper& helper, int looks) {
    for (int i = 0; i < looks; ++i) {
      helper.look(now);
      now += seconds{1};
    }
  }

 private:
  std::string path_;
};

void the_word_says_what_stands_against_motion() {
  Facts facts;
  facts.choice_failure = "the folder is not there";
  CHECK_CONTAINS(permission_of(facts), "nobody has claimed this PC");
  facts.is_claimed = true;
  CHECK_CONTAINS(permission_of(facts), "cannot be told: the folder is not there");
  facts.choice = boot::choice_of_new_disk();
  CHECK_CONTAINS(permission_of(facts), "boot loader");
  facts.running.slot = boot::Slot::a;
  CHECK_CONTAINS(permission_of(facts), "has not confirmed itself");
  // The other one's mark is no help.
  facts.choice->of(boot::Slot::b) = {true, true};
  CHECK_CONTAINS(permission_of(facts), "has not confirmed itself");
  facts.choice->of(boot::Slot::a) = {true, true};
  CHECK_EQUAL(permission_of(facts), "permitted");
  facts.is_claimed = false;
  CHECK_CONTAINS(permission_of(facts), "nobody has claimed this PC");
}

void a_minute_of_health_confirms_the_version() {
  Pc pc;
  pc.claim();
  Helper helper = pc.helper();
  pc.run(helper, 60);  // the first and the last of these are 59 s apart
  CHECK_CONTAINS(pc.word(), "has not confirmed itself");
  CHECK(pc.says("A=whole,unconfirmed"));
  pc.run(helper, 1);
  CHECK_EQUAL(pc.word(), "permitted\n");
  CHECK(pc.says("A=whole,confirmed"));
  CHECK_CONTAINS(pc.said.at(pc.said.size() - 2), "slot A has confirmed itself");
  // From then on the panel is not asked: what runs is what boots.
  pc.why_not = "unit robot is in fault";
  pc.run(helper, 1000);
  CHECK_EQUAL(pc.word(), "permitted\n");
  CHECK_EQUAL(pc.restarts, 0);
}

void the_minute_begins_anew_after_each_gap() {
  Pc pc;
  pc.claim();
  Helper helper = pc.helper();
  pc.run(helper, 50);
  pc.why_not = "unit robot is in fault: no answer";
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.said.back(), "cannot confirm itself yet: unit robot is in fault: no answer");
  pc.why_not = "";
  pc.run(helper, 60);
  CHECK(pc.says("A=whole,unconfirmed"));
  pc.now += seconds{20};  // nobody looked: the helper stood still, or was started anew
  pc.run(helper, 60);
  CHECK(pc.says("A=whole,unconfirmed"));
  pc.run(helper, 1);
  CHECK(pc.says("A=whole,confirmed"));
}

void an_unclaimed_pc_confirms_itself_and_does_not_move() {
  Pc pc;
  Helper helper = pc.helper();
  pc.run(helper, 100);
  CHECK(pc.says("A=whole,confirmed"));
  CHECK_CONTAINS(pc.word(), "nobody has claimed this PC");
  pc.claim();
  pc.run(helper, 1);
  CHECK_EQUAL(pc.word(), "permitted\n");
  // Others than an admin cannot claim it, and a file that others may read counts for nothing.
  std::ofstream(pc.files.users) << "olga:operator" << admin.substr(admin.find(":$"));
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.word(), "nobody has claimed this PC");
  pc.claim();
  pc.run(helper, 1);
  CHECK_EQUAL(pc.word(), "permitted\n");
  fs::permissions(pc.files.users, fs::perms::others_read, fs::perm_options::add);
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.word(), "nobody has claimed this PC");
}

void a_version_on_trial_that_is_not_healthy_gives_up_its_turn_once() {
  Pc pc;
  pc.claim();
  pc.choose({"set-primary", "B"});
  pc.choose({"mark-whole", "B", pc.files.command_line});
  pc.boots("B", "trial");
  pc.why_not = "device arm is in fault: it does not answer";
  Helper helper = pc.helper();
  pc.run(helper, 600);
  CHECK_EQUAL(pc.restarts, 0);
  pc.run(helper, 30);
  CHECK_EQUAL(pc.restarts, 1);
  CHECK_CONTAINS(pc.said.back(), "gives up its turn");
  CHECK_CONTAINS(pc.word(), "has not confirmed itself");
}

void a_version_without_another_one_never_restarts() {
  for (const char* const why : {"only", "fallback", "unknown", "manual"}) {
    Pc pc;
    pc.claim();
    pc.boots("A", why);
    pc.why_not = "device arm is in fault: it does not answer";
    Helper helper = pc.helper();
    pc.run(helper, 2000);
    CHECK_EQUAL(pc.restarts, 0);
  }
  Pc pc;  // on trial, and the other slot is no longer whole
  pc.boots("A", "trial");
  pc.why_not = "device arm is in fault: it does not answer";
  Helper helper = pc.helper();
  pc.run(helper, 2000);
  CHECK_EQUAL(pc.restarts, 0);
}

void without_the_choice_nothing_moves_and_it_is_said_once() {
  Pc pc;
  pc.claim();
  fs::remove_all(pc.files.choice);
  Helper helper = pc.helper();
  pc.run(helper, 100);
  CHECK_CONTAINS(pc.word(), "cannot be told: cannot open " + pc.files.choice);
  CHECK_EQUAL(pc.said.size(), 3U);  // the word, health, and why it cannot be confirmed
}

void a_word_that_cannot_be_left_is_left_when_it_can() {
  Pc pc;
  pc.claim();
  const std::string folder = pc.files.choice + "/run";
  pc.files.word = folder + "/motion";
  Helper helper = pc.helper();
  pc.run(helper, 5);
  CHECK_CONTAINS(pc.said.front(), "the word about motion cannot be left");
  fs::create_directory(folder);
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.word(), "has not confirmed itself");
}

}  // namespace
}  // namespace flexrf::helper

int main() {
  using namespace flexrf::helper;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(the_word_says_what_stands_against_motion),
      CONTAINED_TEST(a_minute_of_health_confirms_the_version),
      CONTAINED_TEST(the_minute_begins_anew_after_each_gap),
      CONTAINED_TEST(an_unclaimed_pc_confirms_itself_and_does_not_move),
      CONTAINED_TEST(a_version_on_trial_that_is_not_healthy_gives_up_its_turn_once),
      CONTAINED_TEST(a_version_without_another_one_never_restarts),
      CONTAINED_TEST(without_the_choice_nothing_moves_and_it_is_said_once),
      CONTAINED_TEST(a_word_that_cannot_be_left_is_left_when_it_can),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
