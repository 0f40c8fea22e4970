// A ring's entry and the job queue in every interleaving, and twins with one deliberate mistake each, which
// the checker must refuse.
#include <cstdint>

#include "runtime/blackboard/tests/model.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::queue_model_test {
namespace {

using test::assert_holds;
using test::assert_refused;

using Byte = std::uint8_t;
constexpr Byte none = 0xFF;

/// RingEntry, in a ring of one entry: the writer overwrites it again and again, the reader copies it.
struct Entry {
  enum Mistake : Byte { no_mistake, is_not_announced, no_second_look, announces_too_late };
  static constexpr int threads = 2;
  static constexpr Byte positions = 4;

  explicit Entry(Mistake made) : mistake(made) {}

  bool can_step(int thread) const {
    if (thread == 1) return position < positions;
    return reader_at != 0 || (visible > 0 && visible - 1 != last);
  }
  const char* step(int thread) { return thread == 1 ? write() : read(); }
  const char* at_rest() const { return last == positions - 1 ? nullptr : "the last item was lost"; }

  const char* write() {
    switch (writer_at++) {
      case 0:
        if (mistake == no_mistake || mistake == no_second_look) stamp = static_cast<Byte>(2 * position + 1);
        return nullptr;
      case 1:
        words[0] = position;
        return nullptr;
      case 2:
        if (mistake == announces_too_late) stamp = static_cast<Byte>(2 * position + 1);
        return nullptr;
      case 3:
        words[1] = position;
        return nullptr;
      case 4:
        stamp = static_cast<Byte>(2 * position);
        return nullptr;
      default:
        visible = ++position;
        writer_at = 0;
        return nullptr;
    }
  }

  const char* read() {
    switch (reader_at++) {
      case 0:
        wanted = static_cast<Byte>(visible - 1);
        return nullptr;
      case 1:
        if (stamp != 2 * wanted) reader_at = 0;
        return nullptr;
      case 2:
        copy[0] = words[0];
        return nullptr;
      case 3:
        copy[1] = words[1];
        return nullptr;
      default:
        reader_at = 0;
        if (stamp != 2 * wanted && mistake != no_second_look) return nullptr;
        if (copy[0] != wanted || copy[1] != wanted) return "torn read";
        last = wanted;
        return nullptr;
    }
  }

  Byte mistake;
  Byte stamp = 0;
  Byte words[2] = {};
  Byte visible = 0;
  Byte writer_at = 0;
  Byte position = 0;
  Byte reader_at = 0;
  Byte wanted = 0;
  Byte copy[2] = {};
  Byte last = none;
};

/// JobQueue by arrival: one writer, two readers.
struct Jobs {
  enum Mistake : Byte {
    no_mistake,
    no_horizon,           // also takes jobs that came after the scan began
    claims_in_two_steps,  // looks whether the cell is still full, then marks it
    empties_before_it_copied,
    full_before_it_is_written,
  };
  static constexpr int threads = 3;
  static constexpr Byte jobs = 4;
  static constexpr Byte cells = 2;
  enum State : Byte { empty, writing, full, reading };

  explicit Jobs(Mistake made) : mistake(made) {}

  bool can_step(int thread) const {
    if (thread == 2) return pushed < jobs && (writer_at != 0 || state[0] == empty || state[1] == empty);
    return readers[thread].at != 0 || state[0] == full || state[1] == full;
  }
  const char* step(int thread) { return thread == 2 ? write() : read(readers[thread]); }
  const char* at_rest() const {
    for (Byte job = 1; job <= jobs; ++job) {
      if (popped[job] != 1) return "a job was lost";
    }
    return nullptr;
  }

  struct Reader {
    Byte at = 0;
    Byte horizon = 0;
    Byte scanned = 0;
    Byte best = none;
    Byte best_ticket = 0;
    Byte last = 0;
  };

  const char* write() {
    const bool full_early = mistake == full_before_it_is_written;
    switch (writer_at++) {
      case 0:
        target = state[0] == empty ? 0 : 1;
        state[target] = writing;
        return nullptr;
      case 1:
        if (!full_early) value[target] = static_cast<Byte>(pushed + 1);
        return nullptr;
      case 2:
        mine = tickets++;
        return nullptr;
      case 3:
        ticket[target] = mine;
        state[target] = full;
        if (full_early) return nullptr;
        break;
      default:
        value[target] = static_cast<Byte>(pushed + 1);
        break;
    }
    ++pushed;
    writer_at = 0;
    return nullptr;
  }

  const char* read(Reader& reader) {
    switch (reader.at) {
      case 0:
        reader.horizon = mistake == no_horizon ? Byte{jobs} : tickets;
        reader.scanned = 0;
        reader.best = none;
        reader.at = 1;
        return nullptr;
      case 1:
        if (state[reader.scanned] == full && ticket[reader.scanned] < reader.horizon &&
            (reader.best == none || ticket[reader.scanned] < reader.best_ticket)) {
          reader.best = reader.scanned;
          reader.best_ticket = ticket[reader.scanned];
        }
        if (++reader.scanned < cells) return nullptr;
        reader.at = reader.best == none ? 0 : 2;
        return nullptr;
      case 2:
        if (state[reader.best] != full || ticket[reader.best] != reader.best_ticket) {
          reader.at = 0;
          return nullptr;
        }
        reader.at = mistake == claims_in_two_steps ? 3 : 4;
        if (mistake != claims_in_two_steps)
          state[reader.best] = mistake == empties_before_it_copied ? empty : reading;
        return nullptr;
      case 3:
        state[reader.best] = reading;
        reader.at = 4;
        return nullptr;
      default: {
        const Byte job = value[reader.best];
        state[reader.best] = mistake == empties_before_it_copied ? state[reader.best] : Byte{empty};
        reader.at = 0;
        if (job != reader.best_ticket + 1) return "not the job that was claimed";
        if (popped[job]++ != 0) return "a job was handed out twice";
        if (job < reader.last) return "a job overtook one of the same writer";
        reader.last = job;
        return nullptr;
      }
    }
  }

  Byte mistake;
  Byte state[cells] = {};
  Byte ticket[cells] = {};
  Byte value[cells] = {};
  Byte tickets = 0;
  Byte pushed = 0;
  Byte writer_at = 0;
  Byte target = 0;
  Byte mine = 0;
  Byte popped[jobs + 1] = {};
  Reader readers[2];
};

void ring_entry(void**) {
  assert_holds(Entry{Entry::no_mistake});
}
void ring_entry_broken(void**) {
  assert_refused(Entry{Entry::is_not_announced}, "torn read");
  assert_refused(Entry{Entry::no_second_look}, "torn read");
  assert_refused(Entry{Entry::announces_too_late}, "torn read");
}

void job_queue(void**) {
  assert_holds(Jobs{Jobs::no_mistake});
}
void job_queue_broken(void**) {
  assert_refused(Jobs{Jobs::no_horizon}, "a job overtook one of the same writer");
  assert_refused(Jobs{Jobs::claims_in_two_steps}, "a job was handed out twice");
  assert_refused(Jobs{Jobs::empties_before_it_copied}, "not the job that was claimed");
  assert_refused(Jobs{Jobs::full_before_it_is_written}, "not the job that was claimed");
}

}  // namespace
}  // namespace flexrf::queue_model_test

int main() {
  using namespace flexrf::queue_model_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(ring_entry),
      cmocka_unit_test(ring_entry_broken),
      cmocka_unit_test(job_queue),
      cmocka_unit_test(job_queue_broken),
  };
  return cmocka_run_group_tests_name("queue model", tests, nullptr, nullptr);
}
