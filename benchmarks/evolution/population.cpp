#include "benchmarks/evolution/population.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace flexrf::bench {
namespace {

using user::Genes;

user::AttentionRuntime with(user::AttentionRuntime runtime, const Genes& genes) {
  using namespace user;
  runtime.colour = genes[gene_colour];
  runtime.contrast = genes[gene_contrast];
  runtime.motion = genes[gene_motion];
  runtime.size = genes[gene_size];
  runtime.edges = genes[gene_edges];
  runtime.expectation = genes[gene_expectation];
  runtime.spacing = genes[gene_spacing];
  runtime.smallest = genes[gene_smallest];
  runtime.selectivity = genes[gene_selectivity];
  runtime.regions = static_cast<std::uint32_t>(genes[gene_regions]);
  return runtime;
}

}  // namespace

void SharedView::next(Time now) {
  ++picture_;
  CameraFrame& frame = frames_.frame();
  frame.width = user::picture_width;
  frame.height = user::picture_height;
  frame.stride = user::picture_row_bytes;
  frame.size = frame.stride * frame.height;
  frame.format = PixelFormat::rgb24;
  view_.draw(picture_, frame.data().first(frame.size));
  tool_poses_.publish(view_.tool_at(picture_), now);
  frames_.publish(picture_, now);
  SlotControl& slot = features_.control();
  const std::uint8_t buffer = slot.loan();
  auto& features = *reinterpret_cast<user::VisualFeatures*>(slot.payload(buffer));
  extractor_.extract(frame.data().data(), frame.stride, features);
  constexpr user::PixelRectangle hand{0, 450, 640, 30};
  light_.look({frame.data().data(), frame.stride, user::picture_width, user::picture_height}, hand);
  light_.tell(features);
  features.frame = picture_;
  features.time = nanoseconds(now);
  slot.publish(buffer, now);
  seen_ = view_.look(picture_);
}

Population::Population(SharedView& view, std::span<QueueSink* const> sinks) {
  for (auto& member : members_) {
    member = std::make_unique<Member>();
    InputBinding inputs[3] = {view.features_of_attention(), {}, {}};
    SlotControl* outputs[1] = {&member->report.control()};
    std::span<QueueSink* const> queues[1] = {sinks};
    UnitBinding binding;
    binding.context = &member->bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.queue_outputs = queues;
    member->bench.unit().connect(binding);
    static constexpr const char* names[most] = {
        "attention[0]", "attention[1]", "attention[2]", "attention[3]", "attention[4]",
        "attention[5]", "attention[6]", "attention[7]", "attention[8]", "attention[9]"};
    member->bench.unit().set_name(names[&member - members_.data()]);
    if (member->bench.unit().initialise().is_ok()) continue;
    std::fprintf(stderr, "evolution: a member of attention was not initialised\n");
    std::exit(1);
  }
}

void Population::set(std::size_t member, const Genes& genes, std::uint32_t identity, bool probation) {
  Member& one = *members_[member];
  one.bench.runtime() = with({}, genes);
  one.bench.runtime().identity = identity;
  one.bench.runtime().probation = probation;
  one.told.identity = identity;
  one.told.probation = probation;
  one.told.genes = genes;
  if (!one.active) one.bench.unit().reset();
  one.active = true;
}

void Population::look() {
  for (const auto& member : members_) {
    if (!member->active) continue;
    member->bench.step(picture_period);
    if (const auto told = member->report.latest()) member->told = *told;
  }
}

void Population::judge(std::span<const SeenBody> seen, Tally& tally) const {
  constexpr double holds = 0.5;
  std::bitset<ScriptedView::most_seen> of_all;
  for (const auto& member : members_) {
    if (!member->active) continue;
    const user::AttentionReport& report = member->told;
    std::bitset<ScriptedView::most_seen> found;
    tally.cost += user::values_of_features + report.pixels;
    for (std::uint32_t i = 0; i < report.count; ++i) {
      const user::VisionRegion& region = report.regions[i];
      tally.cost += user::values_per_region + static_cast<double>(region.width) * region.height;
      for (std::size_t k = 0; k < seen.size(); ++k)
        if (seen[k].overlap(region) >= holds) found.set(k);
    }
    tally.objects += static_cast<double>(found.count());
    if (!report.probation) of_all |= found;
  }
  tally.found += static_cast<double>(of_all.count());
  tally.seen += static_cast<double>(seen.size());
}

std::array<user::GeneRange, user::gene_count> declared_ranges() {
  std::array<user::GeneRange, user::gene_count> ranges{};
  for (const ParameterDescriptor& parameter : user::attention_unit_component.runtime.parameters)
    for (std::size_t i = 0; i < user::gene_count; ++i)
      if (user::gene_names[i] == parameter.field->name)
        ranges[i] = {parameter.minimum, parameter.maximum, parameter.field->scalar == Scalar::u32};
  return ranges;
}

Genes genes_of_table() {
  const user::AttentionRuntime of;
  return {of.colour,      of.contrast, of.motion,   of.size,        of.edges,
          of.expectation, of.spacing,  of.smallest, of.selectivity, static_cast<double>(of.regions)};
}

Genes any_genes(user::RandomSource& random) {
  const auto ranges = declared_ranges();
  Genes genes{};
  for (std::size_t i = 0; i < genes.size(); ++i) {
    const user::GeneRange& range = ranges[i];
    const double above = range.is_whole ? range.highest - range.lowest + 1 : range.highest - range.lowest;
    genes[i] = range.lowest + random.uniform() * above;
    if (range.is_whole) genes[i] = std::floor(genes[i]);
  }
  return genes;
}

}  // namespace flexrf::bench
