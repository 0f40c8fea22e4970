// What rows of widgets draw over a picture and around a robot, as the page is told it.
#include <string>

#include "config-gen/emit/descriptor_panel.hpp"
#include "config-gen/tests/tables.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests::panel_layers_test {
namespace {

using Json = nlohmann::ordered_json;

const Json& widget(std::size_t index) {
  static const Json all = [] {
    std::filesystem::current_path(place::tests_folder);
    return widgets_json(read_cell("catalogue/base/sight").model);
  }();
  return all.at(index);
}

bool is(const Json& json, const char* expected) {
  // Objects whose members stand in another order are the same.
  if (nlohmann::json::parse(json.dump()) == nlohmann::json::parse(expected)) return true;
  print_message("got %s\n", json.dump(1).c_str());
  return false;
}

// Of a population all members, by number; a time that the slot tells of all its things.
void overlays(void**) {
  assert_true(is(widget(0).at("overlays"), R"([{
    "name": "sights", "label": "What is seen", "shown": false, "slots": ["reports[0]", "reports[1]"],
    "list": "sights", "count": "count", "empty": {"field": "kind", "value": "nothing"},
    "text": ["number", "kind"], "certain": "confirmed", "rectangle": ["left", "top", "box[0]", "box[1]"],
    "class": "kind", "weight": "score", "time": {"of": "slot", "field": "taken"}}])"));
  assert_false(widget(0).contains("bodies") || widget(0).contains("frames") || widget(0).contains("base"));
}

void bodies_and_frames(void**) {
  assert_true(is(widget(1).at("bodies"), R"([{
    "name": "sights", "shown": true, "slots": ["reports[1]"], "list": "sights",
    "empty": {"field": "kind", "value": "nothing"}, "text": ["number"], "certain": "confirmed",
    "position": "place.position", "angle": "place.angle", "kind": "number", "kinds": [
      {"name": "block", "value": 0, "height": 0.02, "colour": "#2850c8",
       "outline": [[-0.02, -0.01], [0.02, -0.01], [0.02, 0.01], [-0.02, 0.01]]},
      {"name": "post", "value": 65535, "radius": "radius", "height": 0.1, "colour": "#46464b"}]}])"));
  assert_true(is(widget(1).at("frames"), R"([{
    "name": "camera", "label": "Camera", "shown": true, "link": "tool",
    "mount": {"position": [0.05, 0.0, 0.05], "orientation": [0.0, 0.0, 0.0, 1.0]},
    "frustum": {"width": 640.0, "height": 480.0, "focal_length": 600.0, "depth": 0.3}}])"));
  assert_string_equal(widget(1).at("base").get<std::string>().c_str(), "base");
  assert_false(widget(1).contains("overlays"));
}

}  // namespace
}  // namespace flexrf::config_gen::tests::panel_layers_test

int main() {
  using namespace flexrf::config_gen::tests::panel_layers_test;
  const CMUnitTest tests[] = {cmocka_unit_test(overlays), cmocka_unit_test(bodies_and_frames)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
