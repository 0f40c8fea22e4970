// Items and slots of types that are as large as their slot says, where only the program knows how large: for
// drivers that keep an item of their own, for code written by hand, and for tests. They allocate.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "runtime/blackboard/slot.hpp"

namespace flexrf {

/// So many zeroed bytes that begin a page.
class PageMemory {
 public:
  explicit PageMemory(std::size_t bytes)
      : bytes_(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{page}))) {
    std::memset(bytes_.get(), 0, bytes);
  }
  std::byte* get() const noexcept { return bytes_.get(); }

 private:
  struct Free {
    void operator()(std::byte* bytes) const noexcept { ::operator delete (bytes, std::align_val_t{page}); }
  };
  std::unique_ptr<std::byte, Free> bytes_;
};

/// One item outside of any slot.
template <SizedBySlot T>
class SizedItem {
 public:
  explicit SizedItem(std::size_t elements = T::usual_elements_)
      : memory_(T::elements_begin_ + elements * sizeof(typename T::SlotElement)),
        item_(new (memory_.get()) T) {
    item_->elements_ = static_cast<std::uint32_t>(elements);
  }

  T& operator*() const noexcept { return *item_; }
  T* operator->() const noexcept { return item_; }

 private:
  PageMemory memory_;
  T* item_;
};

/// A type with another number of elements than usual.
class SizedType {
 public:
  SizedType(const TypeDescriptor& usual, std::size_t elements)
      : fields_(usual.fields.begin(), usual.fields.end()),
        significant_(usual.significant.begin(), usual.significant.end()),
        type_(usual) {
    FieldDescriptor& last = fields_.back();
    const std::uint32_t bytes_of_one = (usual.size - last.offset) / last.count;
    const std::uint32_t before = last.count * bytes_of_one;
    last.count = last.shape[0] = static_cast<std::uint32_t>(elements);
    const std::uint32_t after = last.count * bytes_of_one;
    // Its bytes end the last range, where nothing lies between it and the field before.
    significant_.back().size += after - before;
    type_.size += after - before;
    type_.fields = fields_;
    type_.significant = significant_;
  }
  SizedType(const SizedType&) = delete;
  SizedType& operator=(const SizedType&) = delete;

  const TypeDescriptor& descriptor() const noexcept { return type_; }

 private:
  std::vector<FieldDescriptor> fields_;
  std::vector<ByteRange> significant_;
  TypeDescriptor type_;
};

/// As Slot, of so many elements.
template <SizedBySlot T, std::size_t Readers, std::size_t Loans = 1, std::size_t Holds = 0>
class SizedSlot {
 public:
  static constexpr std::size_t buffers = Readers + Holds + 1 + Loans;
  static_assert(buffers <= SlotControl::max_buffers, "too many readers and loans for one slot");

  explicit SizedSlot(std::size_t elements)
      : type_(*descriptor_of<T>, elements),
        stride_((type_.descriptor().size + page - 1) / page * page),
        values_(buffers * stride_),
        control_(&type_.descriptor(),
                 {headers_, values_.get(), sizeof(Header), static_cast<std::uint32_t>(stride_), taken_,
                  given_, buffers, Loans, Readers == 1 && Loans == 1 && Holds == 0}) {
    control_.lay_out_items();
  }
  SlotControl& control() noexcept { return control_; }

 private:
  struct alignas(cache_line) Header {
    ItemHeader header;
  };
  SizedType type_;
  std::size_t stride_;
  PageMemory values_;
  Header headers_[buffers]{};
  std::uint32_t taken_[buffers]{};
  std::atomic<std::uint32_t> given_[buffers]{};
  SlotControl control_;
};

}  // namespace flexrf
