# What users of an installed berth include. Installed are these and what they include; nothing else. A header's name here is a
# promise to document it (make docs) and to tell of its changes (CHANGELOG.md).
set(BERTH_PUBLIC_HEADERS
  berth/berth.hpp
  berth/types/camera.hpp
  berth/types/camera_status.hpp
  berth/types/image.hpp
  berth/types/joint_state.hpp
  berth/types/link_distance.hpp
  berth/types/link_visibility.hpp
  berth/types/obstacle_image.hpp
  berth/types/robot_image.hpp
  berth/types/setting.hpp
  berth/types/space_pair.hpp
  berth/types/time_status.hpp
  berth/types/whole_link_distance.hpp
  berth/files/camera_info.hpp
  berth/files/joints_csv.hpp
  berth/files/png.hpp
  berth/robot/joint_buffer.hpp
  berth/robot/joint_trajectory.hpp
  berth/robot/kinematics.hpp
  berth/robot/robot_model.hpp
  berth/robot/robot_region.hpp
  berth/render/robot_renderer.hpp
  berth/self_filter/self_filter.hpp
  berth/self_filter/settings.hpp
  berth/sensor/sensor_rules.hpp
  berth/sensor/settings.hpp
  berth/distance/evaluate.hpp
  berth/distance/settings.hpp
  berth/distance/mesh/settings.hpp
  berth/visibility/doubtful.hpp
  berth/visibility/visibility.hpp
  berth/calibration/calibrate.hpp
  berth/calibration/filter_settings.hpp
  berth/calibration/pose_watch.hpp
  berth/pipeline/answer.hpp
  berth/pipeline/asker.hpp
  berth/pipeline/frame.hpp
  berth/pipeline/frame_set.hpp
  berth/pipeline/observer.hpp
  berth/pipeline/robot.hpp
  berth/pipeline/trajectory.hpp
  berth/pipeline/view.hpp
  berth/live/joint_intake.hpp
  berth/live/live_asker.hpp
  berth/live/live_camera.hpp
  berth/live/raw_depth.hpp
  berth/separation/evasion.hpp
  berth/separation/monitor.hpp
  berth/separation/separation.hpp
  berth/separation/settings.hpp
  berth/opengl/gl_asker.hpp
  berth/opengl/gl_context.hpp
  berth/opengl/gl_evaluate.hpp
  berth/opengl/gl_frame.hpp
  berth/opengl/gl_observer.hpp
  berth/opengl/gl_robot_renderer.hpp
  berth/opengl/gl_self_filter.hpp
  berth/scene/answer_result.hpp
  berth/scene/backend.hpp
  berth/scene/calibrate_scene.hpp
  berth/scene/calibration_json.hpp
  berth/scene/calibration_table.hpp
  berth/scene/frame_result.hpp
  berth/scene/open_scene.hpp
  berth/scene/plausibility.hpp
  berth/scene/result_json.hpp
  berth/scene/result_table.hpp
  berth/scene/scene_file.hpp
  berth/scene/scene_run.hpp
  berth/scene/separation_text.hpp
  berth/scene/teach_background.hpp)

cmake_policy(VERSION 3.22)  # also where an install script includes this file

# berth_with_includes(<out> <folder> <header>...): the headers, relative to the folder, and those of berth that they include.
function(berth_with_includes out folder)
  set(todo ${ARGN})
  set(found)
  while(todo)
    list(POP_FRONT todo header)
    if(header IN_LIST found)
      continue()
    endif()
    if(NOT EXISTS ${folder}/${header})
      message(FATAL_ERROR "${header} is not in ${folder}; cmake/PublicHeaders.cmake names it, or a header does that it names")
    endif()
    list(APPEND found ${header})
    file(STRINGS ${folder}/${header} lines REGEX "^#include \"berth/")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
      list(APPEND todo ${included})
    endforeach()
  endwhile()
  list(SORT found)
  set(${out} ${found} PARENT_SCOPE)
endfunction()
