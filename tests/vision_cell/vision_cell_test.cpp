// Perception and evolution in a running cell, in virtual time: what lies on the table is found and followed,
// members come and go, and a person freezes them, saves them and brings them back.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "attention_evolution_unit.hpp"
#include "object_tracks_unit.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"
#include "tests/vision_cell/cell/units/eye/eye.hpp"
#include "units/vision/tests/known_parts.hpp"
#include "visual_features_unit.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

using namespace flexrf::user;

Options in_virtual_time() {
  Options options;
  options.virtual_time = std::chrono::minutes(1);
  options.realtime = false;
  options.digest = true;
  return options;
}

class VisionCell {
 public:
  explicit VisionCell(const Options& options = in_virtual_time())
      : executive_(application::application, options) {
    const Status status = executive_.prepare();
    if (!status) throw fixture::CheckFailed{std::string{"prepare: "} + status.cause()};
  }

  /// One after the other, each as soon as its condition is so.
  void when(const char* what, std::function<bool()> condition, std::function<void()> act) {
    steps_.push_back({what, std::move(condition), std::move(act)});
  }
  void run() {
    std::function<void()> job;
    job = [this, &job] {
      if (place_ < steps_.size() && steps_[place_].condition()) steps_[place_++].act();
      if (place_ == steps_.size()) executive_.request_end();
      executive_.lifecycle().post(job);
    };
    executive_.lifecycle().post(job);
    CHECK_EQUAL(executive_.run().exit_code, 0);
    if (place_ < steps_.size()) throw fixture::CheckFailed{"it waits in vain for: " + steps_[place_].what};
  }

  const AttentionEvolutionFeedback& evolution() { return told_by<AttentionEvolutionFeedback>("evolution"); }
  const FeatureExtractionFeedback& features() { return told_by<FeatureExtractionFeedback>("features"); }
  const EyeFeedback& eye() { return told_by<EyeFeedback>("eye"); }
  std::uint64_t digest() { return executive_.cell().digest(); }

  void press(const char* parameter) {
    ParameterRequest request = request_to("evolution", RequestKind::press);
    CHECK(request.add_presses(number_of(request.component, parameter)));
    executive_.cell().send(request);
  }
  template <class T>
  void set(const char* unit, const char* parameter, T value) {
    ParameterRequest request = request_to(unit, RequestKind::set);
    CHECK(request.add(number_of(request.component, parameter), 0, &value, sizeof(value)));
    executive_.cell().send(request);
  }
  template <class T>
  T newest(const char* slot) {
    for (const SlotRecord& record : application::application.slots) {
      if (std::strcmp(record.name, slot) != 0 || record.observer == nullptr) continue;
      const auto lock = executive_.cell().observe();
      T value{};
      if (record.observer->newest() != nullptr) std::memcpy(&value, record.observer->payload(), sizeof(T));
      return value;
    }
    throw fixture::CheckFailed{std::string{"there is no observed slot "} + slot};
  }

 private:
  struct Step {
    std::string what;
    std::function<bool()> condition;
    std::function<void()> act;
  };

  std::uint16_t unit(const char* name) {
    const auto units = executive_.cell().application().units;
    for (std::size_t i = 0; i < units.size(); ++i)
      if (std::strcmp(units[i].name, name) == 0) return static_cast<std::uint16_t>(i);
    throw fixture::CheckFailed{std::string{"there is no unit "} + name};
  }
  std::uint16_t number_of(std::uint16_t component, const char* parameter) {
    const auto parameters = executive_.cell().component_type(component).runtime.parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (std::strcmp(parameters[i].field->name, parameter) == 0) return static_cast<std::uint16_t>(i);
    throw fixture::CheckFailed{std::string{"there is no parameter "} + parameter};
  }
  ParameterRequest request_to(const char* name, RequestKind kind) {
    ParameterRequest request;
    request.component = unit(name);
    request.kind = kind;
    return request;
  }
  template <class Feedback>
  const Feedback& told_by(const char* name) {
    return *static_cast<const Feedback*>(executive_.cell().component(unit(name)).parameter_memory().feedback);
  }

  Executive executive_;
  std::vector<Step> steps_;
  std::size_t place_ = 0;
};

const ObjectTrack* track_at(const TrackList& list, const LaidPart& part) {
  for (const ObjectTrack& track : list.tracks)
    if (track.found == VisualClass::target && track.kind == part.kind &&
        (track.position_map() - part.pose.position).norm() < 0.001)
      return &track;
  return nullptr;
}

void what_lies_there_is_followed_and_members_come_and_go() {
  VisionCell cell;
  cell.when(
      "12 s", [&] { return cell.eye().pictures > 360; },
      [&] {
        const auto list = cell.newest<TrackList>("tracks");
        std::size_t obstacles = 0;
        for (const ObjectTrack& track : list.tracks)
          obstacles += track.found == VisualClass::obstacle ? 1 : 0;
        CHECK_EQUAL(list.count, laid_parts.size() + 1);
        CHECK_EQUAL(obstacles, 1U);
        for (const LaidPart& part : laid_parts) {
          const ObjectTrack* const track = track_at(list, part);
          CHECK(track != nullptr);
          CHECK(track->may_be_target);
          CHECK(std::abs(within_symmetry(track->angle - part.pose.angle, known_parts()[part.kind].symmetry)) <
                0.035);
        }
        const AttentionEvolutionFeedback& told = cell.evolution();
        CHECK(told.generation >= 15);
        CHECK(told.births > 3);
        CHECK(told.deaths > 2);
        CHECK(told.promotions > 0);
        CHECK_EQUAL(told.refused, 0U);
        CHECK(told.best_fitness > 0);
        CHECK(told.active >= 5 && told.active <= 8);
      });
  cell.run();
}

void the_member_of_the_target_in_hand_is_left_alone() {
  VisionCell cell;
  ObjectTrack target{};
  cell.when(
      "a target", [&] { return cell.eye().pictures > 60; },
      [&] {
        for (const ObjectTrack& track : cell.newest<TrackList>("tracks").tracks)
          if (track.may_be_target) target = track;
        CHECK(target.may_be_target);
        cell.set("eye", "track", target.identity);
      });
  cell.when(
      "many generations", [&] { return cell.evolution().generation > 25; },
      [&] {
        const AttentionMember member = cell.newest<AttentionGeneration>("generation").members[target.member];
        CHECK(member.active);
        CHECK(member.is_protected);
        CHECK_EQUAL(member.identity, target.member_identity);
        CHECK(cell.evolution().deaths > 3);
      });
  cell.run();
}

void a_covered_lens_is_told_and_passes() {
  VisionCell cell;
  std::uint64_t then = 0;
  cell.when(
      "good pictures", [&] { return cell.features().pictures > 20; },
      [&] { cell.set("eye", "covered", true); });
  cell.when(
      "black ones",
      [&] { return cell.features().state == PictureState::black && cell.features().refused > 10; },
      [&] {
        then = cell.features().pictures;
        cell.set("eye", "covered", false);
      });
  cell.when(
      "good ones again",
      [&] {
        return cell.features().pictures > then + 10 && cell.features().state == PictureState::good &&
               cell.newest<TrackList>("tracks").count == laid_parts.size() + 1;
      },
      [] {});
  cell.run();
}

void a_person_freezes_saves_and_brings_back() {
  VisionCell cell;
  AttentionEvolutionRuntime saved{};
  std::uint64_t changes = 0;
  std::uint64_t pictures = 0;
  const auto is_saved = [&] {
    saved = cell.newest<AttentionEvolutionRuntime>("evolution.values");
    return std::count(saved.saved_members.begin(), saved.saved_members.end(), true) > 2;
  };
  const auto changed = [&] { return cell.evolution().births + cell.evolution().deaths; };
  cell.when(
      "some generations", [&] { return cell.evolution().generation == 5; }, [&] { cell.press("save"); });
  cell.when("what was saved", is_saved, [] {});
  cell.when(
      "others", [&] { return cell.evolution().generation == 12; },
      [&] { cell.set("evolution", "frozen", true); });
  cell.when(
      "frozen", [&] { return cell.newest<AttentionGeneration>("generation").frozen; },
      [&] {
        changes = changed();
        pictures = cell.eye().pictures;
      });
  cell.when(
      "still frozen", [&] { return cell.eye().pictures > pictures + 100; },
      [&] {
        CHECK(changed() <= changes + 1);  // a request may have been under way
        cell.press("restore");
      });
  cell.when(
      "being brought back", [&] { return cell.evolution().restoring; }, [] {});
  cell.when(
      "brought back", [&] { return !cell.evolution().restoring; }, [&] { pictures = cell.eye().pictures; });
  cell.when(
      "reports of all", [&] { return cell.eye().pictures > pictures + 5; },
      [&] {
        const auto now = cell.newest<AttentionGeneration>("generation");
        for (std::size_t i = 0; i < now.members.size(); ++i) {
          CHECK_EQUAL(now.members[i].active, saved.saved_members[i]);
          CHECK(!now.members[i].probation);
          const auto& genes = now.members[i].genes;
          CHECK(!now.members[i].active ||
                std::equal(genes.begin(), genes.end(),
                           saved.saved_genes.begin() + static_cast<std::ptrdiff_t>(i * genes.size())));
        }
      });
  cell.run();
}

/// A file that two runs share, each in a process of its own.
std::string shared_file(const char* name) {
  return "/tmp/flexrf_vision_" + std::string{name} + "_" + std::to_string(getppid());
}

Options with_file(const std::string& file) {
  Options options = in_virtual_time();
  options.configuration_file = file;
  return options;
}

void remove_all(const std::string& file) {
  for (const char* const end : {"", ".previous", ".lock", ".genes"}) std::remove((file + end).c_str());
}

/// Weights, identity and probation belong together: nothing of them outlasts a run by itself, so that no
/// member that went, or has not shown what it is worth, is trusted in the next.
void what_evolves_is_not_kept_by_itself() {
  const std::string file = shared_file("unsaved");
  remove_all(file);
  VisionCell cell(with_file(file));
  cell.when(
      "members that came and went",
      [&] { return cell.evolution().births > 3 && cell.evolution().deaths > 2; }, [] {});
  cell.run();
  CHECK_EQUAL(contents_of(file), "");
  remove_all(file);
}

/// The members' weights as they were saved, for the next run.
void a_saved_generation_is_written() {
  const std::string file = shared_file("saved");
  remove_all(file);
  VisionCell cell(with_file(file));
  AttentionEvolutionRuntime saved{};
  cell.when(
      "some generations", [&] { return cell.evolution().generation == 8; }, [&] { cell.press("save"); });
  cell.when(
      "what was saved",
      [&] {
        saved = cell.newest<AttentionEvolutionRuntime>("evolution.values");
        return std::count(saved.saved_members.begin(), saved.saved_members.end(), true) > 0;
      },
      [] {});
  // Which are not kept.
  cell.when(
      "others", [&] { return cell.evolution().generation == 12; }, [] {});
  cell.run();
  CHECK_CONTAINS(contents_of(file), "saved_genes");
  write_file(file + ".genes", std::string(reinterpret_cast<const char*>(&saved), sizeof(saved)));
}

void the_next_run_begins_with_the_saved_generation() {
  const std::string file = shared_file("saved");
  const std::string bytes = contents_of(file + ".genes");
  AttentionEvolutionRuntime saved{};
  CHECK_EQUAL(bytes.size(), sizeof(saved));
  std::memcpy(&saved, bytes.data(), sizeof(saved));
  VisionCell cell(with_file(file));
  cell.set("evolution", "frozen", true);
  cell.when(
      "reports of all", [&] { return cell.eye().pictures > 30 && !cell.evolution().restoring; },
      [&] {
        const auto now = cell.newest<AttentionGeneration>("generation");
        for (std::size_t i = 0; i < now.members.size(); ++i) {
          CHECK_EQUAL(now.members[i].active, saved.saved_members[i]);
          CHECK(!now.members[i].probation);
          const auto& genes = now.members[i].genes;
          CHECK(!now.members[i].active ||
                std::equal(genes.begin(), genes.end(),
                           saved.saved_genes.begin() + static_cast<std::ptrdiff_t>(i * genes.size())));
        }
      });
  cell.run();
  remove_all(file);
}

/// All but the one that has the weights of the tables.
void what_begins_different_is_on_probation() {
  VisionCell cell;
  cell.set("evolution", "probation_frames", std::uint32_t{100'000});
  cell.when(
      "reports of all", [&] { return cell.eye().pictures > 20; },
      [&] {
        const auto now = cell.newest<AttentionGeneration>("generation");
        CHECK(now.members[0].active && !now.members[0].probation);
        for (std::size_t i = 1; i < now.members.size(); ++i)
          CHECK(!now.members[i].active || now.members[i].probation);
        CHECK(cell.evolution().on_probation > 1);
      });
  cell.run();
}

std::uint64_t digest_of_five_seconds() {
  VisionCell cell;
  cell.when(
      "5 s", [&] { return cell.eye().pictures > 150; }, [] {});
  cell.run();
  return cell.digest();
}

/// An application runs once in a process, so each tells the other by a file that both know.
void the_same_seed_makes_the_same_run() {
  const std::string place = "/tmp/flexrf_vision_digest_" + std::to_string(getppid());
  const std::uint64_t mine = digest_of_five_seconds();
  if (FILE* const before = std::fopen(place.c_str(), "r"); before != nullptr) {
    unsigned long long other = 0;
    const int read = std::fscanf(before, "%llu", &other);
    std::fclose(before);
    std::remove(place.c_str());
    CHECK_EQUAL(read, 1);
    CHECK_EQUAL(other, static_cast<unsigned long long>(mine));
    return;
  }
  FILE* const file = std::fopen(place.c_str(), "w");
  CHECK(file != nullptr);
  std::fprintf(file, "%llu", static_cast<unsigned long long>(mine));
  std::fclose(file);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(what_lies_there_is_followed_and_members_come_and_go),
      TEST_APART(the_member_of_the_target_in_hand_is_left_alone),
      TEST_APART(a_covered_lens_is_told_and_passes),
      TEST_APART(a_person_freezes_saves_and_brings_back),
      TEST_APART(what_evolves_is_not_kept_by_itself),
      TEST_APART(a_saved_generation_is_written),
      TEST_APART(the_next_run_begins_with_the_saved_generation),
      TEST_APART(what_begins_different_is_on_probation),
      TEST_APART(the_same_seed_makes_the_same_run),
      TEST_APART(the_same_seed_makes_the_same_run),
  };
  return cmocka_run_group_tests_name("vision cell", tests, nullptr, nullptr);
}
