// grub.cfg itself, read by an interpreter that was written from GRUB's manual: what boots in every state of
// the disk.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "image/boot/blocks.hpp"
#include "image/boot/tests/grub_environment.hpp"
#include "image/boot/tests/pc.hpp"
#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::boot::grub_cfg_test {
namespace {

const ScriptCommands& script() {
  static const ScriptCommands parsed = read_script(place::grub_cfg);
  return parsed;
}

Files files_of(const Choice& choice, const Attempts& attempts) {
  return {{copy_names[0], block_of(choice)},
          {copy_names[1], block_of(choice)},
          {attempts_name, block_of(attempts)}};
}

constexpr Marks none{false, false};
constexpr Marks whole{true, false};
constexpr Marks confirmed{true, true};

void expect_start(GrubMachine& machine, const std::string& slot, const std::string& why) {
  const Started started = machine.start(script());
  CHECK_EQUAL(started.option("rauc.slot"), slot);
  CHECK_EQUAL(started.option("flexrf.boot"), why);
}

// What GRUB can know of the attempts, and do about them.
enum class Counting { of_another_trial, no_attempt, one, two, three, damaged, missing, read_only, lost };

bool may_try(Counting counting) {
  return counting == Counting::of_another_trial || counting == Counting::no_attempt ||
         counting == Counting::one || counting == Counting::two;
}

void set_up(GrubMachine& machine, Counting counting, std::uint64_t trial) {
  std::string& file = machine.files[path_on_esp(attempts_name)];
  switch (counting) {
    case Counting::of_another_trial:
      file = block_of(Attempts{trial + 1, 3, Slot::a, {}});
      break;
    case Counting::no_attempt:
    case Counting::one:
    case Counting::two:
    case Counting::three:
      file = block_of(Attempts{
          trial, static_cast<unsigned>(counting) - static_cast<unsigned>(Counting::no_attempt), Slot::a, {}});
      // With none of this trial's, GRUB has written of another one, if ever.
      if (counting == Counting::no_attempt) file = block_of(Attempts{});
      break;
    case Counting::damaged:
      file[3] = 'x';
      break;
    case Counting::missing:
      machine.files.erase(path_on_esp(attempts_name));
      break;
    case Counting::read_only:
      machine.can_write = false;
      break;
    case Counting::lost:
      machine.loses_writes = true;
      break;
  }
}

struct Expected {
  std::optional<Slot> first;
  std::string why;
  std::optional<Slot> second;
};

// The table of docs/image.md. Nothing where it leaves no slot to trust.
Expected expected_of(const Choice& choice, Counting counting) {
  const Slot primary = choice.primary;
  const Slot rest = other(primary);
  const bool is_rest_whole = choice.of(rest).is_whole;
  const std::optional<Slot> whole_rest = is_rest_whole ? std::optional(rest) : std::nullopt;
  if (choice.of(primary).is_confirmed)
    return is_rest_whole && counting == Counting::three ? Expected{rest, "fallback", primary}
                                                        : Expected{primary, "confirmed", whole_rest};
  if (choice.of(primary).is_whole && !is_rest_whole) return {primary, "only", std::nullopt};
  if (choice.of(primary).is_whole && may_try(counting)) return {primary, "trial", rest};
  if (choice.of(primary).is_whole) return {rest, "fallback", primary};
  if (is_rest_whole) return {rest, "fallback", std::nullopt};
  return {};
}

void take_away(GrubMachine& machine, Slot slot, const char* file) {
  machine.files.erase(std::string(slot == Slot::a ? "(hd0,gpt3)/" : "(hd0,gpt4)/") + file);
}

void expect_decision(const Choice& choice, Counting counting, bool loses_empty_words) {
  const Expected expected = expected_of(choice, counting);
  if (!expected.first) return;
  GrubMachine machine = machine_with(files_of(choice, {}));
  machine.loses_empty_words = loses_empty_words;
  set_up(machine, counting, choice.trial);
  GrubMachine lame = machine;
  expect_start(machine, std::string(1, letter_of(*expected.first)), expected.why);
  // The one that it should start cannot be loaded.
  take_away(lame, *expected.first, "initrd.img");
  if (expected.second) {
    expect_start(lame, std::string(1, letter_of(*expected.second)), "fallback");
  } else {
    CHECK(lame.start(script()).has_restarted);
  }
}

void every_state_has_its_decision() {
  for (const Slot primary : {Slot::a, Slot::b})
    for (const Marks& a : {none, whole, confirmed})
      for (const Marks& b : {none, whole, confirmed})
        for (int counting = 0; counting <= static_cast<int>(Counting::lost); ++counting)
          for (const bool loses_empty_words : {false, true})
            expect_decision({42, primary, 41, {a, b}}, static_cast<Counting>(counting), loses_empty_words);
}

void the_newer_copy_counts() {
  const std::string older = block_of(Choice{9, Slot::a, 9, {confirmed, confirmed}});
  const std::string newer = block_of(Choice{10, Slot::b, 9, {confirmed, confirmed}});
  const std::string attempts = block_of(Attempts{});
  const std::string torn = torn_sector() + torn_sector();
  struct Case {
    std::string first;
    std::string second;
    const char* slot;
  };
  const Case cases[] = {{older, newer, "B"}, {newer, older, "B"}, {older, older, "A"}, {older, torn, "A"},
                        {torn, older, "A"},  {newer, torn, "B"},  {torn, newer, "B"},  {older, "", "A"},
                        {"", newer, "B"},    {newer, "#", "B"}};
  for (const Case& each : cases) {
    GrubMachine machine =
        machine_with({{copy_names[0], each.first}, {copy_names[1], each.second}, {attempts_name, attempts}});
    expect_start(machine, each.slot, "confirmed");
  }
  // Of two that are equally new and differ, Linux and GRUB take the first.
  const std::string twin = block_of(Choice{10, Slot::a, 9, {confirmed, confirmed}});
  GrubMachine machine =
      machine_with({{copy_names[0], newer}, {copy_names[1], twin}, {attempts_name, attempts}});
  expect_start(machine, "B", "confirmed");
  LostPowerDisk disk({{copy_names[0], newer}, {copy_names[1], twin}});
  CHECK(Environment(disk).choice().primary == Slot::b);
}

void a_trial_has_three_attempts() {
  Files files = files_of({42, Slot::b, 41, {confirmed, whole}}, {40, 3, Slot::b, {}});
  for (int attempt = 1; attempt <= 3; ++attempt) {
    const Running running = switch_on(script(), files);
    CHECK(running.slot == Slot::b);
    CHECK_EQUAL(running.why, "trial");
    CHECK_EQUAL(running.trial, 41u);
    const Result<Attempts> counted = attempts_in(files[attempts_name]);
    CHECK(counted);
    CHECK(*counted == (Attempts{41, static_cast<unsigned>(attempt), Slot::b, {}}));
  }
  for (int boot = 0; boot < 3; ++boot) {
    const Running running = switch_on(script(), files);
    CHECK(running.slot == Slot::a);
    CHECK_EQUAL(running.why, "fallback");
    CHECK_EQUAL(running.trial, 41u);
  }
  // Another trial begins with no attempts.
  files[copy_names[0]] = files[copy_names[1]] = block_of(Choice{44, Slot::a, 44, {whole, confirmed}});
  CHECK_EQUAL(switch_on(script(), files).why, "trial");
}

/// As where its root has a bad sector, or its application ends at once.
void a_confirmed_version_that_never_comes_up_gives_way() {
  const Choice choice{42, Slot::a, 41, {confirmed, confirmed}};
  Files files = files_of(choice, {40, 3, Slot::b, {}});
  const auto boots = [&](Slot slot, const char* why) {
    const Running running = switch_on(script(), files);
    CHECK(running.slot == slot);
    CHECK_EQUAL(running.why, why);
    return running;
  };
  for (int start = 0; start < 3; ++start) boots(Slot::a, "confirmed");
  Running running = boots(Slot::b, "fallback");
  boots(Slot::b, "fallback");
  // Slot B is found healthy and becomes the primary, with three attempts of its own.
  LostPowerDisk disk(files);
  CHECK(perform({"confirm", "B"}, disk, running).exit == Exit::done);
  disk.settle();
  for (const char* name : {copy_names[0], copy_names[1], attempts_name}) files[name] = *disk.read(name);
  for (int start = 0; start < 3; ++start) running = boots(Slot::b, "confirmed");
  // The third came up: none counts.
  LostPowerDisk later(files);
  CHECK(perform({"came-up", "B"}, later, running).exit == Exit::done);
  later.settle();
  files[attempts_name] = *later.read(attempts_name);
  for (int start = 0; start < 3; ++start) boots(Slot::b, "confirmed");
  boots(Slot::a, "fallback");
  // With nothing else on the disk nothing is counted.
  files = files_of({42, Slot::a, 41, {confirmed, none}}, {41, 3, Slot::b, {}});
  for (int start = 0; start < 5; ++start) boots(Slot::a, "confirmed");
}

void with_nothing_to_trust_the_slots_take_turns() {
  const Choice no_slot{42, Slot::a, 41, {none, none}};
  for (const bool is_readable : {false, true}) {
    Files files = files_of(no_slot, {});
    if (!is_readable) files[copy_names[0]] = files[copy_names[1]] = "";
    for (const Slot slot : {Slot::a, Slot::b, Slot::a, Slot::b}) {
      const Running running = switch_on(script(), files);
      CHECK(running.slot == slot);
      CHECK_EQUAL(running.why, "unknown");
    }
    // Without the file in which it counts, and with only one slot on the disk.
    files[attempts_name] = "";
    for (int boot = 0; boot < 2; ++boot) CHECK(switch_on(script(), files).slot == Slot::a);
    GrubMachine machine = machine_with(files);
    take_away(machine, Slot::a, "vmlinuz");
    expect_start(machine, "B", "fallback");
    take_away(machine, Slot::b, "vmlinuz");
    CHECK(machine.start(script()).has_restarted);
  }
}

void a_slot_is_started_with_what_it_wants() {
  GrubMachine machine = machine_with(files_of({42, Slot::b, 41, {none, confirmed}}, {}));
  const Started started = machine.start(script());
  CHECK_EQUAL(started.kernel, "(hd0,gpt4)/vmlinuz");
  CHECK_EQUAL(started.initrd, "(hd0,gpt4)/initrd.img");
  CHECK_EQUAL(
      started.command_line(),
      "root=PARTUUID=identifier-of-root-b ro rauc.slot=B flexrf.boot=confirmed flexrf.trial=0000000041 "
      "isolcpus=1 quiet ");
  for (const char* file : {"vmlinuz", "initrd.img", "slot.env"}) {
    GrubMachine lame = machine_with(files_of({42, Slot::b, 41, {confirmed, confirmed}}, {}));
    take_away(lame, Slot::b, file);
    expect_start(lame, "A", "fallback");
  }
  GrubMachine nameless = machine_with(files_of({42, Slot::b, 41, {confirmed, confirmed}}, {}));
  nameless.partitions.erase("(hd0,gpt6)");
  expect_start(nameless, "A", "fallback");
}

// A kernel that is loaded and cannot be started leaves a restart as the only way on; then the other slot has
// its turn, once.
void a_slot_that_fails_halfway_gives_way() {
  for (const char* file : {"initrd.img", "vmlinuz"}) {
    const bool is_halfway = std::string(file) == "initrd.img";
    GrubMachine machine = machine_with(files_of({42, Slot::b, 41, {confirmed, confirmed}}, {}));
    machine.unreadable.insert(std::string("(hd0,gpt4)/") + file);
    for (int round = 0; round < 2; ++round) {
      if (is_halfway) {
        CHECK(machine.start(script()).has_restarted);
        const Result<Attempts> attempts = attempts_in(machine.files[path_on_esp(attempts_name)]);
        CHECK(attempts);
        CHECK(attempts->failed == Slot::b);
      }
      expect_start(machine, "A", "fallback");
    }
    // Of a disk that can be read again nothing is left.
    machine.unreadable.clear();
    expect_start(machine, "B", "confirmed");
  }
  // With no other slot it is tried again and again, and so it is where nothing can be noted.
  GrubMachine lone = machine_with(files_of({42, Slot::b, 41, {none, confirmed}}, {}));
  lone.unreadable.insert("(hd0,gpt4)/initrd.img");
  for (int round = 0; round < 3; ++round) CHECK(lone.start(script()).has_restarted);
  lone.unreadable.clear();
  expect_start(lone, "B", "confirmed");
  GrubMachine read_only = machine_with(files_of({42, Slot::b, 41, {confirmed, confirmed}}, {}));
  read_only.can_write = false;
  read_only.unreadable.insert("(hd0,gpt4)/initrd.img");
  for (int round = 0; round < 2; ++round) CHECK(read_only.start(script()).has_restarted);
}

// The slots are those of GRUB's own disk: a second disk of the same kind does not matter.
void the_slots_are_on_grubs_own_disk() {
  GrubMachine machine;
  for (const auto& [path, bytes] : machine_with(files_of({42, Slot::a, 41, {confirmed, none}}, {})).files)
    machine.files["(hd1" + path.substr(4)] = bytes;
  machine.partitions = {{"(hd0,gpt5)", "of-the-other-disk"}, {"(hd1,gpt5)", "of-this-disk"}};
  machine.firmware = {{"prefix", "(hd1,gpt2)/grub"}, {"root", "hd1,gpt2"}};
  const Started started = machine.start(script());
  CHECK_EQUAL(started.kernel, "(hd1,gpt3)/vmlinuz");
  CHECK_EQUAL(started.option("root"), "PARTUUID=of-this-disk");
}

// start() refuses a script in which the default asks for a password, or another entry does not.
void all_but_the_default_needs_the_password() {
  for (const char* password :
       {"", "password_pbkdf2 service grub.pbkdf2.sha512.10000.AB.CD\n", "no such command\n"}) {
    GrubMachine machine = machine_with(files_of({42, Slot::a, 41, {confirmed, none}}, {}));
    if (*password != '\0') machine.files["(hd0,gpt2)/grub/password.cfg"] = password;
    if (std::string(password).rfind("no", 0) == 0) {
      // GRUB tells of such a line and goes on; here it is an error, after the name was set without which all
      // may do all.
      bool is_told = false;
      try {
        machine.start(script());
      } catch (const ScriptError&) {
        is_told = true;
      }
      CHECK(is_told);
    } else {
      expect_start(machine, "A", "confirmed");
      CHECK_EQUAL(machine.start_entry(script(), 1).option("flexrf.boot"), "manual");
      CHECK_EQUAL(machine.start_entry(script(), 2).option("rauc.slot"), "B");
    }
    CHECK_EQUAL(machine.variables["superusers"], "service");
  }
}

void damage(std::string& bytes, std::mt19937& random) {
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random()) % limit; };
  switch (below(4)) {
    case 0:
      for (std::size_t left = 1 + below(4); left > 0; --left)
        bytes[below(bytes.size())] = static_cast<char>(random());
      break;
    case 1: {
      const std::size_t begin = below(bytes.size());
      for (std::size_t i = begin; i < bytes.size() && i < begin + below(600); ++i)
        bytes[i] = static_cast<char>(random());
      break;
    }
    case 2:
      bytes.resize(below(bytes.size()));
      break;
    default:
      std::rotate(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())),
                  bytes.end());
  }
}

// With one copy and the attempts damaged anyhow, what boots is whole; it is the slot that is meant as long as
// GRUB can count.
void damaged_bytes_lead_to_a_whole_slot() {
  std::mt19937 random(1414);
  const Choice choices[] = {{42, Slot::b, 41, {confirmed, whole}},
                            {42, Slot::b, 41, {confirmed, none}},
                            {42, Slot::a, 41, {none, confirmed}},
                            {42, Slot::a, 41, {whole, none}},
                            {42, Slot::a, 41, {confirmed, confirmed}}};
  for (int round = 0; round < 3000; ++round) {
    const Choice& choice = choices[static_cast<std::size_t>(round) % std::size(choices)];
    Files files = files_of(choice, {});
    damage(files[copy_names[random() % 2]], random);
    const bool counts = random() % 2 == 0;
    if (!counts) damage(files[attempts_name], random);
    const Running running = switch_on(script(), files);
    CHECK(running.slot.has_value());
    CHECK(choice.of(*running.slot).is_whole);
    if (counts) CHECK(*running.slot == *expected_of(choice, Counting::no_attempt).first);
  }
}

// With all of it damaged anyhow, GRUB still starts a slot that is there.
void with_all_damaged_something_boots() {
  std::mt19937 random(41);
  for (int round = 0; round < 2000; ++round) {
    Files files = files_of({42, Slot::a, 41, {confirmed, none}}, {});
    for (auto& [name, bytes] : files) damage(bytes, random);
    CHECK(switch_on(script(), files).slot.has_value());
  }
}

void the_interpreter_refuses_what_it_does_not_know() {
  for (const char* source :
       {"fly\n", "if [ a = b ]; then\necho x\n", "[ a -lt b ]\n", "set a=1 b=2\n", "echo a | b\n", "x && y\n",
        "load_env a\n", "for x in a; do echo; done\n", "fi\n",
        "menuentry x --class y { echo }\nset superusers=a\nset timeout=0\nset default=0\n"}) {
    GrubMachine machine;
    bool is_refused = false;
    try {
      machine.start(parse_script(source));
    } catch (const ScriptError&) {
      is_refused = true;
    }
    if (!is_refused) throw fixture::CheckFailed{std::string("taken: ") + source};
  }
}

}  // namespace
}  // namespace flexrf::boot::grub_cfg_test

int main() {
  using namespace flexrf::boot::grub_cfg_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(every_state_has_its_decision),
      CONTAINED_TEST(the_newer_copy_counts),
      CONTAINED_TEST(a_trial_has_three_attempts),
      CONTAINED_TEST(a_confirmed_version_that_never_comes_up_gives_way),
      CONTAINED_TEST(with_nothing_to_trust_the_slots_take_turns),
      CONTAINED_TEST(a_slot_is_started_with_what_it_wants),
      CONTAINED_TEST(a_slot_that_fails_halfway_gives_way),
      CONTAINED_TEST(the_slots_are_on_grubs_own_disk),
      CONTAINED_TEST(all_but_the_default_needs_the_password),
      CONTAINED_TEST(damaged_bytes_lead_to_a_whole_slot),
      CONTAINED_TEST(with_all_damaged_something_boots),
      CONTAINED_TEST(the_interpreter_refuses_what_it_does_not_know),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
