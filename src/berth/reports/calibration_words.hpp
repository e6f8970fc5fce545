// A calibration in words: the sentences that table and page share.
#pragma once

#include <string>
#include <vector>

#include "berth/reports/calibration_report.hpp"

namespace berth {

/// "12.3 mm"; "unknown" for NaN.
std::string mm_text(double length_m);

/// How far the robot moved before the camera and how sure that is, or why the pose stays.
std::string headline(const CameraCalibration& camera);

/// The clock that was found, or why it was not.
std::string clock_text(const CameraCalibration& camera, const CalibrationCamera& source);

/// How wrong the camera's depths are at `depth_m`, and whether the new scene corrects that.
std::string depth_text(const CameraCalibration& camera, double depth_m, bool corrects_depth);

/// What the images do not tell of the camera, as sentences. Of its clock, see clock_text().
std::vector<std::string> open_questions(const CameraCalibration& camera);

/// A setting's value with its unit, which its name ends in: "3 cm", "20 px".
std::string value_text(const ProposedSetting& setting);

/// What the proposed settings mean: what is taken for the robot though it stands before it, what
/// they leave of the robot, how near to it a rod is seen.
std::vector<std::string> consequences(const FilterProposal& proposal);

/// "3 mm", or that even the widest is not kept.
std::string smallest_width_text(double width_m);

/// What the cameras detect together, as sentences. None where nobody measured it.
std::vector<std::string> detection_texts(const DetectionMap& map);

/// What a link carries that its URDF does not have, how large it is and how well that is proven, as
/// a sentence.
std::string attached_text(const AttachedPart& part);

/// What becomes of it, as a sentence.
std::string attached_use_text(const AttachedPart& part);

}  // namespace berth
