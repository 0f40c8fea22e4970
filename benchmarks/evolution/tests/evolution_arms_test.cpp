// What the arms of the benchmark `evolution` are judged by, and that they are driven as they shall be.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "benchmarks/evolution/arms.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::bench;

template <bool (*is_true)()>
void judged(void**) {
  assert_true(is_true());
}

user::VisionRegion region_of(std::uint16_t left, std::uint16_t top, std::uint16_t side) {
  user::VisionRegion region{};
  region.left = left;
  region.top = top;
  region.width = region.height = side;
  return region;
}

bool overlap_is_what_both_cover_of_what_they_cover() {
  const SeenBody body{100, 100, 160, 160};
  return body.overlap(region_of(100, 100, 60)) == 1 && body.overlap(region_of(200, 100, 60)) == 0 &&
         std::abs(body.overlap(region_of(130, 100, 60)) - 1.0 / 3) < 1e-12 &&
         std::abs(body.overlap(region_of(100, 100, 120)) - 0.25) < 1e-12;
}

struct Picture {
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(std::size_t{640} * 480 * 3);
  /// Mean of a channel.
  double mean(std::size_t channel) const {
    double sum = 0;
    for (std::size_t i = channel; i < pixels.size(); i += 3) sum += pixels[i];
    return sum / (640 * 480);
  }
  /// Part of a box that is no table: strongly coloured, or far darker than it.
  double covered(const SeenBody& box) const {
    double count = 0;
    double all = 0;
    for (auto row = static_cast<std::size_t>(box.top); row < static_cast<std::size_t>(box.bottom); ++row)
      for (auto column = static_cast<std::size_t>(box.left); column < static_cast<std::size_t>(box.right);
           ++column) {
        const std::uint8_t* const pixel = &pixels[(row * 640 + column) * 3];
        const int most = std::max({pixel[0], pixel[1], pixel[2]});
        const int least = std::min({pixel[0], pixel[1], pixel[2]});
        ++all;
        if (most - least > 45 || most < 82) ++count;
      }
    return all > 0 ? count / all : 0.0;
  }
};

bool boxes_are_where_the_picture_shows_something() {
  const auto view = std::make_unique<ScriptedView>();
  Picture picture;
  int boxes = 0;
  for (const std::uint64_t seed : {3U, 4U}) {
    view->begin(seed);
    for (const std::uint64_t at : {100U, 400U, 700U}) {
      view->draw(at, picture.pixels);
      for (const SeenBody& box : view->look(at)) {
        ++boxes;
        if (box.left < 0 || box.right > 640 || box.top < 0 || box.bottom > 450) return false;
        // An L fills little of its box; a bare table has hardly any such pixel.
        if (picture.covered(box) < 0.3) return false;
      }
    }
  }
  return boxes > 20;
}

/// On the way there is always something to be seen, and never all at once from near.
bool the_path_shows_much_and_not_always_the_same() {
  const auto view = std::make_unique<ScriptedView>();
  view->begin(5);
  std::size_t least = 100;
  std::size_t most = 0;
  double sum = 0;
  for (std::uint64_t picture = 1; picture <= pictures_of_a_run; picture += 10) {
    const std::size_t count = view->look(picture).size();
    least = std::min(least, count);
    most = std::max(most, count);
    sum += static_cast<double>(count);
  }
  return least >= 1 && most <= 16 && most > least + 3 && sum / 300 > 6;
}

bool at_100_s_it_is_darker_and_warmer() {
  const auto view = std::make_unique<ScriptedView>();
  view->begin(5);
  Picture before;
  Picture after;
  view->draw(change_at - 1, before.pixels);
  view->draw(change_at, after.pixels);
  return after.mean(1) < 0.6 * before.mean(1) &&
         after.mean(0) / after.mean(2) > 1.25 * before.mean(0) / before.mean(2);
}

bool regions_count_by_their_overlap_and_cost_by_declaration() {
  const auto view = std::make_unique<SharedView>();
  view->begin(3);
  Population population(*view, {});
  population.set(0, genes_of_table());
  population.set(1, genes_of_table(), 7, true);
  view->next(Time{std::chrono::seconds(1)});
  population.look();
  const user::AttentionReport report = population.report(0);
  if (report.count < 3 || report.regions[0].frame != 1) return false;
  std::vector<SeenBody> bodies;
  const auto body_at = [&](std::size_t region, double narrower) {
    const user::VisionRegion& of = report.regions[region];
    const double side = of.width;
    bodies.push_back({of.left + 0.0, of.top + 0.0, of.left + side * narrower, of.top + side});
  };
  body_at(0, 1);
  body_at(1, 0.52);
  body_at(2, 0.3);
  Tally tally;
  population.judge(bodies, tally);
  double cost = user::values_of_features + report.pixels;
  for (std::uint32_t i = 0; i < report.count; ++i)
    cost += user::values_per_region + std::pow(report.regions[i].width, 2);
  // Both members found two each; the one on probation is trusted with nothing.
  if (tally.objects != 4 || tally.cost != 2 * cost || tally.found != 2 || tally.seen != 3) return false;
  population.retire(0);
  Tally of_probation;
  population.judge(bodies, of_probation);
  return of_probation.objects == 2 && of_probation.found == 0;
}

bool random_members_are_within_the_declared_ranges() {
  user::RandomSource random(1);
  const auto ranges = declared_ranges();
  bool is_whole = true;
  double least = 1;
  double most = -1;
  for (int i = 0; i < 200; ++i) {
    const user::Genes genes = any_genes(random);
    for (std::size_t k = 0; k < genes.size(); ++k)
      if (genes[k] < ranges[k].lowest || genes[k] > ranges[k].highest) return false;
    is_whole = is_whole && genes[user::gene_regions] == std::floor(genes[user::gene_regions]);
    least = std::min(least, genes[user::gene_colour]);
    most = std::max(most, genes[user::gene_colour]);
  }
  return is_whole && least < -0.9 && most > 0.9;
}

bool the_recogniser_judges_and_the_coin_needs_none() {
  const auto view = std::make_unique<SharedView>();
  view->begin(3);
  const std::array<user::Genes, 2> members{genes_of_table(), genes_of_table()};
  user::EvolutionRules rules;
  rules.wanted = 4;
  rules.generation_frames = rules.probation_frames = 10;
  const auto arm = std::make_unique<ChangingArm>(*view, members, rules, Judge::recogniser, 1);
  const auto tossed = std::make_unique<ChangingArm>(*view, members, rules, Judge::coin, 1);
  Time now{std::chrono::seconds(1)};
  for (std::uint64_t picture = 1; picture <= 40; ++picture) {
    now += picture_period;
    view->next(now);
    arm->step(picture, false);
    tossed->step(picture, false);
  }
  const user::Evolution::Member& one = arm->evolution().member(0);
  const auto active = [](const ChangingArm& of) {
    int count = 0;
    for (std::size_t i = 0; i < Population::most; ++i) count += of.population().is_active(i) ? 1 : 0;
    return count;
  };
  return one.frames == 40 && one.objects > 20 && one.cost > 1e6 && active(*arm) > 2 && active(*tossed) > 2 &&
         tossed->population().report(0).frame == 0;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<overlap_is_what_both_cover_of_what_they_cover>),
      cmocka_unit_test(judged<boxes_are_where_the_picture_shows_something>),
      cmocka_unit_test(judged<the_path_shows_much_and_not_always_the_same>),
      cmocka_unit_test(judged<at_100_s_it_is_darker_and_warmer>),
      cmocka_unit_test(judged<regions_count_by_their_overlap_and_cost_by_declaration>),
      cmocka_unit_test(judged<random_members_are_within_the_declared_ranges>),
      cmocka_unit_test(judged<the_recogniser_judges_and_the_coin_needs_none>),
  };
  return cmocka_run_group_tests_name("arms of the benchmark evolution", tests, nullptr, nullptr);
}
