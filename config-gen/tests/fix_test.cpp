// --fix: what it changes, what it leaves alone, and that it makes none of the catalogue's broken tables
// worse.
#include "config-gen/fix/fix.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "config-gen/fix/replace_file.hpp"
#include "config-gen/fix/word_place.hpp"
#include "config-gen/model/file_contents.hpp"
#include "config-gen/tests/catalogue_case.hpp"
#include "config-gen/tests/lines.hpp"
#include "config-gen/tests/tables.hpp"
#include "config-gen/tests/temporary_folder.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

fs::path catalogue() {
  return fs::path(place::tests_folder) / "catalogue";
}

struct Fixed {
  bool good = false;
  std::string told;
};

// A cell in a folder of its own, with the tables of base/ beside it.
class Cell {
 public:
  explicit Cell(const Files& files) {
    fs::copy(fs::path(place::tests_folder) / "base", folder_.path() / "base", fs::copy_options::recursive);
    fs::current_path(folder_.path());
    write_cell(files, "cell");
  }
  ~Cell() { fs::current_path("/"); }
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  static Examined judge() {
    Model model;
    Examined examined{judge_cell("cell", Stage::emit, model), {}};
    examined.files = model.files;
    return examined;
  }

  static Fixed fix(bool dry_run = false, const std::vector<fs::path>& more = {}) {
    FixSettings settings{more, dry_run};
    settings.folders.emplace_back("cell");
    std::ostringstream out;
    Fixed fixed;
    fixed.good = config_gen::fix(settings, judge, out);
    fixed.told = out.str();
    return fixed;
  }

  static std::string text(const fs::path& file) { return contents_of("cell" / file); }

 private:
  TemporaryFolder folder_;
};

Files base(const std::string& name) {
  return files_in(catalogue() / "base" / name);
}

// Of all places where this stands.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  assert_non_null(strstr(text.c_str(), from.c_str()));
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

Files with(Files files, const std::string& file, const std::string& from, const std::string& to) {
  files[file] = replaced(files[file], from, to);
  return files;
}

bool says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return true;
  print_error("'%s' is not in:\n%s", part.c_str(), text.c_str());
  return false;
}

bool is(const std::string& actual, const std::string& expected) {
  if (actual != expected) print_error("'%s' instead of '%s'\n", actual.c_str(), expected.c_str());
  return actual == expected;
}

// Keys, a header, a quoted key, texts, several in a line; each shows what the one before hid. Comments,
// quotes, blanks, ends of lines and the mark at the beginning stay, and so do the same words where they are
// something else.
void all_else_stays_byte_for_byte(void**) {
  const std::string good =
      "\xEF\xBB\xBF# tpye = \"rely\": a comm\xC3\xA4nt\r\n"
      "summary = \"The tpye is rely.\"\r\n"
      "memory_budget = \"8 MiB\"\r\n\r\n"
      "[unit.relay]   # unti\r\n"
      "  type='relay'\r\n"
      "out.copy = \"pose\"\r\n"
      "\"budget\"\t= \"20 us\"\r\n\r\n"
      "[slot.pose]\r\nobserve = true\r\n\r\n"
      "[thread.main]\r\n"
      "trigger = { period = \"10 ms\", phase = \"1 ms\" } # \xE2\x82\xAC\r\n"
      "units = [ \"relay\" ]";
  std::string broken = replaced(good, "summary", "sumary");
  broken = replaced(broken, "[unit.relay]   #", "[unti.relay]   #");
  broken = replaced(broken, "  type='relay'", "  tpye='rely'");
  broken = replaced(broken, "out.copy", "out.cpoy");
  broken = replaced(broken, "\"budget\"", "\"budegt\"");
  broken = replaced(broken, "period = \"10 ms\", phase", "peroid = \"10 ms\", pahse");
  broken = replaced(broken, "[ \"relay\" ]", "[ \"realy\" ]");
  const Cell cell({{"cell.toml", broken}});

  const Fixed shown = Cell::fix(true);
  assert_true(is(Cell::text("cell.toml"), broken));
  assert_false(shown.good);
  const std::string changes =
      "cell/cell.toml:2:1: 'sumary' -> 'summary'\n"
      "cell/cell.toml:5:2: 'unti' -> 'unit'\n"
      "cell/cell.toml:6:3: 'tpye' -> 'type'\n"
      "cell/cell.toml:6:8: 'rely' -> 'relay'\n"
      "cell/cell.toml:7:5: 'cpoy' -> 'copy'\n"
      "cell/cell.toml:8:1: 'budegt' -> 'budget'\n"
      "cell/cell.toml:14:13: 'peroid' -> 'period'\n"
      "cell/cell.toml:14:31: 'pahse' -> 'phase'\n"
      "cell/cell.toml:15:11: 'realy' -> 'relay'\n";
  assert_true(is(shown.told, changes + "config-gen: nothing is written: this was a dry run\n"));

  const Fixed fixed = Cell::fix();
  assert_true(is(fixed.told, changes));
  assert_true(fixed.good);
  assert_true(is(Cell::text("cell.toml"), good));

  const Fixed again = Cell::fix();
  assert_true(again.good);
  assert_true(is(again.told, ""));
  assert_true(is(Cell::text("cell.toml"), good));
}

// With ';', quotes and carriage returns, as a spreadsheet writes it.
void cells_of_lists_are_corrected(void**) {
  const std::string good =
      "\xEF\xBB\xBF"
      "name;address;type;area;access;poll_group\r\n"
      "# adress, raed\r\n"
      "\"press\xC3\xBCre\";1;u16;;read;fast\r\n"
      "level;65;f32;\"holding_register\" ;read;normal\r\n";
  std::string broken = replaced(good, "name;address", "name;adress");
  broken = replaced(broken, ";;read;fast", ";;raed;fats");
  broken = replaced(broken, "\"holding_register\" ", "\"holdng_register\" ");
  Files files = with(base("station"), "cell.toml", "\"registers.csv\"", "\"list.csv\"");
  files["list.csv"] = replaced(broken, "press\xC3\xBCre", "pressure");
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_true(is(fixed.told,
                 "cell/list.csv:1:6: 'adress' -> 'address'\n"
                 "cell/list.csv:3:19: 'raed' -> 'read'\n"
                 "cell/list.csv:3:24: 'fats' -> 'fast'\n"
                 "cell/list.csv:4:14: 'holdng_register' -> 'holding_register'\n"));
  assert_true(fixed.good);
  assert_true(is(Cell::text("list.csv"), replaced(good, "press\xC3\xBCre", "pressure")));
}

// Keys of the table and of the list's columns, and values of cells.
void lists_of_devices_are_corrected(void**) {
  const Files good = with(base("lines"), "io_list.csv", base("lines")["io_list.csv"],
                          "name;line;configuration.direction;drivers\n"
                          "stop_button;ESTOP;input;simulated\n"
                          "green_lamp;LAMP;\"output\";simulated | simulated_too\n");
  Files files = with(good, "cell.toml", "file = ", "fiel = ");
  files = with(files, "cell.toml", "configuration.debounce", "configuration.debuonce");
  files["io_list.csv"] =
      "nmae;lien;configuration.dirction;drivres\n"
      "stop_button;ESTOP;inptu;simulatde\n"
      "green_lamp;LAMP;\"ouptut\";simulatde | simulated_too\n";
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_true(says(fixed.told,
                   "cell/cell.toml:9:1: 'fiel' -> 'file'\n"
                   "cell/cell.toml:13:15: 'debuonce' -> 'debounce'\n"
                   "cell/io_list.csv:1:1: 'nmae' -> 'name'\n"
                   "cell/io_list.csv:1:6: 'lien' -> 'line'\n"
                   "cell/io_list.csv:1:11: 'dirction' -> 'direction'\n"
                   "cell/io_list.csv:1:34: 'drivres' -> 'drivers'\n"
                   "cell/io_list.csv:2:19: 'inptu' -> 'input'\n"
                   "cell/io_list.csv:2:25: 'simulatde' -> 'simulated'\n"
                   "cell/io_list.csv:3:17: 'ouptut' -> 'output'\n"
                   "cell/io_list.csv:3:26: 'simulatde' -> 'simulated'\n"
                   "cell/io_list.csv:3:26: error: unknown driver 'simulated_too' of DigitalLine\n"));
  assert_false(fixed.good);
  assert_true(is(Cell::text("cell.toml"), good.at("cell.toml")));
  assert_true(is(Cell::text("io_list.csv"), good.at("io_list.csv")));
}

// What a person has to decide, each with the reason.
void what_is_in_doubt_is_left_alone(void**) {
  Files files = with(base("jog"), "cell.toml", "in.actual = \"pose\"", "in.actual = \"psoe\"");
  const std::string before = files["cell.toml"];
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(says(fixed.told, "cell/cell.toml:13:13: error: nobody writes slot 'psoe'"));
  assert_true(
      says(fixed.told,
           "cell/cell.toml:13:13: left alone: 'psoe' -> 'pose': the output that writes 'psoe' may be what is "
           "missing\n"));
  assert_true(is(Cell::text("cell.toml"), before));
}

// Several right references against one wrong definition: a person decides.
void a_row_that_nobody_refers_to_outvotes_no_references(void**) {
  Files files = with(base("buses"), "cell.toml", "[device.can0]", "[device.cann0]");
  const std::string before = files["cell.toml"];
  {
    const Cell cell(files);
    const Fixed fixed = Cell::fix();
    assert_false(fixed.good);
    assert_true(says(
        fixed.told,
        "left alone: 'can0' -> 'cann0': it stands so in 2 places, and 'cann0' in 0 beside its declaration at "
        "cell/cell.toml:4:9, which may be what is misspelt\n"));
    assert_true(is(Cell::text("cell.toml"), before));
  }
  // One wrong reference beside a right one is a slip.
  const Cell cell(with(base("buses"), "cell.toml",
                       "drivers = [\"simulated\", \"can\"]\non = \"can0\"\n\n[device.right]",
                       "drivers = [\"simulated\", \"can\"]\non = \"cann0\"\n\n[device.right]"));
  const Fixed fixed = Cell::fix();
  assert_true(fixed.good);
}

// Whatever the references look like: names, beginnings of names, of several kinds, found in several rounds.
void a_misspelt_declaration_outvotes_no_references_of_any_kind(void**) {
  Files files = with(base("jog"), "cell.toml", "[unit.jog]", "[unit.jjog]");
  files["cell.toml"] +=
      "\n[widget.step]\nkind = \"slider\"\nplace = \"jog\"\nparameters = { value = \"jog.step\" }\n"
      "\n[widget.home]\nkind = \"button\"\nplace = \"jog\"\nparameters = { value = \"jog.home\" }\n";
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  const std::string why =
      "it stands so in 6 places, and 'jjog' in 0 beside its declaration at cell/cell.toml:10:7, which may be "
      "what is misspelt\n";
  for (const char* change :
       {"'jog' -> 'jjog': ", "'jog.step' -> 'jjog.step': ", "'jog.home' -> 'jjog.home': "})
    assert_true(says(fixed.told, std::string("left alone: ") + change + why));
  assert_true(is(Cell::text("cell.toml"), files["cell.toml"]));
}

// The declaration stands in another file than the references: it is a device of a list.
void a_misspelt_name_in_a_list_outvotes_no_references(void**) {
  Files files = with(base("lines"), "io_list.csv", "green_lamp;", "gren_lamp;");
  files["cell.toml"] +=
      "\n[widget.lamp]\nkind = \"timeline\"\nplace = \"green_lamp\"\n"
      "options = { rows = \"tower\", frame = \"tower\" }\n";
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(says(fixed.told,
                   "left alone: 'green_lamp' -> 'gren_lamp': it stands so in 2 places, and 'gren_lamp' in 0 "
                   "beside its declaration at cell/io_list.csv:3:1, which may be what is misspelt\n"));
  assert_true(is(Cell::text("cell.toml"), files["cell.toml"]));
}

// The column that is missing is rightly named; the one that is there is what is corrected.
void only_the_word_that_is_wrong_is_replaced(void**) {
  Files files = with(base("station"), "registers.csv", "name,address", "nmae,address");
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_true(is(fixed.told, "cell/registers.csv:1:1: 'nmae' -> 'name'\n"));
  assert_true(fixed.good);
}

void a_key_that_is_there_already_is_left_alone(void**) {
  Files files = with(base("relay"), "cell.toml", "type = \"relay\"", "type = \"relay\"\ntpye = \"jog\"");
  const std::string before = files["cell.toml"];
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(says(fixed.told, "cell/cell.toml:6:1: left alone: 'tpye' -> 'type': then 'type'"));
  assert_true(is(Cell::text("cell.toml"), before));
}

void a_change_that_leads_to_another_error_is_taken_back(void**) {
  Files files = with(base("relay"), "cell.toml", "[\"relay\"]", "[\"relay\", \"realy\"]");
  const std::string before = files["cell.toml"];
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(says(fixed.told, "cell/cell.toml:13:19: error: unknown unit 'realy'"));
  assert_true(says(fixed.told, "cell/cell.toml:13:19: left alone: 'realy' -> 'relay': then "));
  assert_true(is(Cell::text("cell.toml"), before));
}

// In the group's table the word is an argument; what the argument is, is not looked for.
void what_stands_elsewhere_is_left_alone(void**) {
  Files files = with(base("axes"), "groups/axis.toml", "type = \"drive\"\n", "type = \"${kind}\"\n");
  files = with(files, "groups/axis.toml", "[port.setpoint]",
               "[argument.kind]\ntype = \"text\"\nsummary = \"What it is.\"\n\n[port.setpoint]");
  files = with(files, "cell.toml", "with = { ", "with = { kind = \"drvie\", ");
  const std::string before = files["groups/axis.toml"];
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(says(fixed.told, "left alone: 'drvie' -> 'drive': the word does not stand there as it is\n"));
  assert_true(is(Cell::text("groups/axis.toml"), before));
}

// Said of three instances, corrected once; and a word within a text.
void groups_and_words_within_texts(void**) {
  Files files = with(base("axes"), "groups/axis.toml", "\"${budget}\"", "\"${budgt}\"");
  files = with(files, "groups/axis.toml", "\"drive.setpoint\"", "'dirve.setpoint'");
  files = with(files, "cell.toml", "out.position =", "out.positon =");
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_true(is(fixed.told,
                 "cell/cell.toml:13:5: 'positon' -> 'position'\n"
                 "cell/groups/axis.toml:13:6: 'dirve' -> 'drive'\n"
                 "cell/groups/axis.toml:27:10: 'budgt' -> 'budget'\n"));
  assert_true(fixed.good);
  assert_true(is(Cell::text("groups/axis.toml"),
                 replaced(base("axes")["groups/axis.toml"], "\"drive.setpoint\"", "'drive.setpoint'")));
}

void files_elsewhere_are_left_alone_unless_named(void**) {
  const Cell cell(base("relay"));
  const std::string good = contents_of("base/units/relay/relay.toml");
  std::ofstream("base/units/relay/relay.toml") << replaced(good, "optional", "optoinal");
  const Fixed refused = Cell::fix();
  assert_false(refused.good);
  assert_true(
      says(refused.told,
           "base/units/relay/relay.toml:5:1: left alone: 'optoinal' -> 'optional': the file lies outside of "
           "the folders that may be changed\n"));
  const Fixed fixed = Cell::fix(false, {"base"});
  assert_true(fixed.good);
  assert_true(is(fixed.told, "base/units/relay/relay.toml:5:1: 'optoinal' -> 'optional'\n"));
  assert_true(is(contents_of("base/units/relay/relay.toml"), good));
}

void what_is_downloaded_is_left_alone(void**) {
  Files files = with(base("robot"), "six-axis.urdf", "type=\"revolute\"", "type=\"revolut\"");
  const std::string before = files["six-axis.urdf"];
  const Cell cell(files);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(
      says(fixed.told,
           ": left alone: 'revolut' -> 'revolute': only tables (.toml) and lists (.csv) are changed\n"));
  assert_true(is(Cell::text("six-axis.urdf"), before));
}

mode_t mode_of(const fs::path& file) {
  struct stat status {};
  assert_int_equal(lstat(file.c_str(), &status), 0);
  return status.st_mode & 07777;
}

void a_link_is_followed_and_the_mode_kept(void**) {
  Files files = base("relay");
  const std::string good = files["cell.toml"];
  const Cell cell(files);
  fs::create_directories("elsewhere");
  std::ofstream("elsewhere/real.toml") << replaced(good, "observe", "obserev");
  assert_int_equal(chmod("elsewhere/real.toml", 0640), 0);
  fs::remove("cell/cell.toml");
  fs::create_symlink("../elsewhere/real.toml", "cell/cell.toml");
  const Fixed fixed = Cell::fix();
  assert_true(fixed.good);
  assert_true(fs::is_symlink("cell/cell.toml"));
  assert_true(is(contents_of("elsewhere/real.toml"), good));
  assert_int_equal(mode_of("elsewhere/real.toml"), 0640);
  // Nothing is left beside it.
  assert_int_equal(std::distance(fs::directory_iterator("elsewhere"), fs::directory_iterator()), 1);
}

// The other file is corrected all the same.
void a_file_that_is_read_only_is_told(void**) {
  Files files = with(base("axes"), "groups/axis.toml", "\"${budget}\"", "\"${budgt}\"");
  files = with(files, "cell.toml", "out.position =", "out.positon =");
  const Cell cell(files);
  assert_int_equal(chmod("cell/groups/axis.toml", 0444), 0);
  const Fixed fixed = Cell::fix();
  assert_false(fixed.good);
  assert_true(says(fixed.told, "cell/cell.toml:13:5: 'positon' -> 'position'\n"));
  assert_true(
      says(fixed.told, "cell/groups/axis.toml:27:10: left alone: 'budgt' -> 'budget': it is read-only\n"));
  assert_true(is(Cell::text("groups/axis.toml"), files["groups/axis.toml"]));
  assert_true(is(Cell::text("cell.toml"), base("axes")["cell.toml"]));
}

void a_file_that_was_changed_meanwhile_stays(void**) {
  const Cell cell(base("relay"));
  assert_true(is(replace_file("cell/cell.toml", "what was read", "what is to be"),
                 "somebody has changed it meanwhile"));
  assert_true(is(Cell::text("cell.toml"), base("relay")["cell.toml"]));
  assert_int_equal(std::distance(fs::directory_iterator("cell"), fs::directory_iterator()), 1);
  assert_true(is(replace_file("cell/cell.toml", base("relay")["cell.toml"], "x = 1\n"), ""));
  assert_true(is(Cell::text("cell.toml"), "x = 1\n"));
  assert_true(says(obstacle_to_replacing("cell/none.toml"), "it cannot be found: "));
  assert_true(is(obstacle_to_replacing("cell"), "it is no file"));
}

// ---- Where a word is

std::string word_at(const std::string& text, std::uint32_t line, std::uint32_t column,
                    const Replacement& replacement, SourceKind kind) {
  const auto place = find_word(text, {"f", line, column}, replacement, kind);
  return place ? std::to_string(place->token) + " " + std::to_string(place->begin) : "none";
}

void words_are_found_in_tokens(void**) {
  const Replacement mode{"moed", "mode", ""};
  const auto table = [&](const std::string& text, std::uint32_t column) {
    return word_at(text, 1, column, mode, SourceKind::table);
  };
  assert_true(is(table("moed = 1", 1), "0 0"));
  assert_true(is(table("a.moed = 1", 3), "2 2"));
  assert_true(is(table("\xC3\xA4 moed", 3), "3 3"));
  assert_true(is(table("'moed' = 1", 1), "0 1"));
  assert_true(is(table("a = \"not moed\"", 5), "4 9"));
  assert_true(is(table("a = \"moed or moed\"", 5), "none"));
  assert_true(is(table("a = \"moed_x\"", 5), "none"));
  assert_true(is(table("moed_x = 1", 1), "none"));
  assert_true(is(table("a = \"\\u006Doed moed\"", 5), "none"));
  assert_true(is(table("a = \"\"\"moed\"\"\"", 5), "none"));
  assert_true(is(table("a = 1", 9), "none"));
  const auto list = [&](const std::string& text, std::uint32_t line, std::uint32_t column) {
    return word_at(text, line, column, mode, SourceKind::list);
  };
  assert_true(is(list("a,moed\r\n", 1, 3), "2 2"));
  assert_true(is(list("a\rmoed ;b", 2, 1), "2 2"));
  assert_true(is(list("\"moed\",b", 1, 1), "0 1"));
  assert_true(is(list("\"say \"\"moed\"\"\",b", 1, 1), "none"));
  assert_true(is(list("not moed,moed", 1, 1), "0 4"));
  assert_true(is(word_at("moed", 1, 1, {"moed", "a b", ""}, SourceKind::list), "none"));
  assert_true(is(word_at("moed", 1, 1, {"moed", "a.b", ""}, SourceKind::table), "none"));
}

// ---- The catalogue of broken tables

// An error without its names and numbers.
std::set<std::string> kinds_of(const Diagnostics& diagnostics) {
  std::set<std::string> kinds;
  for (const Diagnostic& one : diagnostics.sorted()) {
    if (one.severity != Severity::error) continue;
    std::string kind;
    bool quoted = false;
    for (const char c : one.text.substr(0, one.text.find(" (and "))) {
      if (c == '\'') quoted = !quoted;
      if (!quoted && (c < '0' || c > '9')) kind += c;
    }
    kinds.insert(kind);
  }
  return kinds;
}

std::size_t errors_of(const Diagnostics& diagnostics) {
  const auto all = diagnostics.sorted();
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(), [](const Diagnostic& one) { return one.severity == Severity::error; }));
}

// What a word that is corrected lets be seen: a row that was broken is judged with the others, and a key that
// was not known counts.
const std::map<std::string, std::set<std::string>>& uncovered() {
  static const std::map<std::string, std::set<std::string>> kinds = {
      {"many-at-once.case", {"unit ' is in no thread"}},
      {"unknown-interface.case", {"[device.arm] has no '", "device ' has no owner"}},
      {"unknown-key-of-thread.case", {"unit ' in real-time thread ' has no '"}}};
  return kinds;
}

struct Counts {
  std::size_t changed = 0;
  std::size_t mended = 0;
};

// Nothing was suggested, so there is nothing to do.
bool leaves_alone(const fs::path& file, const Files& files) {
  const Fixed fixed = Cell::fix();
  if (files_in("cell") == files) return true;
  std::cerr << file.filename().string() << ": it changed something that nobody suggested\n" << fixed.told;
  return false;
}

bool is_no_worse(const fs::path& file, Counts& counts) {
  const auto [files, messages] = read_case(file);
  const Cell cell(files);
  if (messages.find("did you mean") == std::string::npos) return leaves_alone(file, files);
  const Diagnostics before = Cell::judge().diagnostics;
  const Fixed first = Cell::fix();
  const Diagnostics after = Cell::judge().diagnostics;
  const Files fixed = files_in("cell");
  std::string wrong;
  const auto known = uncovered().find(file.filename().string());
  const std::set<std::string> expected = known != uncovered().end() ? known->second : std::set<std::string>{};
  if (expected.empty() && errors_of(after) > errors_of(before)) wrong = "there are more errors";
  if (expected.empty() && fixed != files && errors_of(after) == errors_of(before))
    wrong = "it changed something, and mended nothing";
  const auto kinds_before = kinds_of(before);
  const auto kinds_after = kinds_of(after);
  for (const std::string& kind : kinds_after)
    if (!kinds_before.contains(kind) && !expected.contains(kind)) wrong = "a new kind of error: " + kind;
  for (const std::string& kind : expected)
    if (!kinds_after.contains(kind)) wrong = "no longer uncovered: " + kind;
  if (first.good == after.failed()) wrong = "what it returns is not so";
  for (const auto& [name, text] : files)
    if (!name.ends_with(".toml") && !name.ends_with(".csv") && fixed.at(name) != text)
      wrong = "it changed " + name;
  Cell::fix();
  if (files_in("cell") != fixed) wrong = "a second run changes something";
  counts.changed += fixed != files ? 1 : 0;
  counts.mended += before.failed() && !after.failed() ? 1 : 0;
  if (wrong.empty()) return true;
  std::cerr << file.filename().string() << ": " << wrong << '\n' << first.told;
  return false;
}

void no_broken_table_becomes_worse(void**) {
  Counts counts;
  std::size_t wrong = 0;
  for (const fs::path& file : case_files(catalogue()))
    if (!is_no_worse(file, counts)) ++wrong;
  assert_int_equal(wrong, 0);
  print_message("%zu of the broken tables were changed, %zu are good then\n", counts.changed, counts.mended);
  assert_true(counts.changed >= 30);
  assert_true(counts.mended >= 20);
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main() {
  using namespace flexrf::config_gen::tests;
  const CMUnitTest tests[] = {cmocka_unit_test(all_else_stays_byte_for_byte),
                              cmocka_unit_test(cells_of_lists_are_corrected),
                              cmocka_unit_test(lists_of_devices_are_corrected),
                              cmocka_unit_test(what_is_in_doubt_is_left_alone),
                              cmocka_unit_test(a_row_that_nobody_refers_to_outvotes_no_references),
                              cmocka_unit_test(a_misspelt_declaration_outvotes_no_references_of_any_kind),
                              cmocka_unit_test(a_misspelt_name_in_a_list_outvotes_no_references),
                              cmocka_unit_test(only_the_word_that_is_wrong_is_replaced),
                              cmocka_unit_test(a_key_that_is_there_already_is_left_alone),
                              cmocka_unit_test(a_change_that_leads_to_another_error_is_taken_back),
                              cmocka_unit_test(what_stands_elsewhere_is_left_alone),
                              cmocka_unit_test(groups_and_words_within_texts),
                              cmocka_unit_test(files_elsewhere_are_left_alone_unless_named),
                              cmocka_unit_test(what_is_downloaded_is_left_alone),
                              cmocka_unit_test(a_link_is_followed_and_the_mode_kept),
                              cmocka_unit_test(a_file_that_is_read_only_is_told),
                              cmocka_unit_test(a_file_that_was_changed_meanwhile_stays),
                              cmocka_unit_test(words_are_found_in_tokens),
                              cmocka_unit_test(no_broken_table_becomes_worse)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
