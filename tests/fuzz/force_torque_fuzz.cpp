// What a force-torque sensor sends: datagrams of RDT, and the bytes of an FT300's line.
#include <cmath>

#include "hal/force_torque/ft300/ft300_stream.hpp"
#include "hal/force_torque/net_ft/net_ft_session.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {
namespace {

WrenchMeter begun_meter() {
  WrenchMeter meter;
  expect(meter.begin("fuzz", {.position = {0.1, 0, 0}, .tare_samples = 3, .max_age = std::chrono::seconds(1)})
             .is_ok());
  return meter;
}

void check(const WrenchMeter& meter) {
  if (!meter.state()) return;
  for (std::size_t i = 0; i < 3; ++i)
    expect(std::isfinite(meter.state()->force[i]) && std::isfinite(meter.state()->torque[i]));
}

void take_datagrams(Source& source) {
  WrenchMeter meter = begun_meter();
  NetFtSession session;
  expect(session.begin({1e6, 1e6, source.byte() % 2 == 0 ? AtiFamily::axia : AtiFamily::net_box}).is_ok());
  Time now{std::chrono::seconds(1)};
  std::uint64_t before = 0;
  while (!source.is_empty()) {
    const std::uint8_t what = source.byte();
    now += std::chrono::milliseconds(what);
    if (what % 5 == 0) meter.tare();
    static_cast<void>(session.request(now));
    session.take(source.some(what % 3 == 0 ? what : rdt::record_bytes), now, meter);
    meter.close(now);
    check(meter);
    if (!meter.state()) continue;
    expect(meter.state()->sequence >= before);
    before = meter.state()->sequence;
  }
}

/// Whatever came before: a frame that is not cut into is found.
void take_line(Source& source) {
  WrenchMeter meter = begun_meter();
  ft300::Decoder decoder;
  const Time now{std::chrono::seconds(1)};
  while (!source.is_empty()) {
    decoder.put(source.byte());
    const auto frame = decoder.take();
    if (!frame) continue;
    meter.take(ft300::measured(*frame), now);
    meter.close(now);
    check(meter);
  }
  // At most one that only looks like one swallows its beginning.
  const ft300::FrameBytes frame = ft300::encode({{1, 2, 3}, {4, 5, 6}});
  bool found = false;
  for (int i = 0; i < 3; ++i) {
    for (const std::uint8_t byte : frame) decoder.put(byte);
    found = found || decoder.take().has_value();
  }
  expect(found);
}

}  // namespace

std::vector<Bytes> seeds() {
  Bytes datagrams{0, 0};
  for (const std::uint32_t status : {0U, 0xC000'0000U, 0x8000'0002U}) {
    const rdt::RecordBytes record =
        rdt::encode(rdt::Record{1 + status % 7, 9, status, {1000000, 2, -3}, {4, -5, 6}});
    datagrams.push_back(1);
    datagrams.insert(datagrams.end(), record.begin(), record.end());
  }
  Bytes line{1};
  for (std::int16_t i = 0; i < 3; ++i) {
    const ft300::FrameBytes frame = ft300::encode({{i, 0x4E20, -100}, {200, -300, 0x4E}});
    line.insert(line.end(), frame.begin(), frame.end() - i);
  }
  return {datagrams, line};
}

void take(std::span<const std::uint8_t> bytes) {
  Source source(bytes);
  if (source.byte() % 2 == 0) return take_datagrams(source);
  take_line(source);
}

}  // namespace flexrf::fuzz
