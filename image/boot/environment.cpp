#include "image/boot/environment.hpp"

namespace flexrf::boot {

Environment::Environment(Medium& medium) : medium_(medium) {
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    const Result<std::string> block = medium_.read(copy_names[i]);
    const Result<Choice> found = block ? choice_in(*block) : Result<Choice>(block.status());
    copies_[i].damage = found.status();
    if (found) copies_[i].choice = *found;
  }
  if (copies_[0].damage && copies_[1].damage)
    newest_ = copies_[1].choice.counter > copies_[0].choice.counter ? 1 : 0;
  else if (copies_[0].damage || copies_[1].damage)
    newest_ = copies_[0].damage ? 0 : 1;

  const Result<std::string> block = medium_.read(attempts_name);
  const Result<Attempts> found = block ? attempts_in(*block) : Result<Attempts>(block.status());
  attempts_damage_ = found.status();
  if (found) attempts_ = *found;
}

bool Environment::has_two_equal_copies() const noexcept {
  return copies_[0].damage && copies_[1].damage && copies_[0].choice == copies_[1].choice;
}

std::string Environment::damages() const {
  std::string text;
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    if (copies_[i].damage) continue;
    if (!text.empty()) text += "; ";
    text.append(copy_names[i]).append(" is damaged: ").append(copies_[i].damage.cause());
  }
  return text;
}

Status Environment::write(Choice next) {
  std::size_t first = 0;
  if (newest_) {
    if (choice().counter >= last_counter)
      return Status::error(StatusCode::out_of_range,
                           "the counter of changes is at its end; remove %s and %s and run 'repair'",
                           copy_names[0], copy_names[1]);
    next.counter = choice().counter + 1;
    // Who wrote the newer copy may have been killed before it was on the disk. With the other one on its way
    // besides, a power cut could take both.
    if (const Status flushed = medium_.flush(copy_names[*newest_]); !flushed) return flushed;
    first = 1 - *newest_;
  }
  if (const Status written = write_copy(first, next); !written) return written;
  newest_ = first;
  return write_copy(1 - first, next);
}

Status Environment::write_other_copy() {
  if (const Status flushed = medium_.flush(copy_names[*newest_]); !flushed) return flushed;
  return write_copy(1 - *newest_, choice());
}

Status Environment::write_copy(std::size_t copy, const Choice& next) {
  if (const Status written = medium_.overwrite(copy_names[copy], block_of(next)); !written) return written;
  if (const Status flushed = medium_.flush(copy_names[copy]); !flushed) return flushed;
  copies_[copy].choice = next;
  copies_[copy].damage = {};
  return {};
}

Status Environment::write(const Attempts& next) {
  if (const Status written = medium_.overwrite(attempts_name, block_of(next)); !written) return written;
  if (const Status flushed = medium_.flush(attempts_name); !flushed) return flushed;
  attempts_ = next;
  attempts_damage_ = {};
  return {};
}

}  // namespace flexrf::boot
