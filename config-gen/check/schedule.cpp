// Whether the threads of each CPU role meet their deadlines, judged by declared budgets. Each role is one CPU
// here; at start the same is asked for the CPUs that the machine really gives it.
#include <algorithm>

#include "base/response_time.hpp"
#include "config-gen/check/checks.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

struct Member {
  Index thread = 0;
  PeriodicTask task;
  Nanoseconds deadline = 0;  // at most the period
};

std::string load_text(const Model& model, const std::vector<Member>& members, const Member& late) {
  constexpr std::size_t most_shown = 8;
  std::vector<std::string> loads;
  for (const Member& member : members) {
    if (member.thread != late.thread && member.task.priority < late.task.priority) continue;
    if (loads.size() == most_shown) {
      loads.emplace_back("...");
      break;
    }
    loads.push_back(quote(model.threads[member.thread].name) + " " + duration_text(member.task.execution) +
                    " each " + duration_text(member.task.period) + " at priority " +
                    std::to_string(member.task.priority));
  }
  return join(loads, ", ");
}

}  // namespace

void check_schedule(Model& model, Diagnostics& diagnostics) {
  for (const CpuRole role : {CpuRole::control, CpuRole::io, CpuRole::any}) {
    std::vector<Member> members;
    std::vector<PeriodicTask> tasks;
    for (Index index = 0; index < model.threads.size(); ++index) {
      const Thread& thread = model.threads[index];
      const Nanoseconds interval = interval_of(thread);
      if (thread.priority == 0 || thread.partial || thread.role != role || interval == 0 ||
          thread.demand == 0)
        continue;
      const PeriodicTask task{0, thread.priority, thread.demand, interval, 0};
      members.push_back({index, task, std::min(thread.deadline.value_or(interval), interval)});
      tasks.push_back(task);
    }
    ResponseTimeAnalysis analysis(tasks);
    for (std::size_t i = 0; i < members.size(); ++i) {
      Thread& thread = model.threads[members[i].thread];
      const auto response = analysis.longest_response(i);
      thread.response_time = response;
      if (response && *response <= members[i].deadline) continue;
      const InInstance instance(diagnostics, model, thread.name);
      diagnostics.error(
          thread.position,
          "thread " + quote(thread.name) + " can miss its deadline: response time " +
              (response ? duration_text(*response) : "without bound") + ", deadline " +
              duration_text(members[i].deadline),
          std::string("role '") + name_of(role) + "' carries " + load_text(model, members, members[i]) +
              " (by declared budgets): lower a budget, lengthen a period, or move a thread to another role");
    }
  }
}

}  // namespace flexrf::config_gen
