// What the simulated scene costs: a picture of it, and a step of its world.
#include <cmath>

#include "benchmarks/harness.hpp"
#include "hal/scene/renderer/scene_renderer.hpp"
#include "hal/scene/world/tabletop_world.hpp"

namespace flexrf::bench {
namespace {

constexpr double half_turn = 3.14159265358979323846;

/// Over the middle of the parts, downwards.
Eigen::Isometry3d hand_at(double x, double y, double height) {
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.linear() = turn_about(Eigen::Vector3d::UnitX(), half_turn);
  tool.translation() = Eigen::Vector3d(x, y, height);
  return tool;
}

/// As SceneCamera sits on a hand.
Eigen::Isometry3d eye_of(const Eigen::Isometry3d& tool) {
  Eigen::Isometry3d eye = Eigen::Isometry3d::Identity();
  eye.linear() = turn_about(Eigen::Vector3d::UnitZ(), half_turn / 2);
  eye.translation() = Eigen::Vector3d(0.05, 0, 0.05);
  return tool * eye;
}

Row row_of(const char* what, int blocks, double goal, auto&& run) {
  std::vector<double> values;
  for (int block = 0; block < blocks; ++block) values.push_back(run());
  return {
      .what = what, .unit = "ns", .value = estimate(values), .goal = goal, .has_goal = goal > 0, .note = ""};
}

int measure(int argument_count, char** arguments) {
  Report report("scene", argument_count, arguments);
  const int blocks = report.choose(40, 8);
  settle_thread(0, 0);
  TabletopWorld world;
  world.begin(HandModel{}, 1);
  SceneRenderer renderer;
  renderer.begin(RendererPlan{});
  std::vector<std::uint8_t> picture(std::size_t{640} * 480 * 3);
  std::uint64_t frame = 0;
  const auto picture_from = [&](double height) {
    return nanoseconds_per_call(report.choose(25, 10), [&] {
      const Eigen::Isometry3d tool =
          hand_at(0.45, 0.05 * std::sin(0.1 * static_cast<double>(++frame)), height);
      renderer.draw(world.state(), eye_of(tool), tool, frame, picture);
      touch(picture.data());
    });
  };
  report.add(
      row_of("picture of a laid table, 640x480, from 0.5 m", blocks, 6e6, [&] { return picture_from(0.5); }));
  report.add(row_of("picture of a part from near, 640x480, from 0.2 m", blocks, 6e6,
                    [&] { return picture_from(0.2); }));
  std::uint64_t step = 0;
  report.add(row_of("step of the world, the hand pushing through parts at 0.2 m/s", blocks, 0, [&] {
    return nanoseconds_per_call(report.choose(200, 50), [&] {
      const double way = 0.0014 * static_cast<double>(++step % 300);
      HandState hand;
      hand.tool = hand_at(0.45, -0.2 + way, 0.165);
      hand.opening = 0.06;
      world.step(hand);
    });
  }));
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::measure(argument_count, arguments);
}
