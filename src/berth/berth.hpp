// All that a program needs to put berth to work on the processor:
//
//   load_robot()   a URDF and its meshes -> RobotModel
//   Robot          the model and how requests about it are answered: constant, shared
//   MountedCamera           one camera that sees the robot: constant, shared
//   Observer       depth image + joint angles at the exposure -> Frame. The camera's clock
//   Query          newest frames + any joint angles -> Result. The controller's clock
//   JointBuffer    the newest joint angles of a running robot
//
// What else there is has headers of its own: berth/scene/scene_run.hpp runs scene files.
//
// **Threads.** An Observer and a Query belong to one thread each. Inside of a call they use all
// processors, by TBB. To give them fewer, hold a limit while you call, such as
//
//   #include <oneapi/tbb/global_control.h>
//   tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
//
// It holds for the whole process while the object lives. 1 keeps all work in the calling thread.
//
// **Warming up.** Buffers grow at first use and then stay. The first request takes about 4 times
// as long as the later ones, the first image about 3 times: let both happen before it matters.
//
// **Errors.** What is wrong with a file throws std::runtime_error, what is wrong with a setting, an
// image's size or the number of joints std::invalid_argument. Both name the value and what was
// expected. Trouble with time is no exception but a status of the result (TimeStatus).
#pragma once

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/robot/joint_buffer.hpp"
#include "berth/robot/robot_model.hpp"

/// How far each link of a robot is from what depth cameras see.
namespace berth {}
