# What users of an installed berth include. Installed are these and what they include; nothing else. A header's name here is a
# promise to document it (make docs) and to tell of its changes (CHANGELOG.md).
set(BERTH_PUBLIC_HEADERS
  berth/berth.hpp
  berth/types/camera.hpp
  berth/types/status.hpp
  berth/types/image.hpp
  berth/types/joint_state.hpp
  berth/types/setting.hpp
  berth/files/camera_info.hpp
  berth/files/edit_distance.hpp
  berth/files/joints_csv.hpp
  berth/robot/joint_buffer.hpp
  berth/robot/joint_trajectory.hpp
  berth/robot/kinematics.hpp
  berth/robot/mesh_file/mesh_file.hpp
  berth/robot/package_path.hpp
  berth/robot/primitives.hpp
  berth/robot/robot_model.hpp
  berth/pipeline/timeliness.hpp
  berth/pipeline/frame.hpp
  berth/pipeline/frame_pool.hpp
  berth/pipeline/observer.hpp
  berth/pipeline/prepared_space.hpp
  berth/pipeline/configuration_check.hpp
  berth/pipeline/query.hpp
  berth/pipeline/request.hpp
  berth/pipeline/result.hpp
  berth/pipeline/robot.hpp
  berth/pipeline/space_map.hpp
  berth/pipeline/mounted_camera.hpp
  berth/live/joint_intake.hpp
  berth/live/live_camera.hpp
  berth/live/live_space.hpp
  berth/live/raw_depth.hpp
  berth/control/distance_rows.hpp
  berth/control/velocity_filter.hpp
  berth/separation/protective_distance.hpp
  berth/separation/monitor.hpp
  berth/separation/settings.hpp
  berth/record/monitor_loop.hpp
  berth/record/recorder.hpp
  berth/record/replay.hpp
  berth/results/result_json.hpp
  berth/results/result_text.hpp
  berth/scene/live_plausibility.hpp
  berth/scene/open_scene.hpp
  berth/scene/plausibility.hpp
  berth/scene/scene_file.hpp
  berth/scene/scene_run.hpp)

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
