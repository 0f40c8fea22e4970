// Slots, readers and queues of a generated application: control blocks, buffers and records.
#include <algorithm>

#include "config-gen/emit/application_parts.hpp"
#include "config-gen/emit/component.hpp"
#include "config-gen/emit/plain_struct.hpp"
#include "config-gen/model/layout.hpp"

namespace flexrf::config_gen {
namespace {

// One array per set of doorbells, for many slots ring the same threads.
class Bells {
 public:
  Bells(const ApplicationNames& names, std::string prefix, Text& out)
      : names_(names), prefix_(std::move(prefix)), out_(out) {}

  std::string of(const std::vector<Index>& threads) {
    if (threads.empty()) return "{}";
    const auto [entry, is_new] = known_.try_emplace(threads);
    if (is_new) {
      entry->second = prefix_ + std::to_string(known_.size() - 1);
      out_ << "Doorbell* const " << entry->second << "[] = {"
           << list_of(threads, [&](Index thread) { return "&bell_" + names_.thread(thread); }) << "};\n";
    }
    return entry->second;
  }

 private:
  const ApplicationNames& names_;
  std::string prefix_;
  Text& out_;
  std::map<std::vector<Index>, std::string> known_;
};

void emit_jobs(const Model& model, const ApplicationNames& names, Index index, const std::string& bells,
               Text& out, std::vector<std::string>& sizes) {
  const Queue& queue = model.queues[index];
  const Type& type = model.types[queue.type];
  const std::string& name = names.queue(index);
  std::string order = "{}";
  if (queue.score) {
    const Field& field = type.fields[*queue.score];
    order = "{true, Scalar::" + scalar_of(model, field.type) + ", " + std::to_string(field.offset) + "}";
  }
  const std::string cpp_name = application_space.of(type, type.name);
  out << "constinit JobQueueMemory<" << cpp_name << ", " << queue.capacity << "> queue_" << name
      << "_memory{};\n"
      << "constinit JobQueue queue_" << name << "{descriptor_of<" << cpp_name << ">, queue_" << name
      << "_memory.view(), DropPolicy::"
      << (queue.policy == Queue::Policy::drop_newest ? "drop_newest" : "drop_oldest") << ", " << order << ", "
      << bells << "};\n";
  for (std::size_t i = 0; i < queue.writers.size(); ++i) {
    out << "constinit JobSink sink_" << name << "_" << i << "{&queue_" << name << "};\n";
  }
  sizes.push_back("sizeof(queue_" + name + "_memory)");
}

void emit_rings(const Model& model, const ApplicationNames& names, Index index, const std::string& bells,
                Text& out, std::vector<std::string>& sizes) {
  const Queue& queue = model.queues[index];
  const std::string type = application_space.of(model.types[queue.type], model.types[queue.type].name);
  const std::string& name = names.queue(index);
  for (std::size_t i = 0; i < queue.writers.size(); ++i) {
    const std::string ring = name + "_" + std::to_string(i);
    out << "constinit QueueRingMemory<" << type << ", " << queue.capacity << "> ring_" << ring
        << "_memory{};\n"
        << "constinit QueueRing ring_" << ring << "{descriptor_of<" << type << ">, ring_" << ring
        << "_memory.view(), DropPolicy::"
        << (queue.policy == Queue::Policy::drop_newest ? "drop_newest" : "drop_oldest") << ", " << bells
        << "};\n";
    sizes.push_back("sizeof(ring_" + ring + "_memory)");
  }
  if (queue.writers.size() == 1) return;
  std::string rings;
  for (std::size_t i = 0; i < queue.writers.size(); ++i) {
    rings += (i == 0 ? "" : ", ") + names.sink(index, i);
  }
  emit_array("QueueRing* const", "queue_" + name + "_rings", rings, out);
  out << "constinit RingSet queue_" << name << "{descriptor_of<" << type << ">, "
      << array_or_none("queue_" + name + "_rings", rings) << "};\n";
}

// Of a slot whose row gives its items another size than usual, a descriptor of its own.
std::string define_slot_descriptor(const Model& model, const Slot& slot, const std::string& name, Text& out) {
  const std::string usual = "descriptor_of<" + slot_type(model, slot) + ">";
  if (slot.elements == 0) return usual;
  const Type& type = model.types[slot.type.index];
  Field resized = *type.resizable();
  if (slot.elements == resized.elements()) return usual;
  resized.shape = {slot.elements};
  lay_out(model, resized);
  PlainStruct plain = plain_struct(model, type);
  plain.identifier = "slot_" + name;
  plain.size = slot.payload_size;
  plain.fields.back().field = &resized;
  define_descriptor_alone(model, plain, application_space, out);
  return "&slot_" + name + "_descriptor";
}

}  // namespace

std::string slot_type(const Model& model, const Slot& slot) {
  const std::string name = type_name(model, slot.type);
  switch (slot.type.kind) {
    case SlotType::Kind::unit_runtime:
    case SlotType::Kind::unit_feedback:
      return application_space.of(model.unit_types[slot.type.index], name);
    case SlotType::Kind::interface_runtime:
    case SlotType::Kind::interface_feedback:
      return application_space.of(model.interfaces[slot.type.index], name);
    case SlotType::Kind::driver_runtime:
    case SlotType::Kind::driver_feedback:
      return application_space.of(model.drivers[slot.type.index], name);
    case SlotType::Kind::declared:
      break;
  }
  return application_space.of(model.types[slot.type.index], name);
}

void emit_slots(const Model& model, const ApplicationNames& names, Text& out,
                std::vector<std::string>& sizes) {
  if (model.slots.empty()) return;
  out << "\n// ---- Slots: buffers, then the control block\n\n";
  Bells bells(names, "bells_of_slots_", out);
  for (Index i = 0; i < model.slots.size(); ++i) {
    const Slot& slot = model.slots[i];
    const std::string type = slot_type(model, slot);
    const std::string& name = names.slot(i);
    const std::string rung = bells.of(slot.doorbells);
    const bool triple = slot.reader_count == 1 && slot.loans == 1;
    std::string history;
    if (slot.history > 0) {
      out << "constinit HistoryMemory<" << type << ", " << slot.history << "> slot_" << name
          << "_history_memory{};\n"
          << "constinit History slot_" << name << "_history{descriptor_of<" << type << ">, slot_" << name
          << "_history_memory.words, " << slot.history << "};\n";
      history = ", &slot_" + name + "_history";
      sizes.push_back("sizeof(slot_" + name + "_history_memory)");
    }
    const std::string descriptor = define_slot_descriptor(model, slot, name, out);
    if (slot.elements > 0) {
      out << "constinit SizedSlotMemory<" << type << ", " << slot.buffers() << ", " << slot.elements << ">";
    } else {
      out << "constinit SlotMemory<" << type << ", " << slot.buffers() << ">";
    }
    out << " slot_" << name << "_memory{};\n"
        << "constinit SlotControl slot_" << name << "{" << descriptor << ", slot_" << name << "_memory.view("
        << slot.loans << ", " << bool_literal(triple) << ")"
        << (rung == "{}" && history.empty() ? "" : ", " + rung) << history << "};\n";
    sizes.push_back("sizeof(slot_" + name + "_memory)");
  }
}

void emit_readers(const Model& model, const ApplicationNames& names, Text& out) {
  const auto emit = [&](const std::string& array, const std::vector<Index>& slots) {
    if (slots.empty()) return;
    out << "alignas(cache_line) constinit SlotReader " << array << "[] = {\n";
    for (const Index slot : slots) out << "    SlotReader{&slot_" << names.slot(slot) << "},\n";
    out << "};\n";
  };
  out << "\n// ---- Readers: one per thread and slot, more for held inputs; one per slot for the "
         "observer\n\n";
  for (Index i = 0; i < model.threads.size(); ++i) emit("readers_" + names.thread(i), names.readers(i));
  emit("observers", names.observers());
}

void emit_queues(const Model& model, const ApplicationNames& names, Text& out,
                 std::vector<std::string>& sizes) {
  if (model.queues.empty()) return;
  out << "\n// ---- Queues\n\n";
  Bells bells(names, "bells_of_queues_", out);
  for (Index i = 0; i < model.queues.size(); ++i) {
    const std::string rung = bells.of(model.queues[i].doorbells);
    if (model.queues[i].jobs) {
      emit_jobs(model, names, i, rung, out, sizes);
    } else {
      emit_rings(model, names, i, rung, out, sizes);
    }
  }
}

void emit_slot_records(const Model& model, const ApplicationNames& names, Text& out) {
  if (model.slots.empty()) return;
  out << "\nconstexpr SlotRecord slots_table[] = {\n";
  for (Index i = 0; i < model.slots.size(); ++i) {
    const Slot& slot = model.slots[i];
    out << "    {\"" << slot.name << "\", " << string_literal(slot.summary) << ", &slot_" << names.slot(i)
        << ", " << names.observer_of(i) << ", \"" << writer_text(model, slot.writer) << "\", "
        << bool_literal(slot.wall) << "},\n";
  }
  out << "};\n";
}

void emit_queue_records(const Model& model, const ApplicationNames& names, Text& out) {
  if (model.queues.empty()) return;
  Text records;
  for (Index i = 0; i < model.queues.size(); ++i) {
    const Queue& queue = model.queues[i];
    const std::string& name = names.queue(i);
    std::string sinks, writers, sources, readers;
    for (std::size_t k = 0; k < queue.writers.size(); ++k) {
      sinks += (k == 0 ? "" : ", ") + names.sink(i, k);
      writers += (k == 0 ? "\"" : ", \"") + writer_text(model, queue.writers[k]) + "\"";
    }
    for (const std::string& reader : reader_texts(model, queue.readers)) {
      sources += (sources.empty() ? "" : ", ") + names.source(i);
      readers += (readers.empty() ? "\"" : ", \"") + reader + "\"";
    }
    emit_array("QueueSink* const", "queue_" + name + "_sinks", sinks, out);
    emit_array("constexpr const char*", "queue_" + name + "_writers", writers, out);
    emit_array("QueueSource* const", "queue_" + name + "_sources", sources, out);
    emit_array("constexpr const char*", "queue_" + name + "_readers", readers, out);
    records << "    {\"" << queue.name << "\", " << string_literal(queue.summary) << ", descriptor_of<"
            << application_space.of(model.types[queue.type], model.types[queue.type].name) << ">, "
            << queue.capacity << ", " << array_or_none("queue_" + name + "_sinks", sinks) << ", "
            << array_or_none("queue_" + name + "_writers", writers) << ", "
            << array_or_none("queue_" + name + "_sources", sources) << ", "
            << array_or_none("queue_" + name + "_readers", readers) << ", " << bool_literal(queue.wall)
            << "},\n";
  }
  out << "\nconstexpr QueueRecord queues_table[] = {\n" << records.str() << "};\n";
}

}  // namespace flexrf::config_gen
