/// \file
/// `GrowingArray`: a list without pauses, for what grows to gigabytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "sparse/block_memory.hpp"

namespace sesame::sparse {

/// Whether an object may be moved by copying its bytes, the old ones being forgotten: true of what owns nothing, and,
/// where a specialisation says so, of what owns memory but has no pointer into itself.
template <class T>
inline constexpr bool is_relocatable = std::is_trivially_copyable_v<T>;

/// A contiguous list that grows at its end, like a std::vector, of relocatable elements. It grows by `resize_block`,
/// which for large blocks moves pages and not bytes: a vector of a hundred megabytes takes a tenth of a second to
/// double, this some milliseconds at most, and both copies are never there at once.
/// Cost: as of a std::vector.
template <class T>
class GrowingArray {
 public:
  using value_type = T;

  GrowingArray() = default;
  GrowingArray(std::initializer_list<T> elements) {
    reserve(elements.size());
    std::for_each(elements.begin(), elements.end(), [this](const T& element) { push_back(element); });
  }
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray moved{std::move(other)};
    swap(moved);
    return *this;
  }
  GrowingArray(const GrowingArray&) = delete;
  GrowingArray& operator=(const GrowingArray&) = delete;
  ~GrowingArray() {
    static_assert(is_relocatable<T> && alignof(T) <= alignof(std::max_align_t));
    truncate(0);
    release_block(elements_, capacity_ * sizeof(T));
  }
  void swap(GrowingArray& other) noexcept {
    std::swap(elements_, other.elements_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] T* data() { return elements_; }
  [[nodiscard]] const T* data() const { return elements_; }
  [[nodiscard]] T& operator[](std::size_t at) { return elements_[at]; }
  [[nodiscard]] const T& operator[](std::size_t at) const { return elements_[at]; }
  [[nodiscard]] T& back() { return elements_[size_ - 1]; }
  [[nodiscard]] const T& back() const { return elements_[size_ - 1]; }
  [[nodiscard]] T* begin() { return elements_; }
  [[nodiscard]] T* end() { return elements_ + size_; }
  [[nodiscard]] const T* begin() const { return elements_; }
  [[nodiscard]] const T* end() const { return elements_ + size_; }

  void push_back(T element) {
    if (size_ == capacity_) [[unlikely]] {
      set_capacity(std::max(least_capacity, 2 * capacity_));
    }
    std::construct_at(elements_ + size_, std::move(element));
    ++size_;
  }
  /// Requires: it is not empty.
  void pop_back() { std::destroy_at(elements_ + --size_); }
  /// Cuts back to the first `size` elements. Requires: there are so many.
  void truncate(std::size_t size) {
    std::destroy(elements_ + size, elements_ + size_);
    size_ = size;
  }
  /// New elements are T{}.
  void resize(std::size_t size) {
    if (size <= size_) {
      truncate(size);
      return;
    }
    if (size > capacity_) {
      set_capacity(std::max(size, 2 * capacity_));
    }
    std::uninitialized_value_construct(elements_ + size_, elements_ + size);
    size_ = size;
  }
  /// New elements are whatever is there: for one who writes all of them now, without touching the memory twice.
  void resize_for_overwrite(std::size_t size) requires std::is_trivially_copyable_v<T> {
    reserve(size);
    size_ = size;
  }
  void reserve(std::size_t capacity) {
    if (capacity > capacity_) {
      set_capacity(capacity);
    }
  }
  void shrink_to_fit() {
    if (size_ == 0) {
      GrowingArray{}.swap(*this);
    } else {
      set_capacity(size_);
    }
  }

 private:
  static constexpr std::size_t least_capacity = 8;

  /// Requires: not 0, and not less than the size.
  void set_capacity(std::size_t capacity) {
    if (capacity > static_cast<std::size_t>(PTRDIFF_MAX) / sizeof(T)) {
      throw std::bad_alloc{};
    }
    void* const moved = resize_block(elements_, capacity_ * sizeof(T), capacity * sizeof(T));
    if (moved == nullptr) {
      throw std::bad_alloc{};
    }
    elements_ = static_cast<T*>(moved);
    capacity_ = capacity;
  }

  T* elements_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace sesame::sparse
