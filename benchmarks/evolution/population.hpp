// Members of attention before a scripted view, and how they are judged by what there truly is to be seen.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "benchmarks/evolution/scripted_view.hpp"
#include "units/attention/attention.hpp"
#include "units/vision/evolution.hpp"
#include "units/vision/tests/light_meter.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace flexrf::bench {

/// One run's pictures and features, which all arms share.
class SharedView {
 public:
  void begin(std::uint64_t seed) { view_.begin(seed); }
  /// Draws the next picture, makes its features, and publishes both.
  void next(Time now);

  std::uint64_t picture() const noexcept { return picture_; }
  std::span<const SeenBody> seen() const noexcept { return seen_; }
  InputBinding features_of_attention() noexcept { return {&attention_, 1, {}, nullptr}; }
  InputBinding features_of_recognition() noexcept { return {&recognition_, 1, {}, nullptr}; }
  InputBinding frames() { return frames_.input(); }
  InputBinding tool_poses() { return tool_poses_.input(); }

 private:
  ScriptedView view_;
  user::FeatureExtractor extractor_;
  user::LightMeter light_;
  Slot<user::VisualFeatures, 2> features_;
  SlotReader attention_{&features_.control()};
  SlotReader recognition_{&features_.control()};
  user::FrameBench frames_;
  user::HistoryBench<Pose, 8> tool_poses_;
  std::span<const SeenBody> seen_;
  std::uint64_t picture_ = 0;
};

/// What an arm did over some pictures.
struct Tally {
  double objects = 0;  ///< distinct ones in each picture that a member's regions held, all members'
  double cost = 0;     ///< declared, of all members, in values
  double found = 0;    ///< distinct ones in each picture, of all trusted members together
  double seen = 0;     ///< that were to be found

  double per_cost() const noexcept { return cost > 0 ? 1e6 * objects / cost : 0; }
  double recall() const noexcept { return seen > 0 ? found / seen : 0; }
};

class Population {
 public:
  static constexpr std::size_t most = 10;

  /// `sinks`: where jobs go; may be empty.
  Population(SharedView& view, std::span<QueueSink* const> sinks);

  void set(std::size_t member, const user::Genes& genes, std::uint32_t identity = 0, bool probation = false);
  void retire(std::size_t member) { members_[member]->active = false; }
  /// All active members look at the newest picture.
  void look();

  bool is_active(std::size_t member) const { return members_[member]->active; }
  /// Of the newest picture that it looked at; who it is now in any case.
  const user::AttentionReport& report(std::size_t member) const { return members_[member]->told; }
  /// A region holds a body if their overlap is 0.5 or more.
  void judge(std::span<const SeenBody> seen, Tally& tally) const;

 private:
  struct Member {
    UnitBench<user::Attention> bench;
    SlotBench<user::AttentionReport> report;
    user::AttentionReport told{};
    bool active = false;
  };
  std::array<std::unique_ptr<Member>, most> members_;
};

/// Of the weights of attention, as its table declares them.
std::array<user::GeneRange, user::gene_count> declared_ranges();
/// As its table has them: tuned by hand.
user::Genes genes_of_table();
/// Evenly over the declared ranges.
user::Genes any_genes(user::RandomSource& random);

}  // namespace flexrf::bench
