// The symbols of a generated application, and where each input finds its reader. Everything lies in
// flexrf::application; a prefix says what it is, so that a name of the tables can never hide one of C++.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "config-gen/emit/text.hpp"
#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

class ApplicationNames {
 public:
  ApplicationNames(const Model& model, Diagnostics& diagnostics);

  const std::string& slot(Index slot) const { return slots_[slot]; }  // tool_pose
  const std::string& queue(Index queue) const { return queues_[queue]; }
  const std::string& unit(Index unit) const { return units_[unit]; }
  const std::string& device(Index device) const { return devices_[device]; }
  const std::string& thread(Index thread) const { return threads_[thread]; }

  // The first reader of an input, "&readers_control[3]". An input with several slots has one per slot from
  // there on.
  std::string reader_of(const PortOwner& owner, Index port) const;
  // The slots that a thread's readers read, in the order of its array.
  const std::vector<Index>& readers(Index thread) const { return readers_[thread]; }
  // Slots with an observer, in slot order, and the place of each in the array of observers.
  const std::vector<Index>& observers() const { return observers_; }
  std::string observer_of(Index slot) const;  // "&observers[3]" or "nullptr"

  // A writer's way into a queue and the readers' way out, as pointers.
  std::string sink(Index queue, std::size_t writer) const;  // "&ring_keys_0"
  std::string source(Index queue) const;                    // "&ring_keys_0", "&queue_keys"
  // The sinks of one output, one per queue that it fans out to.
  std::string sinks_of(const OutputConnection& output, const PortOwner& owner, Index port) const;

 private:
  const Model& model_;
  void place_readers(Index thread, Diagnostics& diagnostics);

  std::vector<std::string> slots_, queues_, units_, devices_, threads_;
  std::vector<std::vector<Index>> readers_;
  std::map<std::pair<PortOwner, Index>, std::pair<Index, std::size_t>> places_;  // port: thread, place
  std::vector<Index> observers_;
  std::map<Index, std::size_t> observer_places_;
};

// "jog.target"; "" for what the executive writes on behalf of a unit or device.
std::string writer_text(const Model& model, const Writer& writer);
std::string reader_text(const Model& model, const InputReference& input);
// Each once: two drivers of a device may read by ports of one name.
std::vector<std::string> reader_texts(const Model& model, const std::vector<InputReference>& readers);

}  // namespace flexrf::config_gen
