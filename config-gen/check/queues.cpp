// Queues: writers and readers, sharing, order, types.
#include "config-gen/check/checks.hpp"
#include "config-gen/model/ports.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

void check_reader(const Model& model, const Queue& queue, const InputReference& input,
                  Diagnostics& diagnostics) {
  const PortSet ports = ports_of(model, input.owner);
  const InInstance instance(diagnostics, model, ports.name);
  const InputPort& port = ports.inputs[input.port];
  const std::string& wanted = model.types[port.type].name;
  if (queue.writers.empty()) {
    std::vector<std::string> known;
    for (const Queue& other : model.queues)
      if (!other.writers.empty() && other.type == port.type) known.push_back(other.declared);
    diagnostics.error(
        input.position,
        "nobody writes queue " + quote(queue.declared) + ", which " + describe(model, input) + " reads",
        suggest(queue.declared, known, "queues of " + wanted,
                "connect an output with queue = \"" + wanted + "\" to it")
            .doubted("the output that writes " + quote(queue.declared) + " may be what is missing"));
  } else if (port.type != queue.type) {
    diagnostics.error(input.position,
                      describe(model, input) + " takes " + wanted + ", but queue " + quote(queue.declared) +
                          " carries " + model.types[queue.type].name,
                      describe(model, queue.writers.front()) + ", connected at " +
                          to_string(queue.writers.front().position) + ", is declared as " +
                          model.types[queue.type].name + " at " +
                          to_string(declared_at(model, queue.writers.front())) +
                          "; the input is declared at " + to_string(port.type_position));
  }
}

void check_writer(const Model& model, const Queue& queue, const Writer& writer, Diagnostics& diagnostics) {
  const Index type = ports_of(model, writer.owner).outputs[writer.port].type;
  if (type == queue.type) return;
  diagnostics.error(writer.position,
                    describe(model, writer) + " gives " + model.types[type].name + ", but queue " +
                        quote(queue.declared) + " carries " + model.types[queue.type].name,
                    describe(model, queue.writers.front()) + ", connected at " +
                        to_string(queue.writers.front().position) + ", is declared as " +
                        model.types[queue.type].name + " at " +
                        to_string(declared_at(model, queue.writers.front())) +
                        "; this output is declared at " + to_string(declared_at(model, writer)));
}

}  // namespace

void check_queues(const Model& model, Diagnostics& diagnostics) {
  for (const Queue& queue : model.queues) {
    if (queue.partial) continue;
    for (const Writer& writer : queue.writers) check_writer(model, queue, writer, diagnostics);
    for (const InputReference& reader : queue.readers) check_reader(model, queue, reader, diagnostics);
    const InInstance instance(diagnostics, model, queue.declared);
    if (queue.readers.empty() && queue.doorbells.empty())
      diagnostics.warning(queue.writers.front().position, "queue " + quote(queue.declared) + " is never read",
                          "connect an input to it: it fills up and then drops every item");
    const auto readers = readers_at_work(queue);
    if (readers.size() > 1 && !queue.jobs)
      diagnostics.error(readers[1].front().position,
                        "queue " + quote(queue.declared) + " has " + std::to_string(readers.size()) +
                            " readers: " + describe(model, readers[0].front()) + " and " +
                            describe(model, readers[1].front()) + (readers.size() > 2 ? " and others" : ""),
                        "say in [queue." + queue.declared.substr(queue.declared.rfind('.') + 1) +
                            "] share = \"copies\" if each shall get every item, or share = \"jobs\" if each "
                            "item is for one of them");
    if (queue.score && !queue.jobs)
      diagnostics.error(
          queue.position,
          "queue " + quote(queue.declared) + " is ordered by a score, but its items are not shared as jobs",
          "add share = \"jobs\", or remove 'order'");
    if (queue.jobs && queue.policy == Queue::Policy::drop_oldest)
      diagnostics.error(queue.position,
                        "queue " + quote(queue.declared) + " shares jobs, and cannot drop the oldest",
                        "remove 'policy': a full pool refuses the newest item, or by score drops the lowest");
  }
}

}  // namespace flexrf::config_gen
