#include <cmath>
#include <string>

#include "config-gen/urdf/urdf_chain.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf::config_gen;

// A good two-joint arm in lines, one of which a case replaces.
struct Lines {
  std::string base = "  <link name='base'/><link name='arm'/><link name='tip'/><link name='tool'/>";
  std::string first = "  <joint name='j1' type='revolute'><parent link='base'/><child link='arm'/>";
  std::string first_axis = "    <origin xyz='0 0 1'/><axis xyz='0 0 2'/>";
  std::string first_limit = "    <limit lower='-1' upper='1' velocity='2'/>";
  std::string first_extra = "    <flexrf acceleration='3' jerk='4' home='0.5'/></joint>";
  std::string second = "  <joint name='j2' type='revolute'><parent link='arm'/><child link='tip'/>";
  std::string second_rest =
      "    <limit lower='-2' upper='2' velocity='1'/><flexrf acceleration='1' jerk='1'/></joint>";
  std::string mount = "  <joint name='m' type='fixed'><parent link='tip'/><child link='tool'/>";
  std::string mount_origin = "    <origin xyz='0.5 0 0' rpy='0 0 1.5707963267948966'/></joint>";

  std::string text() const {
    std::string all = "<robot name='two'>\n";
    for (const std::string* line : {&base, &first, &first_axis, &first_limit, &first_extra, &second,
                                    &second_rest, &mount, &mount_origin}) {
      all += *line + "\n";
    }
    return all + "</robot>\n";
  }
};

// True when the text yields exactly this one error.
bool yields(const Lines& lines, const std::string& expected) {
  const UrdfResult result = parse_urdf(lines.text(), "arm.urdf");
  if (!result.chain && result.errors.size() == 1 && result.errors[0].text() == expected) return true;
  print_message("expected: %s\n", expected.c_str());
  for (const UrdfError& error : result.errors) print_message("     got: %s\n", error.text().c_str());
  return false;
}

void test_good_chain(void**) {
  const bool good = [] {
    const UrdfResult result = parse_urdf(Lines().text(), "arm.urdf");
    if (!result.chain || !result.errors.empty()) return false;
    const UrdfChain& chain = *result.chain;
    return chain.name == "two" && chain.joints.size() == 2 && chain.joints[0].axis[2] == 1.0 &&
           chain.joints[0].origin.position[2] == 1.0 && chain.joints[0].home == 0.5 &&
           chain.joints[1].axis[0] == 1.0 && chain.tool.position[0] == 0.5 && chain.tool.rotation[1] == 1.0 &&
           chain.tool.rotation[3] == -1.0 && chain.tool.rotation[0] == 0.0;
  }();
  assert_true(good);
}

void test_fixed_joints_are_merged(void**) {
  const bool good = [] {
    Lines lines;
    lines.first = "  <joint name='j1' type='fixed'><parent link='base'/><child link='arm'/>";
    lines.first_axis = "    <origin xyz='0 0 1' rpy='0 0 1.5707963267948966'/>";
    lines.second_rest = "    <origin xyz='1 0 0'/>" + lines.second_rest;
    const UrdfResult result = parse_urdf(lines.text(), "arm.urdf");
    return result.chain && result.chain->joints.size() == 1 &&
           result.chain->joints[0].origin.position[0] == 0.0 &&
           result.chain->joints[0].origin.position[1] == 1.0 &&
           result.chain->joints[0].origin.position[2] == 1.0;
  }();
  assert_true(good);
}

void test_six_axis_arm_is_read(void**) {
  const bool good = [] {
    const UrdfResult result = read_urdf(place::six_axis_urdf);
    for (const UrdfError& error : result.errors) print_message("%s\n", error.text().c_str());
    return result.chain && result.chain->joints.size() == 6;
  }();
  assert_true(good);
}

void test_errors_cite_their_place(void**) {
  Lines lines;
  lines.first_limit = "";
  assert_true(yields(lines,
                     "arm.urdf:3:3: error: joint 'j1' has no <limit>\n"
                     "  hint: <limit lower upper velocity>, in rad and rad/s"));
  lines = {};
  lines.first_limit = "    <limit lower='1' upper='-1' velocity='2'/>";
  assert_true(yields(lines, "arm.urdf:5:5: error: joint 'j1': lower is not below upper"));
  lines = {};
  lines.first_limit = "    <limit lower='-1' upper='1'/>";
  assert_true(yields(lines, "arm.urdf:5:5: error: joint 'j1': <limit> has no velocity"));
  lines = {};
  lines.first_limit = "    <limit lower='-1' upper='nan' velocity='1'/>";
  assert_true(
      yields(lines, "arm.urdf:5:5: error: joint 'j1': <limit> upper=\"nan\" is not a number up to 1e6"));
  lines = {};
  lines.first_axis = "    <axis xyz='0 0 0'/>";
  assert_true(yields(lines, "arm.urdf:4:5: error: joint 'j1': the axis has no length"));
  lines = {};
  lines.first_axis = "    <axis xyz='0 1'/>";
  assert_true(
      yields(lines, "arm.urdf:4:5: error: joint 'j1': the axis's xyz is not three numbers up to 1e6"));
  lines = {};
  lines.first_axis = "    <origin xyz='a b c'/>";
  assert_true(yields(lines, "arm.urdf:4:5: error: joint 'j1': xyz=\"a b c\" is not three numbers up to 1e6"));
  lines = {};
  // A pose of such numbers would not be finite.
  lines.first_axis = "    <origin xyz='1e308 0 0'/>";
  assert_true(
      yields(lines, "arm.urdf:4:5: error: joint 'j1': xyz=\"1e308 0 0\" is not three numbers up to 1e6"));
  lines = {};
  lines.first_extra = "    </joint>";
  assert_true(yields(
      lines,
      "arm.urdf:3:3: error: joint 'j1' has no <flexrf>\n"
      "  hint: <flexrf acceleration jerk home>, in rad/s^2, rad/s^3 and rad: URDF has no place for them"));
  lines = {};
  lines.first_extra = "    <flexrf acceleration='0' jerk='4'/></joint>";
  assert_true(yields(lines, "arm.urdf:6:5: error: joint 'j1': acceleration must be above 0"));
  lines = {};
  lines.first_extra = "    <flexrf acceleration='1' jerk='4' home='3'/></joint>";
  assert_true(yields(lines, "arm.urdf:6:5: error: joint 'j1': home is outside the limits"));
}

void test_only_a_serial_chain_of_known_joints(void**) {
  Lines lines;
  lines.second = "  <joint name='j2' type='revolut'><parent link='arm'/><child link='tip'/>";
  assert_true(yields(
      lines, "arm.urdf:7:3: error: joint 'j2' has the unknown type 'revolut'\n  hint: revolute or fixed"));
  lines = {};
  lines.second = "  <joint name='j2' type='prismatic'><parent link='arm'/><child link='tip'/>";
  assert_true(yields(
      lines, "arm.urdf:7:3: error: joint 'j2' is prismatic: only revolute and fixed joints are supported"));
  lines = {};
  lines.second = "  <joint name='j2' type='revolute'><parent link='base'/><child link='tip'/>";
  assert_true(yields(lines,
                     "arm.urdf:7:3: error: link 'base' carries more than one joint: 'j1' and 'j2'\n"
                     "  hint: an arm is one serial chain, from the base to the tool"));
  lines = {};
  lines.second = "  <joint name='j2' type='revolute'><parent link='arm'/><child link='tipp'/>";
  assert_true(yields(lines, "arm.urdf:7:56: error: joint 'j2': there is no link 'tipp'"));
  lines = {};
  lines.base += "<link name='odd'/>";
  assert_true(
      yields(lines,
             "arm.urdf:2:77: error: links 'base' and 'odd' are both without a joint that carries them\n"
             "  hint: an arm has one base"));
  lines = {};
  lines.mount = "  <joint name='j1' type='fixed'><parent link='tip'/><child link='tool'/>";
  assert_true(yields(lines, "arm.urdf:9:3: error: joint 'j1' is there twice"));
  lines = {};
  lines.mount = "  <joint name='m' type='fixed'><parent link='tip'/><child link='base'/>";
  lines.base = "  <link name='base'/><link name='arm'/><link name='tip'/>";
  assert_true(yields(lines, "arm.urdf:1:1: error: the joints form a loop: no link is the base"));
}

void test_files_that_are_no_urdf(void**) {
  const bool good = [] {
    const UrdfResult cut = parse_urdf("<robot name='x'>\n  <link", "x.urdf");
    const UrdfResult other = parse_urdf("\n<sdf/>", "x.urdf");
    const UrdfResult absent = read_urdf("/nowhere/x.urdf");
    const UrdfResult empty = parse_urdf("", "x.urdf");
    return cut.errors.size() == 1 && cut.errors[0].line == 2 && other.errors.size() == 1 &&
           other.errors[0].text() == "x.urdf:2:1: error: the outermost element is <sdf>, not <robot>" &&
           absent.errors.size() == 1 &&
           absent.errors[0].text() == "/nowhere/x.urdf: error: the file cannot be read" &&
           empty.errors.size() == 1;
  }();
  assert_true(good);
}

void test_several_errors_at_once_in_order(void**) {
  const bool good = [] {
    Lines lines;
    lines.first_limit = "";
    lines.first_axis = "    <axis xyz='0 0 0'/>";
    lines.mount_origin = "    <origin xyz='1'/></joint>";
    const UrdfResult result = parse_urdf(lines.text(), "arm.urdf");
    return result.errors.size() == 3 && result.errors[0].line == 3 && result.errors[1].line == 4 &&
           result.errors[2].line == 10;
  }();
  assert_true(good);
}

void test_same_chain_same_text(void**) {
  const bool good = [] {
    const UrdfResult result = parse_urdf(Lines().text(), "arm.urdf");
    const std::string once = emit_kinematic_chain(*result.chain);
    return once == emit_kinematic_chain(*parse_urdf(Lines().text(), "other.urdf").chain) &&
           once.find("nan") == std::string::npos && once.find("-0.0,") == std::string::npos;
  }();
  assert_true(good);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_good_chain),
      cmocka_unit_test(test_fixed_joints_are_merged),
      cmocka_unit_test(test_six_axis_arm_is_read),
      cmocka_unit_test(test_errors_cite_their_place),
      cmocka_unit_test(test_only_a_serial_chain_of_known_joints),
      cmocka_unit_test(test_files_that_are_no_urdf),
      cmocka_unit_test(test_several_errors_at_once_in_order),
      cmocka_unit_test(test_same_chain_same_text),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
