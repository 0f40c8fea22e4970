// Threads that release each other in a circle through slots and queues.
#include <algorithm>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/ports.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

struct Edge {
  Index to = 0;
  std::string through;
};

std::vector<std::vector<Edge>> releases(const Model& model) {
  std::vector<std::vector<Edge>> edges(model.threads.size());
  const auto add = [&](const Writer& writer, const std::vector<Index>& bells, const std::string& name) {
    const auto from = ports_of(model, writer.owner).thread;
    if (!from) return;
    for (const Index to : bells) edges[*from].push_back({to, name});
  };
  for (const Slot& slot : model.slots)
    if (!slot.doorbells.empty() && slot.writer.position && slot.type.kind == SlotType::Kind::declared)
      add(slot.writer, slot.doorbells, slot.name);
  for (const Queue& queue : model.queues)
    for (const Writer& writer : queue.writers) add(writer, queue.doorbells, queue.declared);
  return edges;
}

// Depth first; every edge back to a thread on the way closes a circle.
class Search {
 public:
  Search(const Model& model, Diagnostics& diagnostics)
      : model_(model),
        diagnostics_(diagnostics),
        edges_(releases(model)),
        state_(model.threads.size(), fresh) {}

  void run() {
    for (Index thread = 0; thread < state_.size(); ++thread)
      if (state_[thread] == fresh) visit(thread);
  }

 private:
  enum State { fresh, open, done };

  void visit(Index thread) {
    state_[thread] = open;
    way_.push_back({thread, ""});
    for (const Edge& edge : edges_[thread]) {
      way_.back().through = edge.through;
      if (state_[edge.to] == open) report(edge.to);
      if (state_[edge.to] == fresh) visit(edge.to);
    }
    way_.pop_back();
    state_[thread] = done;
  }

  void report(Index start) {
    auto first = std::find_if(way_.begin(), way_.end(), [&](const Edge& step) { return step.to == start; });
    std::string path;
    constexpr std::ptrdiff_t most_shown = 12;
    for (auto step = first; step != way_.end() && step - first < most_shown; ++step)
      path += quote(model_.threads[step->to].name) + " -(" + step->through + ")-> ";
    if (way_.end() - first > most_shown) path += "... -> ";
    path += quote(model_.threads[start].name);
    const Thread& thread = model_.threads[start];
    const InInstance instance(diagnostics_, model_, thread.name);
    diagnostics_.warning(thread.trigger_position, "threads release each other in a circle: " + path,
                         "once begun it runs on by itself: trigger one of them by a period, or make sure "
                         "that a unit stops publishing");
  }

  const Model& model_;
  Diagnostics& diagnostics_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<State> state_;
  std::vector<Edge> way_;  // thread, and the slot through which the next is released
};

}  // namespace

void check_cycles(const Model& model, Diagnostics& diagnostics) {
  Search(model, diagnostics).run();
}

}  // namespace flexrf::config_gen
