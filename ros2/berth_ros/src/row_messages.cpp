#include "row_messages.hpp"

namespace berth_ros {
namespace {

using berth_msgs::msg::DistanceRows;
using berth_msgs::msg::LinkDistance;

/// Row-major, as the library's are.
template <class Matrix>
void copy(const Matrix& matrix, std::vector<double>& out) {
  static_assert(Matrix::IsRowMajor);
  out.assign(matrix.data(), matrix.data() + matrix.size());
}

void copy(const berth::DistanceRows& rows, berth::RowKind kind, berth_msgs::msg::RowsOfKind& out) {
  copy(rows.gradient(kind), out.gradient);
  copy(rows.normal_B(kind), out.normal_base);
  copy(rows.reach_m(kind), out.reach_m);
}

}  // namespace

void to_message(const berth::DistanceRows& rows, const std::vector<berth::MovableJoint>& joints,
                const berth_msgs::msg::LinkDistances& distances, DistanceRows& out) {
  out.header = distances.header;
  out.question_stamp = distances.question_stamp;
  out.joints_stamp = distances.joints_stamp;
  out.status = distances.status;
  out.joints.clear();
  for (const berth::MovableJoint& joint : joints) out.joints.push_back(joint.name);
  copy(rows, berth::RowKind::nearest, out.nearest);
  copy(rows, berth::RowKind::occupied, out.occupied);
  copy(rows, berth::RowKind::known, out.known);
  out.links.clear();
  for (auto* kind : {&out.nearest, &out.occupied, &out.known}) kind->lower_bound_m.clear();
  for (const LinkDistance& link : distances.links) {
    out.links.push_back(link.link);
    out.nearest.lower_bound_m.push_back(link.lower_bound_m);
    out.occupied.lower_bound_m.push_back(link.occupied.lower_bound_m);
    out.known.lower_bound_m.push_back(link.known.lower_bound_m);
  }
}

}  // namespace berth_ros
