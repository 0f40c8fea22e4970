// SDO, both ends: a client whose server says anything, and a server whose client does.
#include "hal/canopen/sdo_client.hpp"
#include "hal/canopen/sdo_frames.hpp"
#include "hal/canopen/sdo_server.hpp"
#include "tests/fuzz/can_message.hpp"

namespace flexrf::fuzz {
namespace {

using namespace canopen;

constexpr std::uint8_t node = 5;

/// Objects as long as their subindex says.
class Dictionary final : public ObjectDictionary {
 public:
  std::uint32_t read(ObjectAddress object, std::span<std::uint8_t> value, std::size_t& size) override {
    if (object.index > 0x7000) return 0x0602'0000;
    size = object.subindex;
    expect(size <= value.size());
    std::fill_n(value.begin(), size, object.subindex);
    return 0;
  }
  std::uint32_t write(ObjectAddress object, std::span<const std::uint8_t> value) override {
    expect(value.size() <= SdoServer::capacity);
    for (const std::uint8_t byte : value) sum_ += byte;
    return object.index > 0x7000 ? 0x0602'0000 : 0;
  }

 private:
  unsigned sum_ = 0;  // every byte of a value can be read
};

struct Ends {
  SdoClient client{node, std::chrono::milliseconds(100)};
  Dictionary dictionary;
  SdoServer server{node, dictionary};
  Outbox outbox;
  Time now{std::chrono::seconds(1)};
};

void act(Ends& ends, Source& source) {
  const std::uint8_t what = source.byte();
  ends.now += std::chrono::milliseconds(what >> 4);
  const ObjectAddress object{source.word(), source.byte()};
  switch (what % 6) {
    case 0:
      ends.client.read(object, ends.now, ends.outbox);
      break;
    case 1: {
      const std::size_t size = source.word() % (SdoClient::capacity + 10);
      const bool begun = ends.client.write(object, source.some(size), ends.now, ends.outbox);
      static_cast<void>(begun);
      break;
    }
    case 2:
      ends.client.cancel(ends.outbox);
      break;
    case 3:  // what the two say reaches the other
      if (ends.outbox.is_empty()) break;
      if (const auto answer = ends.server.receive(ends.outbox.front()))
        ends.client.receive(*answer, ends.now, ends.outbox);
      ends.outbox.pop();
      break;
    case 4: {
      Message message = message_from(source);
      if (source.byte() % 4 != 0) message.identifier = identifier_of(sdo_answer_base, node);
      ends.client.receive(message, ends.now, ends.outbox);
      break;
    }
    default: {
      Message message = message_from(source);
      message.identifier = identifier_of(sdo_request_base, node);
      if (const auto answer = ends.server.receive(message))
        expect(answer->size == 8 && answer->identifier == identifier_of(sdo_answer_base, node));
      break;
    }
  }
  ends.client.advance(ends.now, ends.outbox);
}

}  // namespace

std::vector<Bytes> seeds() {
  // A read in one piece, one in segments, and a write of the same kinds.
  const Bytes deliver{3, 0, 0, 0};
  Bytes reads{0, 0x18, 0x10, 4};
  reads.insert(reads.end(), deliver.begin(), deliver.end());
  Bytes segments{0, 0x08, 0x10, 40};
  for (int i = 0; i < 8; ++i) segments.insert(segments.end(), deliver.begin(), deliver.end());
  Bytes writes{1, 0x17, 0x10, 0, 20, 0};
  for (std::uint8_t i = 0; i < 20; ++i) writes.push_back(i);
  for (int i = 0; i < 5; ++i) writes.insert(writes.end(), deliver.begin(), deliver.end());
  Bytes answered{0, 0x18, 0x10, 4, 4, 0, 0, 0};
  append(answered, sdo::frame(identifier_of(sdo_answer_base, node), sdo::read_segmented, {0x1018, 4}));
  answered.push_back(1);
  Bytes asked{5, 0, 0, 0};
  append(asked, sdo::frame(identifier_of(sdo_request_base, node), sdo::write_segmented, {0x1018, 4}));
  return {reads, segments, writes, answered, asked};
}

void take(std::span<const std::uint8_t> bytes) {
  Source source(bytes);
  Ends ends;
  while (!source.is_empty()) {
    act(ends, source);
    expect(ends.client.value().size() <= SdoClient::capacity);
    expect(ends.client.state() != SdoClient::State::failed || !ends.client.status().is_ok());
    while (ends.outbox.size() > Outbox::capacity / 2) ends.outbox.pop();
  }
}

}  // namespace flexrf::fuzz
