#include "config-gen/urdf/urdf_reader.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include "places.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf::config_gen;
using Kind = UrdfJoint::Kind;

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
  std::string more;

  std::string text() const {
    std::string all = "<robot name='two'>\n";
    for (const std::string* line : {&base, &first, &first_axis, &first_limit, &first_extra, &second,
                                    &second_rest, &mount, &mount_origin, &more}) {
      all += *line + "\n";
    }
    return all + "</robot>\n";
  }
};

UrdfRow row_of_cell() {
  UrdfRow row;
  row.name = "[device.arm.urdf]";
  row.position = {intern("cell.toml"), 7, 8};
  return row;
}

struct Read {
  std::optional<UrdfChain> chain;
  std::string messages;
};

std::string printed(const Diagnostics& diagnostics) {
  std::ostringstream text;
  diagnostics.print(text);
  return text.str();
}

Read parsed(const std::string& text, const UrdfRow& row = row_of_cell()) {
  Diagnostics diagnostics;
  Read read;
  read.chain = parse_urdf(text, "arm.urdf", row, diagnostics);
  read.messages = printed(diagnostics);
  return read;
}

bool says(const Read& read, const std::string& expected) {
  if (read.messages == expected) return true;
  print_message("expected: %s\n     got: %s\n", expected.c_str(), read.messages.c_str());
  return false;
}

// True when the text yields exactly these lines, and no chain.
bool yields(const Lines& lines, const std::string& place, const std::string& text, const std::string& hint,
            const UrdfRow& row = row_of_cell()) {
  const Read read = parsed(lines.text(), row);
  return !read.chain && says(read, place + ": error: " + text + "\n" + place + ": hint: " + hint + "\n");
}

void test_good_chain(void**) {
  const bool good = [] {
    const Read read = parsed(Lines().text());
    if (!read.chain || !read.messages.empty()) return false;
    const UrdfChain& chain = *read.chain;
    return chain.name == "two" && chain.joints.size() == 2 && chain.joints[0].axis[2] == 1.0 &&
           chain.joints[0].origin.position[2] == 1.0 && chain.joints[0].home == 0.5 &&
           chain.joints[1].axis[0] == 1.0 && chain.tool.position[0] == 0.5 && chain.tool.rotation[1] == 1.0 &&
           chain.tool.rotation[3] == -1.0 && chain.tool.rotation[0] == 0.0 &&
           chain.links == std::vector<std::string>{"arm", "base", "tip", "tool"};
  }();
  assert_true(good);
}

void test_fixed_joints_are_merged(void**) {
  const bool good = [] {
    Lines lines;
    lines.first = "  <joint name='j1' type='fixed'><parent link='base'/><child link='arm'/>";
    lines.first_axis = "    <origin xyz='0 0 1' rpy='0 0 1.5707963267948966'/>";
    lines.second_rest = "    <origin xyz='1 0 0'/>" + lines.second_rest;
    const Read read = parsed(lines.text());
    return read.chain && read.chain->joints.size() == 1 && read.chain->joints[0].origin.position[0] == 0.0 &&
           read.chain->joints[0].origin.position[1] == 1.0 && read.chain->joints[0].origin.position[2] == 1.0;
  }();
  assert_true(good);
}

void test_six_axis_arm_is_read(void**) {
  const bool good = [] {
    Diagnostics diagnostics;
    const auto chain = read_urdf(place::six_axis_urdf, row_of_cell(), diagnostics);
    return chain && chain->joints.size() == 6 && says({chain, printed(diagnostics)}, "");
  }();
  assert_true(good);
}

const std::string limit_hint =
    "URDF: <limit lower=\"...\" upper=\"...\" velocity=\"...\">, in rad and rad/s; or write joint.j1 = { "
    "lower = "
    "-1.0, upper = 1.0, velocity = 1.0 } in [device.arm.urdf]";

void test_errors_cite_their_place(void**) {
  Lines lines;
  lines.first_limit = "";
  assert_true(yields(lines, "arm.urdf:3:3", "joint 'j1' has no <limit>", limit_hint));
  lines = {};
  lines.first_limit = "    <limit lower='1' upper='-1' velocity='2'/>";
  assert_true(yields(lines, "arm.urdf:5:5", "joint 'j1': lower (1) is not below upper (-1)", limit_hint));
  lines = {};
  lines.first_limit = "    <limit lower='-1' upper='1'/>";
  assert_true(yields(lines, "arm.urdf:5:5", "joint 'j1' has no velocity",
                     "URDF: <limit velocity=\"...\">, in rad/s; or write joint.j1 = { velocity = 1.0 } in "
                     "[device.arm.urdf]"));
  lines.first_limit = "    <limit lower='-1' upper='1' velocity='0'/>";
  assert_true(
      yields(lines, "arm.urdf:5:5", "joint 'j1': velocity must be above 0",
             "write what the arm can here, or in the application: write joint.j1 = { velocity = 1.0 } in "
             "[device.arm.urdf]"));
  lines = {};
  lines.first_limit = "    <limit lower='-1' upper='nan' velocity='1'/>";
  assert_true(yields(
      lines, "arm.urdf:5:5", "joint 'j1': <limit> upper=\"nan\" is not a number up to 1e6",
      "write what the arm can, as upper=\"1.57\"; or leave the file as it is, and write joint.j1 = { lower "
      "= -1.57, upper = 1.57 } in [device.arm.urdf]"));
  lines = {};
  lines.first_axis = "    <axis xyz='0 0 0'/>";
  assert_true(
      yields(lines, "arm.urdf:4:5", "joint 'j1': the axis has no length", "a direction, as xyz=\"0 0 1\""));
  lines = {};
  lines.first_axis = "    <axis xyz='0 1'/>";
  assert_true(yields(lines, "arm.urdf:4:5", "joint 'j1': the axis's xyz is not three numbers up to 1e6",
                     "a direction, as xyz=\"0 0 1\""));
  lines = {};
  lines.first_axis = "    <origin xyz='a b c'/>";
  assert_true(yields(lines, "arm.urdf:4:5", "joint 'j1': xyz=\"a b c\" is not three numbers up to 1e6",
                     "x, y and z in m, as xyz=\"0 0 0.24\""));
  lines = {};
  // A pose of such numbers would not be finite.
  lines.first_axis = "    <origin xyz='1e308 0 0'/>";
  assert_true(yields(lines, "arm.urdf:4:5", "joint 'j1': xyz=\"1e308 0 0\" is not three numbers up to 1e6",
                     "x, y and z in m, as xyz=\"0 0 0.24\""));
  lines = {};
  lines.first_extra = "    <flexrf acceleration='0' jerk='4'/></joint>";
  assert_true(
      yields(lines, "arm.urdf:6:5", "joint 'j1': acceleration must be above 0",
             "write what the arm can here, or in the application: write joint.j1 = { acceleration = 1.0 } "
             "in [device.arm.urdf]"));
  lines = {};
  lines.first_extra = "    <flexrf acceleration='1' jerk='4' home='3'/></joint>";
  assert_true(yields(lines, "arm.urdf:6:5", "joint 'j1': home (3) is outside the limits",
                     "it must be from -1 to 1 rad"));
}

// URDF 1.1: a rotation as a quaternion, of whatever length.
void test_a_quaternion_turns_as_rpy_does(void**) {
  Lines lines;
  lines.mount_origin =
      "    <origin xyz='0.5 0 0' quat_xyzw='0 0 1.4142135623730951 1.4142135623730951'/></joint>";
  const bool same = [&] {
    const Read read = parsed(lines.text());
    const Read by_rpy = parsed(Lines().text());
    return read.chain && says(read, "") && read.chain->tool.rotation == by_rpy.chain->tool.rotation;
  }();
  assert_true(same);
  // About all three axes: 0.36 0.48 0 0.8 is a turn about (0.6, 0.8, 0) by 2 acos(0.8).
  lines.mount_origin = "    <origin quat_xyzw='0.36 0.48 0 0.8'/></joint>";
  const bool turned = [&] {
    const Read read = parsed(lines.text());
    const double expected[9] = {0.5392, 0.3456, -0.768, 0.3456, 0.7408, 0.576, 0.768, -0.576, 0.28};
    if (!read.chain) return false;
    for (std::size_t i = 0; i < 9; ++i)
      if (std::abs(read.chain->tool.rotation[i] - expected[i]) > 1e-12) return false;
    return true;
  }();
  assert_true(turned);
  lines.mount_origin = "    <origin rpy='0 0 1' quat_xyzw='0 0 0 1'/></joint>";
  assert_true(yields(lines, "arm.urdf:10:5", "joint 'm' is turned twice, by rpy and by quat_xyzw",
                     "keep the one that is meant"));
  lines.mount_origin = "    <origin quat_xyzw='0 0 0 0'/></joint>";
  assert_true(yields(lines, "arm.urdf:10:5", "joint 'm': quat_xyzw has no length",
                     "no rotation is quat_xyzw=\"0 0 0 1\""));
  lines.mount_origin = "    <origin quat_xyzw='0 0 1'/></joint>";
  assert_true(yields(lines, "arm.urdf:10:5", "joint 'm': quat_xyzw=\"0 0 1\" is not four numbers up to 1e6",
                     "a quaternion of length 1, as quat_xyzw=\"0 0 0.7071068 0.7071068\""));
}

// URDF 1.2.
void test_a_limit_tells_how_quickly_speed_changes(void**) {
  Lines lines;
  lines.first_limit =
      "    <limit lower='-1' upper='1' velocity='2' effort='9' acceleration='0.4' deceleration='0.2' "
      "jerk='3'/>";
  lines.first_extra = "    </joint>";
  const auto first_is = [&](double acceleration, double jerk) {
    const Read read = parsed(lines.text());
    return read.chain && says(read, "") && read.chain->joints[0].acceleration == acceleration &&
           read.chain->joints[0].jerk == jerk;
  };
  assert_true(first_is(0.2, 3));
  lines.first_extra = "    <flexrf acceleration='0.3'/></joint>";
  assert_true(first_is(0.3, 3));
  lines.first_limit = "    <limit lower='-1' upper='1' velocity='2' acceleration='0' jerk='3'/>";
  lines.first_extra = "    </joint>";
  assert_true(
      yields(lines, "arm.urdf:5:5", "joint 'j1': acceleration must be above 0",
             "write what the arm can here, or in the application: write joint.j1 = { acceleration = 1.0 } "
             "in [device.arm.urdf]"));
}

void test_soft_limits_narrow_the_range(void**) {
  Lines lines;
  lines.first_extra =
      "    <safety_controller soft_lower_limit='-0.9' soft_upper_limit='3' k_velocity='1'/>"
      "<flexrf acceleration='3' jerk='4'/></joint>";
  const bool narrower = [&] {
    const Read read = parsed(lines.text());
    return read.chain && says(read, "") && read.chain->joints[0].lower == -0.9 &&
           read.chain->joints[0].upper == 1;
  }();
  assert_true(narrower);
  const bool other_end_too = [&] {
    lines.first_extra =
        "    <safety_controller soft_lower_limit='-0.9' soft_upper_limit='0.8'/>"
        "<flexrf acceleration='3' jerk='4'/></joint>";
    UrdfRow row = row_of_cell();
    row.joints["j1"].lower = -1.5;
    const Read read = parsed(lines.text(), row);
    return read.chain && read.chain->joints[0].lower == -1.5 && read.chain->joints[0].upper == 0.8;
  }();
  assert_true(other_end_too);
}

// Exporters write -inf or -1e16 for "no limit". The file is the vendor's, so the hint names the application's
// row.
void test_a_limit_without_end_names_the_row(void**) {
  for (const char* const number : {"-inf", "-1e16"}) {
    Lines lines;
    lines.first_limit = std::string("    <limit lower='") + number + "' upper='1' velocity='2'/>";
    assert_true(yields(lines, "arm.urdf:5:5",
                       std::string("joint 'j1': <limit> lower=\"") + number + "\" is not a number up to 1e6",
                       "write what the arm can, as lower=\"1.57\"; or leave the file as it is, and write "
                       "joint.j1 = { lower = -1.57, upper = 1.57 } in [device.arm.urdf]"));
    UrdfRow row = row_of_cell();
    row.joints["j1"].lower = -1;
    row.joints["j1"].upper = 1;
    assert_true(parsed(lines.text(), row).chain.has_value());
  }
}

void test_what_is_not_read_is_told(void**) {
  Lines lines;
  lines.first_axis = "    <origin xyz='0 0 1' rpyy='0 0 1'/><axis xyz='0 0 2'/>";
  assert_true(yields(lines, "arm.urdf:4:5",
                     "joint 'j1': <origin> has the attribute 'rpyy', and what it means is not known",
                     "did you mean 'rpy'?"));
  lines = {};
  lines.first_limit = "    <limits lower='-1' upper='1' velocity='2'/>";
  assert_true(parsed(lines.text())
                  .messages.find("arm.urdf:5:5: error: joint 'j1' has <limits>, which no URDF "
                                 "has\narm.urdf:5:5: hint: did you mean 'limit'?") != std::string::npos);
  lines = {};
  lines.first_axis += "<axis xyz='0 1 0'/>";
  assert_true(yields(lines, "arm.urdf:4:45", "joint 'j1' has a second <axis>", "keep the one that is meant"));
  lines = {};
  // A simulator's, another program's, and one that nobody knows.
  lines.first_axis += "<dynamics damping='1'/><gazebo/><drake:thing/><cable length='1'/><cable length='2'/>";
  const bool told = [&] {
    const Read read = parsed(lines.text());
    return read.chain &&
           says(read,
                "arm.urdf:4:91: warning: joint 'j1' has <cable>, which no URDF has: it is passed over\n"
                "arm.urdf:4:91: hint: remove it, or see what it is meant to say\n");
  }();
  assert_true(told);
  Read read = parsed("<robot name='r' version='3.0'><link name='a'/></robot>");
  assert_true(
      read.messages.find("arm.urdf:1:1: warning: version '3.0' of URDF is not known: it is read as 1.2") !=
      std::string::npos);
}

void test_only_a_chain_of_known_joints(void**) {
  Lines lines;
  lines.second = "  <joint name='j2' type='revolut'><parent link='arm'/><child link='tip'/>";
  assert_true(
      yields(lines, "arm.urdf:7:3", "joint 'j2' has the unknown type 'revolut'", "did you mean 'revolute'?"));
  lines.second = "  <joint name='j2' type='floating'><parent link='arm'/><child link='tip'/>";
  assert_true(yields(lines, "arm.urdf:7:3", "joint 'j2' is floating, and no joint of an arm is",
                     "where it carries the whole robot: write base = \"tip\" in [device.arm.urdf]"));
  lines = {};
  lines.second = "  <joint name='j2' type='revolute'><parent link='base'/><child link='tip'/>";
  assert_true(
      yields(lines, "arm.urdf:7:3", "link 'base' carries more than one chain: those of joints 'j1' and 'j2'",
             "say where the arm ends: write tool = \"LINK\" in [device.arm.urdf]; an arm is one chain, from "
             "its base to its tool"));
  lines = {};
  lines.second = "  <joint name='j2' type='revolute'><parent link='arm'/><child link='tipp'/>";
  assert_true(yields(lines, "arm.urdf:7:56", "joint 'j2': there is no link 'tipp'", "did you mean 'tip'?"));
  lines = {};
  lines.base += "<link name='odd'/>";
  assert_true(yields(lines, "arm.urdf:2:77",
                     "links 'base' and 'odd' are both without a joint that carries them",
                     "an arm has one base: write base = \"base\" in [device.arm.urdf]"));
  lines = {};
  lines.mount = "  <joint name='j1' type='fixed'><parent link='tip'/><child link='tool'/>";
  assert_true(yields(lines, "arm.urdf:9:3", "joint 'j1' is there twice", "rename or remove one"));
  lines = {};
  lines.mount = "  <joint name='m' type='fixed'><parent link='tip'/><child link='base'/>";
  lines.base = "  <link name='base'/><link name='arm'/><link name='tip'/>";
  assert_true(yields(lines, "arm.urdf:2:3", "the joints around link 'base' form a loop",
                     "in a URDF each link hangs on the one before, from the base on"));
  lines = {};
  lines.mount = "  <joint name='m' type='fixed'><parent link='base'/><child link='tip'/>";
  assert_true(yields(lines, "arm.urdf:9:3", "link 'tip' hangs on more than one joint: 'j2' and 'm'",
                     "closed chains are not supported: leave out the joint that closes it"));
  lines = {};
  lines.second_rest = "    <mimic joint='j1'/><limit lower='-2' upper='2' velocity='1'/></joint>";
  assert_true(yields(lines, "arm.urdf:8:5", "joint 'j2' follows 'j1': <mimic> is not supported within an arm",
                     "let the arm end before it: write tool = \"arm\" in [device.arm.urdf]"));
}

void test_too_many_joints_are_told(void**) {
  std::string text = "<robot name='snake'><link name='l0'/>";
  for (int i = 1; i <= 9; ++i) {
    const std::string number = std::to_string(i);
    text += "<link name='l" + number + "'/><joint name='j" + number + "' type='revolute'><parent link='l" +
            std::to_string(i - 1) + "'/><child link='l" + number +
            "'/><limit lower='-1' upper='1' velocity='1'/><flexrf acceleration='1' jerk='1'/></joint>";
  }
  text += "</robot>";
  assert_true(
      says(parsed(text),
           "arm.urdf:1:1: error: the chain from base to tool has 9 joints that move, at most 8 are "
           "supported\n"
           "arm.urdf:1:1: hint: name a shorter part of it: write base = \"LINK\" or tool = \"LINK\" in "
           "[device.arm.urdf]\n"));
  UrdfRow row = row_of_cell();
  row.base = UrdfFrame{"l1", {intern("cell.toml"), 8, 8}};
  const bool shorter = [&] {
    const Read read = parsed(text, row);
    return read.chain && read.chain->joints.size() == 8 && read.chain->joints[0].name == "j2" &&
           says(read, "");
  }();
  assert_true(shorter);
}

// What an application says goes before what the file says, and stands in for what it lacks.
void test_the_application_says_more(void**) {
  Lines lines;
  lines.first_limit = "    <limit lower='0' upper='0' velocity='0'/>";
  lines.first_extra = "    </joint>";
  UrdfRow row = row_of_cell();
  row.joints["j1"] = {{intern("cell.toml"), 9, 1}, -0.5, 2.0, 1.5, 6.0, 60.0, 0.25};
  row.joints["j2"].home = 1.0;
  const bool taken = [&] {
    const Read read = parsed(lines.text(), row);
    if (!read.chain || !says(read, "")) return false;
    const UrdfJoint& first = read.chain->joints[0];
    return first.lower == -0.5 && first.upper == 2.0 && first.velocity == 1.5 && first.acceleration == 6.0 &&
           first.jerk == 60.0 && first.home == 0.25 && read.chain->joints[1].home == 1.0 &&
           read.chain->joints[1].acceleration == 1.0;
  }();
  assert_true(taken);
  row.joints["j3"].position = {intern("cell.toml"), 11, 1};
  assert_true(yields(lines, "cell.toml:11:1", "the arm has no joint 'j3'", "did you mean 'j1'?", row));
}

void test_missing_acceleration_is_gentle_and_told(void**) {
  Lines lines;
  lines.first_extra = "    </joint>";
  lines.second_rest = "    <limit lower='1' upper='2' velocity='0.5'/><flexrf acceleration='1'/></joint>";
  const bool gentle = [&] {
    const Read read = parsed(lines.text());
    if (!read.chain) return false;
    const UrdfJoint& first = read.chain->joints[0];
    const UrdfJoint& second = read.chain->joints[1];
    return first.acceleration == 2.0 && first.jerk == 10.0 && first.home == 0.0 &&
           second.acceleration == 1.0 && second.jerk == 5.0 && second.home == 1.5 &&
           says(read,
                "cell.toml:7:8: warning: nothing says how quickly joints 'j1' and 'j2' may change speed: "
                "taken is "
                "what comes to full velocity in 1 s, and to full acceleration in 0.2 s\n"
                "cell.toml:7:8: hint: write what the arm can, of each joint, in [device.arm.urdf]: joint.j1 "
                "= { "
                "acceleration = 2, jerk = 10 }\n");
  }();
  assert_true(gentle);
}

void test_joints_slide_and_turn_without_end(void**) {
  Lines lines;
  lines.first = "  <joint name='j1' type='prismatic'><parent link='base'/><child link='arm'/>";
  lines.second = "  <joint name='j2' type='continuous'><parent link='arm'/><child link='tip'/>";
  lines.second_rest = "    <limit velocity='1'/><flexrf acceleration='1' jerk='1'/></joint>";
  UrdfRow row = row_of_cell();
  const auto kinds = [&] {
    const Read read = parsed(lines.text(), row);
    if (!read.chain || !says(read, "")) return std::string("none");
    std::string all;
    for (const UrdfJoint& joint : read.chain->joints)
      all += std::to_string(static_cast<int>(joint.kind)) + ":" + std::to_string(std::lround(joint.lower)) +
             ".." + std::to_string(std::lround(joint.upper)) + " ";
    return all;
  };
  assert_string_equal(kinds().c_str(), "2:-1..1 1:-1000000..1000000 ");
  row.joints["j2"].lower = -3;
  row.joints["j2"].upper = 4;
  assert_string_equal(kinds().c_str(), "2:-1..1 0:-3..4 ");
  row.joints["j2"].upper.reset();
  row.joints["j2"].position = {intern("cell.toml"), 9, 1};
  assert_true(yields(lines, "cell.toml:9:1", "joint 'j2' turns without end, and gets one end only",
                     "give both 'lower' and 'upper', in rad, or none", row));
  lines.first_limit = "";
  const std::string messages = parsed(lines.text()).messages;
  assert_true(messages.find("in m and m/s") != std::string::npos);
}

UrdfFrame frame(const char* link, std::uint32_t line) {
  return {link, {intern("cell.toml"), line, 8}};
}

// Frames beside the chain are no part of it, and can be named.
void test_frames_are_named(void**) {
  Lines lines;
  lines.base += "<link name='beside'/><link name='camera'/><link name='sensor'/>";
  lines.more =
      "<joint name='b' type='fixed'><parent link='base'/><child link='beside'/><origin xyz='1 2 3'/></joint>"
      "<joint name='c' type='fixed'><parent link='arm'/><child link='camera'/><origin xyz='0 0 4'/></joint>";
  UrdfRow row = row_of_cell();
  const auto read = [&] {
    const Read all = parsed(lines.text(), row);
    if (!all.chain || !says(all, "")) return std::string("none");
    std::ostringstream text;
    text << all.chain->joints.size() << " from " << all.chain->joints[0].origin.position[0] << " "
         << all.chain->joints[0].origin.position[1] << " " << all.chain->joints[0].origin.position[2]
         << " to " << all.chain->tool.position[0] << " " << all.chain->tool.position[2] << " in "
         << all.chain->base;
    return text.str();
  };
  lines.base.erase(lines.base.find("<link name='sensor'/>"));
  assert_string_equal(read().c_str(), "2 from 0 0 1 to 0.5 0 in base");
  row.base = frame("beside", 8);
  assert_string_equal(read().c_str(), "2 from -1 -2 -2 to 0.5 0 in beside");
  row.tool = frame("camera", 9);
  assert_string_equal(read().c_str(), "1 from -1 -2 -2 to 0 4 in beside");
  row.base = frame("arm", 8);
  row.tool = frame("beside", 9);
  assert_true(yields(lines, "cell.toml:9:8", "link 'beside' does not hang on the base 'arm'",
                     "name a base that lies before the tool, or is fixed to what does", row));
  row.tool = frame("camra", 9);
  assert_true(
      yields(lines, "cell.toml:9:8", "'arm.urdf' has no link 'camra'", "did you mean 'camera'?", row));
  row.base.reset();
  row.tool = frame("base", 9);
  assert_true(yields(lines, "arm.urdf:1:1", "the chain from base to tool has no joint that moves",
                     "say where the arm ends: write tool = \"LINK\" in [device.arm.urdf]", row));
}

void test_rods_that_others_lead_are_passed_by(void**) {
  Lines lines;
  lines.base += "<link name='rod'/>";
  lines.more =
      "<joint name='r' type='revolute'><parent link='arm'/><child link='rod'/><mimic joint='j2'/></joint>";
  const bool passed = [&] {
    const Read read = parsed(lines.text());
    return read.chain && read.chain->joints.size() == 2 && read.chain->tool.position[0] == 0.5 &&
           says(read, "");
  }();
  assert_true(passed);
}

void test_files_that_are_no_urdf(void**) {
  assert_true(says(parsed("\n<sdf/>"),
                   "arm.urdf:2:1: error: the outermost element is <sdf>, not <robot>\n"
                   "arm.urdf:2:1: hint: a URDF is needed; SDF and MJCF are converted by the tools of their "
                   "simulators\n"));
  assert_true(
      says(parsed("<robot name='x' xmlns:xacro='http://ros.org/wiki/xacro'>\n"
                  "  <xacro:include filename='arm.xacro'/></robot>"),
           "arm.urdf:2:3: error: this is a xacro file: <xacro:include> makes no sense in a URDF\n"
           "arm.urdf:2:3: hint: make the URDF of it, where its package is installed: xacro FILE.xacro > "
           "FILE.urdf\n"));
  assert_true(parsed("<robot name='x'>\n  <link").messages.starts_with("arm.urdf:2:"));
  assert_false(parsed("").messages.empty());
  assert_false(parsed("<robot name='x'/>").messages.empty());
  const bool absent = [] {
    Diagnostics diagnostics;
    return !read_urdf("/nowhere/x.urdf", row_of_cell(), diagnostics) &&
           printed(diagnostics)
               .starts_with("/nowhere/x.urdf:1:1: error: cannot read this file: No such file or directory\n");
  }();
  assert_true(absent);
}

void test_several_errors_at_once_in_order(void**) {
  const bool good = [] {
    Lines lines;
    lines.first_limit = "";
    lines.first_axis = "    <axis xyz='0 0 0'/>";
    lines.second_rest = "    <limit lower='1' upper='-1' velocity='1'/></joint>";
    const std::string messages = parsed(lines.text()).messages;
    const std::size_t first = messages.find("arm.urdf:3:3: error");
    const std::size_t second = messages.find("arm.urdf:4:5: error");
    const std::size_t third = messages.find("arm.urdf:8:5: error");
    return first < second && second < third && third != std::string::npos;
  }();
  assert_true(good);
}

void test_same_chain_same_text(void**) {
  const bool good = [] {
    const std::string once = emit_kinematic_chain(*parsed(Lines().text()).chain);
    return once == emit_kinematic_chain(*parsed(Lines().text()).chain) &&
           once.find("nan") == std::string::npos && once.find("-0.0,") == std::string::npos &&
           once.find("flexrf::JointKind::revolute") != std::string::npos;
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
      cmocka_unit_test(test_a_quaternion_turns_as_rpy_does),
      cmocka_unit_test(test_a_limit_tells_how_quickly_speed_changes),
      cmocka_unit_test(test_soft_limits_narrow_the_range),
      cmocka_unit_test(test_a_limit_without_end_names_the_row),
      cmocka_unit_test(test_what_is_not_read_is_told),
      cmocka_unit_test(test_only_a_chain_of_known_joints),
      cmocka_unit_test(test_too_many_joints_are_told),
      cmocka_unit_test(test_the_application_says_more),
      cmocka_unit_test(test_missing_acceleration_is_gentle_and_told),
      cmocka_unit_test(test_joints_slide_and_turn_without_end),
      cmocka_unit_test(test_frames_are_named),
      cmocka_unit_test(test_rods_that_others_lead_are_passed_by),
      cmocka_unit_test(test_files_that_are_no_urdf),
      cmocka_unit_test(test_several_errors_at_once_in_order),
      cmocka_unit_test(test_same_chain_same_text),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
