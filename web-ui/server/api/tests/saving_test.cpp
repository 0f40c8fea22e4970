// Save now, by REST and live, and what the state says of the configuration file.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::saving_test {
namespace {

using fixture::ProducerAndConsumer;

/// A folder of the test's own, and the configuration file in it.
class PlaceToSave {
 public:
  PlaceToSave() {
    char folder[] = "/tmp/flexrf-panel-saving-XXXXXX";
    CHECK(mkdtemp(folder) != nullptr);
    folder_ = folder;
  }
  ~PlaceToSave() { std::filesystem::remove_all(folder_); }
  PlaceToSave(const PlaceToSave&) = delete;
  PlaceToSave& operator=(const PlaceToSave&) = delete;

  Options options() const {
    Options options = fixture::on_the_wall_clock();
    options.configuration_file = folder_ + "/cell.xml";
    return options;
  }
  std::string contents() const {
    std::ifstream stream(folder_ + "/cell.xml");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  std::string obstacle() const { return folder_ + "/cell.xml.new"; }

 private:
  std::string folder_;
};

/// An application that saves when somebody asks, and not before.
struct OnCommand : ProducerAndConsumer {
  OnCommand() { save.on_change = false; }
};

void what_is_set_is_saved_when_somebody_asks() {
  const PlaceToSave place;
  OnCommand cell;
  Rig rig(cell, Rig::patient, place.options());
  rig.start();
  const json values = rig.get("state").body.at("values");
  CHECK(values == json({{"file", true},
                        {"on", "command"},
                        {"unsaved", false},
                        {"saved_at_ms", nullptr},
                        {"writings", 0},
                        {"failure", ""}}));
  PlayedLink& link = rig.connect(an_operator);
  rig.event(link, "state");
  CHECK(rig.ask(link, {{"op", "save_values"}}).at("problem").at("status") == 403);  // not in control
  rig.ask(link, {{"op", "take_control"}});
  rig.ask(link, {{"op", "set"}, {"component", "producer"}, {"values", {{"gain", 2.5}}}});
  CHECK(rig.wait_until([&] { return rig.get("state").body.at("values").at("unsaved") == true; }));
  CHECK_EQUAL(place.contents(), std::string{});
  const json saved = rig.ask(link, {{"op", "save_values"}});
  CHECK(saved.at("ok") == true);
  CHECK(saved.at("saved_at_ms").get<std::int64_t>() > 0);
  CHECK_CONTAINS(place.contents(), ">2.5</gain>");
  CHECK(rig.wait_until([&] { return rig.event(link, "state").at("values").at("unsaved") == false; }));
  CHECK(rig.get("state").body.at("values").at("saved_at_ms") == saved.at("saved_at_ms"));
  CHECK(rig.get("state").body.at("values").at("writings") == 1);
}

void by_rest_too() {
  const PlaceToSave place;
  OnCommand cell;
  Rig rig(cell, Rig::patient, place.options());
  rig.start();
  CHECK_EQUAL(rig.request(Method::post, "save-values", an_operator).status, 403U);
  rig.request(Method::post, "control/take", an_operator);
  CHECK_EQUAL(rig.request(Method::post, "save-values", a_viewer).status, 403U);
  CHECK_EQUAL(
      rig.request(Method::put, "components/producer/parameters", an_operator, R"({"gain": 3})").status, 200U);
  const Answer saved = rig.request(Method::post, "save-values", an_operator);
  CHECK_EQUAL(saved.status, 200U);
  CHECK(saved.body.at("saved_at_ms").get<std::int64_t>() > 0);
  CHECK_CONTAINS(place.contents(), ">3</gain>");
}

void a_save_that_fails_says_why() {
  const PlaceToSave place;
  OnCommand cell;
  Rig rig(cell, Rig::patient, place.options());
  rig.start();
  rig.request(Method::post, "control/take", an_operator);
  CHECK(mkdir(place.obstacle().c_str(), 0700) == 0);
  rig.request(Method::put, "components/producer/parameters", an_operator, R"({"gain": 3})");
  const Answer refused = rig.request(Method::post, "save-values", an_operator);
  CHECK_EQUAL(refused.status, 507U);
  CHECK_EQUAL(refused.body.at("type").get<std::string>(), std::string{"/problems/not-stored"});
  CHECK_CONTAINS(refused.body.at("detail").get<std::string>(), "The values were not saved: cannot create");
  const json values = rig.get("state").body.at("values");
  CHECK_CONTAINS(values.at("failure").get<std::string>(), "cell.xml.new");
  CHECK(values.at("unsaved") == true);
  CHECK(rmdir(place.obstacle().c_str()) == 0);
  CHECK_EQUAL(rig.request(Method::post, "save-values", an_operator).status, 200U);
  CHECK_EQUAL(rig.get("state").body.at("values").at("failure").get<std::string>(), std::string{});
}

void without_a_file_it_is_told_how_to_have_one() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.request(Method::post, "control/take", an_operator);
  CHECK(rig.get("state").body.at("values").at("file") == false);
  const Answer refused = rig.request(Method::post, "save-values", an_operator);
  CHECK_EQUAL(refused.status, 409U);
  CHECK_CONTAINS(refused.body.at("detail").get<std::string>(), "--config FILE");
}

}  // namespace
}  // namespace flexrf::panel::saving_test

int main() {
  using namespace flexrf::panel::saving_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(what_is_set_is_saved_when_somebody_asks),
      CONTAINED_TEST(by_rest_too),
      CONTAINED_TEST(a_save_that_fails_says_why),
      CONTAINED_TEST(without_a_file_it_is_told_how_to_have_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
