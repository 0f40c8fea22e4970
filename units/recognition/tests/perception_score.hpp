// What was counted and measured over many pictures, and how it is printed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace flexrf::user {

struct Spread {
  std::vector<double> values;
  void add(double value) { values.push_back(value); }
  double at(double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())))];
  }
};

struct Recall {
  int seen = 0;
  int found = 0;
  double share() const { return seen == 0 ? 1 : static_cast<double>(found) / seen; }
};

/// Of all pictures.
struct Score {
  std::map<std::string, Recall> parts;  // by situation, and by kind
  Recall all;  // single, touching, hidden by less than 40 %, at the border by as much
  Recall obstacles;
  Spread own_position;    // m, as if the camera were where it is told to be
  Spread table_position;  // m, in the arm's frame
  Spread angle;           // rad
  // Of those that the picture shows wholly.
  Spread obstacle_place;
  Spread obstacle_radius;  // m, more than the obstacle's own
  Spread obstacle_bare;    // m, by which the obstacle reaches out of the disc
  Spread piece_place;      // of those that the picture shows in part
  Spread piece_bare;
  // Of those that three or more verdicts showed wholly.
  Spread followed_place;
  Spread followed_height;
  Spread followed_radius;
  Spread picture_time;  // s, of all regions of a picture
  Spread region_time;   // s, of one of attention's
  Spread tracked_time;  // s
  int targets = 0;
  int wrong_targets = 0;  // of a part, with too large an error
  int false_targets = 0;
  int obstacle_verdicts = 0;
  int false_obstacles = 0;
  int cut_obstacles = 0;
  int held_targets = 0;  // of a part in the hand, which is nowhere on the table
  int held_obstacles = 0;
  int pictures = 0;
};

inline void print(Score& score) {
  std::printf("%d pictures\n", score.pictures);
  for (const auto& [name, recall] : score.parts)
    std::printf("  %-16s %5d of %5d  %.2f %%\n", name.c_str(), recall.found, recall.seen,
                100 * recall.share());
  std::printf("  %-16s %5d of %5d  %.2f %%\n", "all", score.all.found, score.all.seen,
              100 * score.all.share());
  std::printf("  targets %d, of them wrong %d, false %d\n", score.targets, score.wrong_targets,
              score.false_targets);
  std::printf("  of the part in the hand: targets %d, obstacles %d\n", score.held_targets,
              score.held_obstacles);
  const auto spread = [](const char* what, Spread& of, double unit, const char* name) {
    std::printf("  %-34s median %7.2f  95 %% %7.2f  99 %% %7.2f  most %7.2f %s\n", what, of.at(0.5) / unit,
                of.at(0.95) / unit, of.at(0.99) / unit, of.at(1) / unit, name);
  };
  spread("position, as the camera is told", score.own_position, 1e-3, "mm");
  spread("position, in the arm's frame", score.table_position, 1e-3, "mm");
  spread("angle", score.angle, std::numbers::pi / 180, "degrees");
  std::printf("  obstacles %d of %d, verdicts %d, of them false %d, cut %d\n", score.obstacles.found,
              score.obstacles.seen, score.obstacle_verdicts, score.false_obstacles, score.cut_obstacles);
  spread("obstacle's place", score.obstacle_place, 1e-3, "mm");
  spread("obstacle's radius, beyond its own", score.obstacle_radius, 1e-3, "mm");
  spread("obstacle, out of its disc", score.obstacle_bare, 1e-3, "mm");
  spread("piece of an obstacle: place", score.piece_place, 1e-3, "mm");
  spread("piece of an obstacle, out of its disc", score.piece_bare, 1e-3, "mm");
  spread("followed: place", score.followed_place, 1e-3, "mm");
  spread("followed: height", score.followed_height, 1e-3, "mm");
  spread("followed: radius, beyond its own", score.followed_radius, 1e-3, "mm");
  spread("processor, all regions of a picture", score.picture_time, 1e-3, "ms");
  spread("processor, a region of attention", score.region_time, 1e-3, "ms");
  spread("processor, a tracked region", score.tracked_time, 1e-3, "ms");
}

}  // namespace flexrf::user
