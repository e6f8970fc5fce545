#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace berth {

/// The side that touches a buffer's memory.
enum class GlMemory {
  device,     ///< the GPU alone
  upload,     ///< written by this program, read by the GPU; mapped as long as it lives
  read_back,  ///< written by the GPU, read by this program; mapped as long as it lives
};

/// Memory of the current context's GPU, of a fixed size. Moved, not copied.
class GlBuffer {
 public:
  GlBuffer() = default;
  GlBuffer(std::size_t bytes, GlMemory memory);
  ~GlBuffer();
  GlBuffer(GlBuffer&& other) noexcept { swap(other); }
  GlBuffer& operator=(GlBuffer&& other) noexcept {
    swap(other);
    return *this;
  }

  unsigned name() const { return name_; }
  std::size_t bytes() const { return bytes_; }

  /// The mapped memory as Ts; upload and read_back alone. What the GPU wrote is there after
  /// GlFence::wait().
  template <class T>
  std::span<T> mapped() {
    return {static_cast<T*>(mapped_), bytes_ / sizeof(T)};
  }

  /// Fills it with copies of one number, on the GPU.
  void fill(std::uint32_t number);
  /// This many first bytes to the beginning of `target`, on the GPU.
  void copy_to(GlBuffer& target, std::size_t bytes) const;

 private:
  void swap(GlBuffer& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    std::swap(mapped_, other.mapped_);
  }

  unsigned name_ = 0;
  std::size_t bytes_ = 0;
  void* mapped_ = nullptr;
};

inline GlBuffer device_buffer(std::size_t bytes) { return {bytes, GlMemory::device}; }

/// Replaces a buffer that is too small, or none yet, by one of this size.
void take_at_least(std::size_t bytes, GlBuffer& buffer, GlMemory memory = GlMemory::device);

/// A point in the stream of commands.
class GlFence {
 public:
  GlFence() = default;
  ~GlFence();
  GlFence(const GlFence&) = delete;
  GlFence& operator=(const GlFence&) = delete;

  /// Sets the point after all commands so far.
  void set();
  /// Returns when the GPU has passed the point; at once where none is set. Throws
  /// std::runtime_error if the GPU does not get there within 10 s.
  void wait();

 private:
  void* sync_ = nullptr;
};

}  // namespace berth
