#include "hal/force_torque/ft300/ft300_sensor.hpp"

namespace flexrf {

Status Ft300Sensor::initialise() {
  line_.stop();
  frames_ = damaged_ = 0;
  if (Status status = begin_measuring(); !status) return status;
  return line_.start(name(), std::string(configuration.device_view()), configuration.unit_id);
}

/// A stream without numbers: what is lost on the line is not known but by what is damaged.
void Ft300Sensor::listen(WrenchMeter& meter, Time /*now*/) noexcept {
  const Ft300Report* const report = line_.take_news();
  if (report == nullptr) return;
  if (report->damaged > damaged_) meter.note_damaged(report->damaged - damaged_);
  damaged_ = report->damaged;
  if (report->frames != frames_) meter.take({report->force, report->torque}, Time{Duration{report->time}});
  frames_ = report->frames;
  if (report->code != 0)
    meter.note_away(Status::error(static_cast<StatusCode>(report->code), "%.*s",
                                  static_cast<int>(report->trouble.size()), report->trouble.data()));
}

}  // namespace flexrf
