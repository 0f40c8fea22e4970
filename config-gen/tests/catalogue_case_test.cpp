// How a case of the catalogue becomes a whole cell, and that nothing in it is taken for what it is not.
#include "config-gen/tests/catalogue_case.hpp"

#include <stdexcept>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/tests/temporary_folder.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

// A catalogue of one case, with the bases `good` and `other`.
class Catalogue {
 public:
  explicit Catalogue(const std::string& text) {
    write_cell({{"cell.toml",
                 "summary = \"Good.\"\n\n[unit.a]\ntype = \"b\"\nin.x = \"y\"\n\n[slot.y]\nhistory = 4\n"},
                {"list.csv", "name,address\n"}},
               folder_.path() / "base/good");
    write_cell({{"a.case", text}}, folder_.path());
  }
  fs::path file() const { return folder_.path() / "a.case"; }

 private:
  TemporaryFolder folder_;
};

Files files_of(const std::string& sections) {
  return read_case(Catalogue("base: good\n" + sections + "--- messages\nno\n").file()).files;
}

std::string cell_of(const std::string& edits) {
  return files_of("--- change cell.toml\n" + edits).at("cell.toml");
}

// Why a case is refused; empty when it is not.
std::string refusal_of(const std::string& text) try {
  read_case(Catalogue(text).file());
  return "";
} catch (const std::runtime_error& error) {
  const std::string message = error.what(), file = "a.case: ";
  return message.substr(message.find(file) + file.size());
}

std::string refusal_of_edits(const std::string& edits) {
  return refusal_of("base: good\n--- change cell.toml\n" + edits + "--- messages\n");
}

void tables_change_by_table_and_key(void**) {
  assert_string_equal(
      cell_of("summary = \"Bad.\"\nextra = 1\n[unit.a]\ntype = \"c\"\n").c_str(),
      "summary = \"Bad.\"\nextra = 1\n\n[unit.a]\ntype = \"c\"\nin.x = \"y\"\n\n[slot.y]\nhistory = 4\n");
  assert_string_equal(
      cell_of("[unit.a]\n- in.x\nin.z = \"y\"\n").c_str(),
      "summary = \"Good.\"\n\n[unit.a]\ntype = \"b\"\nin.z = \"y\"\n\n[slot.y]\nhistory = 4\n");
  assert_string_equal(cell_of("- [unit.a]\n\n[unit.b]\ntype = \"b\"\n\n").c_str(),
                      "summary = \"Good.\"\n\n[slot.y]\nhistory = 4\n\n[unit.b]\ntype = \"b\"\n");
}

void whole_files_are_written_repeated_and_removed(void**) {
  const Files files = files_of(
      "--- write types/t<n>.toml for n = 9..10\nnext = \"t<n+1>\"\n\n--- append list.csv for n = "
      "1..2\nv<n>,<n>\n"
      "--- remove cell.toml\n");
  assert_int_equal(files.size(), 3);
  assert_string_equal(files.at("types/t9.toml").c_str(), "next = \"t10\"\n");
  assert_string_equal(files.at("types/t10.toml").c_str(), "next = \"t11\"\n");
  assert_string_equal(files.at("list.csv").c_str(), "name,address\nv1,1\nv2,2\n");
}

void bytes_that_are_no_text(void**) {
  const Files files =
      files_of("--- write a in UTF-16\nab\n--- write b in UTF-16BE\nab\n--- write c\ngro\\xDF\\x0D\n");
  assert_true(files.at("a") == std::string("\xFF\xFE"
                                           "a\0b\0\n\0",
                                           8));
  assert_true(files.at("b") == std::string("\0a\0b\0\n", 6));
  assert_string_equal(files.at("c").c_str(), "gro\xDF\r\n");
}

std::string rewritten(const std::string& text, const std::string& messages) {
  const Catalogue catalogue(text);
  rewrite_messages(catalogue.file(), messages);
  return contents_of(catalogue.file());
}

void messages_are_what_is_left(void**) {
  const std::string sections = "--- write cell.toml\na = 1\n\n--- messages\n";
  assert_string_equal(read_case(Catalogue(sections + "first\n\nlast\n").file()).messages.c_str(),
                      "first\n\nlast\n");
  assert_string_equal(rewritten(sections + "first\n", "other\n").c_str(), (sections + "other\n").c_str());
}

void nothing_is_silently_ignored(void**) {
  const std::string end = "--- messages\n";
  assert_string_equal(refusal_of("base: nobody\n--- remove list.csv\n" + end).c_str(),
                      "there is no base: nobody");
  assert_string_equal(refusal_of("base: good\n" + end).c_str(), "nothing differs from the base");
  assert_string_equal(refusal_of("base: good\n--- remove list.csv\n").c_str(), "there is no --- messages");
  assert_string_equal(refusal_of("a = 1\n--- write a\nb\n" + end).c_str(),
                      "this line is in no section: a = 1");
  assert_string_equal(refusal_of("base: good\nbase: good\n" + end).c_str(),
                      "this line is in no section: base: good");
  assert_string_equal(refusal_of("--- change cell.toml\na = 1\n" + end).c_str(),
                      "the base has no file cell.toml");
  assert_string_equal(refusal_of("base: good\n--- remove cell.csv\n" + end).c_str(),
                      "the base has no file cell.csv");
  assert_string_equal(refusal_of("base: good\n--- remove list.csv\na\n" + end).c_str(),
                      "what is to be done with list.csv?");
  assert_string_equal(refusal_of("--- write a\n\n" + end).c_str(), "what is to be done with a?");
  assert_string_equal(refusal_of("base: good\n--- write list.csv\nname,address\n" + end).c_str(),
                      "nothing is changed in list.csv");
  assert_string_equal(refusal_of("--- wirte a\nb\n" + end).c_str(), "this is no section: --- wirte a");
  assert_string_equal(refusal_of("--- write a in UTF-17\nb\n" + end).c_str(),
                      "this is no section: --- write a in UTF-17");
  assert_string_equal(refusal_of("base: good\n--- append list.csv in UTF-16\nb\n" + end).c_str(),
                      "only a file that is written has an encoding: --- append list.csv in UTF-16");
  assert_string_equal(refusal_of("--- write a in UTF-16\ngro\xC3\x9F\n" + end).c_str(),
                      "only ASCII is written in UTF-16");
  assert_string_equal(refusal_of("--- write a for n = 3..2\nb\n" + end).c_str(),
                      "there is no such number: --- write a for n = 3..2");
  assert_string_equal(refusal_of("--- write a\n\\xdf\n" + end).c_str(),
                      "\\x is followed by two digits of a byte: \\xdf\n");
}

void an_edit_that_matches_nothing_is_an_error(void**) {
  assert_string_equal(refusal_of_edits("[unit.a]\n- out.x\n").c_str(),
                      "there is no key to leave out in [unit.a]: out.x");
  assert_string_equal(refusal_of_edits("- [unit.b]\n").c_str(), "there is no table to leave out: [unit.b]");
  assert_string_equal(refusal_of_edits("[unit.a]\ntype = \"b\"\n").c_str(),
                      "so it is already in [unit.a]: type = \"b\"");
  assert_string_equal(refusal_of_edits("[unit.a]\n[slot.y]\nhistory = 5\n").c_str(),
                      "nothing is changed in [unit.a]");
  assert_string_equal(refusal_of_edits("[slot.y]\n").c_str(), "nothing is changed in [slot.y]");
  assert_string_equal(refusal_of_edits("- [unit.a]\ntype = \"c\"\n").c_str(),
                      "it is not said in which table: type = \"c\"");
  assert_string_equal(refusal_of_edits("[unit.a]\ntype\n").c_str(),
                      "this is neither [table] nor key = value: type");
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main() {
  using namespace flexrf::config_gen::tests;
  const CMUnitTest tests[] = {cmocka_unit_test(tables_change_by_table_and_key),
                              cmocka_unit_test(whole_files_are_written_repeated_and_removed),
                              cmocka_unit_test(bytes_that_are_no_text),
                              cmocka_unit_test(messages_are_what_is_left),
                              cmocka_unit_test(nothing_is_silently_ignored),
                              cmocka_unit_test(an_edit_that_matches_nothing_is_an_error)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
