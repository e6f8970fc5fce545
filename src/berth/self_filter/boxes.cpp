#include "berth/self_filter/boxes.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/boxes.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

BoxC box_of_pack(const BoxPack& pack) {
  const FloatTag d;
  BoxC box;
  for (int axis = 0; axis < 3; ++axis) {
    auto low = hn::LoadU(d, pack.min_m[axis]);
    auto high = hn::LoadU(d, pack.max_m[axis]);
    for (std::size_t i = hn::Lanes(d); i < kPackSize; i += hn::Lanes(d)) {
      low = hn::Min(low, hn::LoadU(d, pack.min_m[axis] + i));
      high = hn::Max(high, hn::LoadU(d, pack.max_m[axis] + i));
    }
    box.min_m[axis] = hn::GetLane(hn::MinOfLanes(d, low));
    box.max_m[axis] = hn::GetLane(hn::MaxOfLanes(d, high));
  }
  return box;
}

NearBits near_pack(const BoxC& box, const BoxPack& pack, float radius2_m2) {
  const FloatTag d;
  NearBits bits;
  for (int i = 0; i < kPackSize; i += static_cast<int>(hn::Lanes(d))) {
    auto least2 = hn::Zero(d);
    auto most2 = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const auto above = hn::Sub(hn::LoadU(d, pack.min_m[axis] + i), hn::Set(d, box.max_m[axis]));
      const auto below = hn::Sub(hn::Set(d, box.min_m[axis]), hn::LoadU(d, pack.max_m[axis] + i));
      const auto least = hn::Max(hn::Zero(d), hn::Max(above, below));
      const auto most = hn::Max(hn::Abs(above), hn::Abs(below));
      least2 = hn::Add(least2, hn::Mul(least, least));
      most2 = hn::Add(most2, hn::Mul(most, most));
    }
    const auto radius2 = hn::Set(d, radius2_m2);
    bits.some |= bits_of(d, hn::Le(least2, radius2)) << i;
    bits.all |= bits_of(d, hn::Le(most2, radius2)) << i;
  }
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(box_of_pack);
HWY_EXPORT(near_pack);

BoxPack::BoxPack() {
  const BoxC nothing;
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(min_m[axis], kPackSize, nothing.min_m[axis]);
    std::fill_n(max_m[axis], kPackSize, nothing.max_m[axis]);
  }
}

void BoxPack::set(int i, const BoxC& box) {
  for (int axis = 0; axis < 3; ++axis) {
    min_m[axis][i] = box.min_m[axis];
    max_m[axis][i] = box.max_m[axis];
  }
}

BoxC BoxPack::get(int i) const {
  BoxC box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min_m[axis] = min_m[axis][i];
    box.max_m[axis] = max_m[axis][i];
  }
  return box;
}

BoxC box_of_boxes(const BoxPack& pack) { return HWY_DYNAMIC_DISPATCH(box_of_pack)(pack); }

NearBits near_boxes(const BoxC& box, const BoxPack& pack, float radius2_m2) {
  return HWY_DYNAMIC_DISPATCH(near_pack)(box, pack, radius2_m2);
}

}  // namespace berth
#endif  // HWY_ONCE
