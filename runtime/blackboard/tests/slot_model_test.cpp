// The slot's and the doorbell's steps in every interleaving, and twins with one deliberate mistake each,
// which the checker must refuse: else it would not see that mistake in the real thing either.
#include <cstdint>

#include "runtime/blackboard/tests/model.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::slot_model_test {
namespace {

using test::assert_holds;
using test::assert_refused;

using Byte = std::uint8_t;
constexpr Byte none = 0xFF;

/// SlotControl with counted readers: two readers, one loan.
struct CountedSlot {
  enum Mistake : Byte {
    no_mistake,
    give_after_take,  // the reader holds two buffers for a moment
    count_not_final,  // the count of takes is read before the exchange, not by it
    ignores_current,  // the writer does not leave out the current buffer
    gives_before_it_is_done,
    one_buffer_less,
  };
  static constexpr int threads = 3;
  static constexpr Byte publications = 5;
  static constexpr Byte all_buffers = 4;

  explicit CountedSlot(Mistake made) : mistake(made) {
    if (made == one_buffer_less) buffers = all_buffers - 1;
  }

  bool can_step(int thread) const {
    if (thread == 2) return published < publications;
    const Reader& reader = readers[thread];
    return reader.at != 0 || (word_published && word_index != reader.held);
  }

  const char* step(int thread) { return thread == 2 ? write() : read(readers[thread]); }

  const char* at_rest() const {
    for (const Reader& reader : readers) {
      if (reader.last != publications) return "the last item was lost";
    }
    return nullptr;
  }

  struct Reader {
    Byte at = 0;
    Byte held = none;
    Byte former = none;
    Byte last = 0;
  };

  const char* read(Reader& reader) {
    switch (reader.at) {
      case 0:  // the look at the word is can_step's
        reader.at = mistake == give_after_take || reader.held == none ? 2 : 1;
        return nullptr;
      case 1:
        ++given[reader.held];
        // A buffer counts as held until it is given back; this mistake reads on after that.
        if (mistake != gives_before_it_is_done) reader.held = none;
        reader.at = 2;
        return nullptr;
      case 2:
        ++word_count;
        reader.former = mistake == give_after_take ? reader.held : none;
        reader.held = word_index;
        reader.at = reader.former == none ? 0 : 3;
        if (reader.held == being_written) return "torn read";
        if (value[reader.held] < reader.last) return "backward read";
        reader.last = value[reader.held];
        return nullptr;
      default:
        ++given[reader.former];
        reader.former = none;
        reader.at = 0;
        return nullptr;
    }
  }

  const char* write() {
    switch (writer_at) {
      case 0:
        if (tried == buffers) return "no buffer free";
        if ((candidate != current || mistake == ignores_current) && taken[candidate] == given[candidate]) {
          writer_at = 1;
          tried = 0;
        } else {
          ++tried;
          candidate = static_cast<Byte>((candidate + 1) % buffers);
        }
        return nullptr;
      case 1:
        for (const Reader& reader : readers) {
          if (reader.held == candidate || reader.former == candidate) return "writes what a reader holds";
        }
        being_written = candidate;
        writer_at = 2;
        return nullptr;
      case 2:
        value[candidate] = static_cast<Byte>(published + 1);
        being_written = none;
        writer_at = mistake == count_not_final ? 3 : 4;
        return nullptr;
      case 3:
        count_seen = word_count;
        writer_at = 4;
        return nullptr;
      default:
        taken[current] =
            static_cast<Byte>(taken[current] + (mistake == count_not_final ? count_seen : word_count));
        word_index = candidate;
        word_count = 0;
        word_published = 1;
        candidate = current;
        current = word_index;
        ++published;
        writer_at = 0;
        return nullptr;
    }
  }

  Byte mistake;
  Byte buffers = all_buffers;
  Byte word_index = 0;
  Byte word_count = 0;
  Byte word_published = 0;
  Byte taken[all_buffers] = {};
  Byte given[all_buffers] = {};
  Byte value[all_buffers] = {};
  Byte being_written = none;
  Byte writer_at = 0;
  Byte candidate = 1;
  Byte tried = 0;
  Byte current = 0;
  Byte count_seen = 0;
  Byte published = 0;
  Reader readers[2];
};

/// SlotControl as a triple buffer.
struct TripleBuffer {
  enum Mistake : Byte { no_mistake, takes_what_is_not_fresh, publishes_in_two_steps, takes_in_two_steps };
  static constexpr int threads = 2;
  static constexpr Byte publications = 6;
  static constexpr Byte takes = 6;

  explicit TripleBuffer(Mistake made) : mistake(made) {}

  bool can_step(int thread) const {
    if (thread == 1) return published < publications;
    return reader_at != 0 || fresh || (mistake == takes_what_is_not_fresh && taken < takes && published > 0);
  }
  const char* step(int thread) { return thread == 1 ? write() : read(); }
  const char* at_rest() const { return last == publications ? nullptr : "the last item was lost"; }

  const char* read() {
    Byte next = word;
    if (mistake == takes_in_two_steps) {
      if (reader_at == 0) {
        seen = word;
        reader_at = 1;
        return nullptr;
      }
      next = seen;
      reader_at = 0;
    }
    word = held;
    fresh = 0;
    held = next;
    ++taken;
    if (held == being_written) return "torn read";
    if (value[held] < last) return "backward read";
    last = value[held];
    return nullptr;
  }

  const char* write() {
    switch (writer_at) {
      case 0:
        if (back == held) return "writes what the reader holds";
        being_written = back;
        writer_at = 1;
        return nullptr;
      case 1:
        value[back] = static_cast<Byte>(published + 1);
        being_written = none;
        former = word;
        writer_at = mistake == publishes_in_two_steps ? 2 : 3;
        if (mistake != publishes_in_two_steps) return write();
        return nullptr;
      default:
        if (mistake != publishes_in_two_steps) former = word;
        word = back;
        fresh = 1;
        back = former;
        ++published;
        writer_at = 0;
        return nullptr;
    }
  }

  Byte mistake;
  Byte word = 0;
  Byte fresh = 0;
  Byte back = 1;
  Byte held = 2;
  Byte value[3] = {};
  Byte being_written = none;
  Byte writer_at = 0;
  Byte former = 0;
  Byte published = 0;
  Byte reader_at = 0;
  Byte seen = 0;
  Byte taken = 0;
  Byte last = 0;
};

/// Doorbell: two threads that publish and ring, one that sleeps.
struct Bell {
  enum Mistake : Byte {
    no_mistake,
    looks_before_it_listens,
    rings_before_it_publishes,
    announces_without_comparing,
    looks_for_sleepers_before_it_counts,
    ringer_clears_the_bit_after_waking,
  };
  static constexpr int threads = 3;
  static constexpr Byte rings = 2;

  explicit Bell(Mistake made) : mistake(made) {}

  bool can_step(int thread) const {
    if (thread == 2) return !(sleeper_at == 3 && blocked) && !(sleeper_at == 0 && seen == 2 * rings);
    return ringers[thread].rung < rings;
  }
  const char* step(int thread) {
    if (thread == 2) {
      sleep();
    } else {
      ring(ringers[thread]);
    }
    return nullptr;
  }
  const char* at_rest() const { return seen == items ? nullptr : "lost wake-up"; }

  struct Ringer {
    Byte at = 0;
    Byte mine = 0;
    Byte saw_sleeper = 0;
    Byte rung = 0;
  };

  void ring(Ringer& ringer) {
    const bool early = mistake == rings_before_it_publishes;
    const bool look_first = mistake == looks_for_sleepers_before_it_counts;
    switch (ringer.at) {
      case 0:
        if (!early) ++items;
        ringer.at = look_first ? 1 : 2;
        return;
      case 1:
        ringer.saw_sleeper = asleep;
        ringer.at = 2;
        return;
      case 2:
        ++count;
        ringer.mine = count;
        if (!look_first) ringer.saw_sleeper = asleep;
        ringer.at = 3;
        return;
      case 3:
        if (ringer.saw_sleeper) blocked = 0;
        ringer.at = 4;
        return;
      default:
        if (mistake == ringer_clears_the_bit_after_waking && ringer.saw_sleeper && count == ringer.mine)
          asleep = 0;
        if (early) ++items;
        ++ringer.rung;
        ringer.at = 0;
        return;
    }
  }

  void sleep() {
    const bool look_first = mistake == looks_before_it_listens;
    switch (sleeper_at) {
      case 0:
        if (look_first) {
          look();
        } else {
          heard = count;
        }
        sleeper_at = 1;
        return;
      case 1:
        sleeper_at = 2;
        if (look_first) {
          heard = count;
        } else {
          look();
        }
        if (found) sleeper_at = 0;
        return;
      case 2:
        if (mistake == announces_without_comparing) heard = count;
        sleeper_at = count == heard ? 3 : 0;
        if (count == heard) asleep = 1;
        entering = sleeper_at == 3;
        return;
      case 3:
        // The kernel compares and blocks in one step.
        if (entering && count == heard && asleep) {
          blocked = 1;
          entering = 0;
          return;
        }
        asleep = 0;
        entering = 0;
        sleeper_at = 0;
        return;
      default:
        return;
    }
  }
  void look() {
    found = seen != items;
    seen = items;
  }

  Byte mistake;
  Byte items = 0;
  Byte count = 0;
  Byte asleep = 0;
  Byte blocked = 0;
  Byte sleeper_at = 0;
  Byte heard = 0;
  Byte found = 0;
  Byte entering = 0;
  Byte seen = 0;
  Ringer ringers[2];
};

// [board-1]
void counted_slot(void**) {
  assert_holds(CountedSlot{CountedSlot::no_mistake});
}
void counted_slot_broken(void**) {
  assert_refused(CountedSlot{CountedSlot::give_after_take}, "no buffer free");
  assert_refused(CountedSlot{CountedSlot::count_not_final}, "writes what a reader holds");
  assert_refused(CountedSlot{CountedSlot::ignores_current}, "writes what a reader holds");
  assert_refused(CountedSlot{CountedSlot::gives_before_it_is_done}, "writes what a reader holds");
  assert_refused(CountedSlot{CountedSlot::one_buffer_less}, "no buffer free");
}

// [board-1]
void triple_buffer(void**) {
  assert_holds(TripleBuffer{TripleBuffer::no_mistake});
}
void triple_buffer_broken(void**) {
  assert_refused(TripleBuffer{TripleBuffer::takes_what_is_not_fresh}, "backward read");
  assert_refused(TripleBuffer{TripleBuffer::publishes_in_two_steps}, "writes what the reader holds");
  assert_refused(TripleBuffer{TripleBuffer::takes_in_two_steps}, "writes what the reader holds");
}

// [board-36]
void doorbell(void**) {
  assert_holds(Bell{Bell::no_mistake});
}
void doorbell_broken(void**) {
  assert_refused(Bell{Bell::looks_before_it_listens}, "lost wake-up");
  assert_refused(Bell{Bell::rings_before_it_publishes}, "lost wake-up");
  assert_refused(Bell{Bell::announces_without_comparing}, "lost wake-up");
  assert_refused(Bell{Bell::looks_for_sleepers_before_it_counts}, "lost wake-up");
  assert_refused(Bell{Bell::ringer_clears_the_bit_after_waking}, "lost wake-up");
}

}  // namespace
}  // namespace flexrf::slot_model_test

int main() {
  using namespace flexrf::slot_model_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(counted_slot),  cmocka_unit_test(counted_slot_broken),
      cmocka_unit_test(triple_buffer), cmocka_unit_test(triple_buffer_broken),
      cmocka_unit_test(doorbell),      cmocka_unit_test(doorbell_broken),
  };
  return cmocka_run_group_tests_name("slot model", tests, nullptr, nullptr);
}
