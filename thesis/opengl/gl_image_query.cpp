#include "thesis/opengl/gl_image_query.hpp"

#include <stdexcept>
#include <string>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "thesis/image_method.hpp"
#include "thesis/image_result.hpp"
#include "thesis/opengl/gl_evaluate.hpp"
#include "thesis/opengl/gl_frame_images.hpp"
#include "thesis/opengl/gl_robot_renderer.hpp"

namespace berth {
namespace {

void require_opengl(Method method) {
  if (runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " does not run on OpenGL; expected one that does");
}

class MethodOnGl : public ImageMethod {
 public:
  explicit MethodOnGl(Method method) : method_(method) {}

  void evaluate(const ImageRequest& request, LinkDistances& out) override {
    evaluator_.evaluate(method_, request, out);
  }

 private:
  Method method_;
  GlEvaluator evaluator_;
};

}  // namespace

std::unique_ptr<ImageMethod> make_gl_method(Method method) {
  require_opengl(method);
  return std::make_unique<MethodOnGl>(method);
}

struct GlImageQuery::Parts {
  Parts(std::shared_ptr<const Robot> of, Method named, const ImageSettings& with)
      : robot(std::move(of)),
        method(named),
        settings(settings_of(*robot, with)),
        result(empty_image_result(*robot, named, with)) {
    require_opengl(named);
  }

  bool begin(const GlFrame& frame, std::optional<double> joints_stamp_s,
             std::optional<double> now_s);
  void render(const RobotPose& pose, const GlFrame& frame);
  void evaluate(const GlFrame& frame, const GlRobotImage& of_robot);

  std::shared_ptr<const Robot> robot;
  Method method;
  ImageDistanceSettings settings;
  GlEvaluator evaluator;
  /// Of the camera that was asked last, made at the first request at other joint angles than those
  /// of the exposure.
  std::optional<GlRobotRenderer> renderer;
  std::shared_ptr<const MountedCamera> rendered_view;
  GlRobotImage asked_on_gl;
  LinkDistances distances;
  ImageResult result;
};

GlImageQuery::GlImageQuery(std::shared_ptr<const Robot> robot, Method method,
                           const ImageSettings& settings)
    : parts_(std::make_unique<Parts>(std::move(robot), method, settings)) {}

GlImageQuery::~GlImageQuery() = default;

const ImageResult& GlImageQuery::ask(const GlFrame& frame, std::optional<double> now_s) {
  if (!parts_->begin(frame, {}, now_s)) return parts_->result;
  parts_->result.pose.X_BL = frame.pose.X_BL;
  parts_->evaluate(frame, frame.images->robot);
  return parts_->result;
}

const ImageResult& GlImageQuery::ask(const GlFrame& frame, const JointState& joints,
                                     std::optional<double> now_s) {
  if (!parts_->begin(frame, joints.stamp_s, now_s)) return parts_->result;
  forward_kinematics(parts_->robot->model(), joints.position, parts_->result.pose);
  parts_->render(parts_->result.pose, frame);
  parts_->evaluate(frame, parts_->asked_on_gl);
  return parts_->result;
}

bool GlImageQuery::Parts::begin(const GlFrame& frame, std::optional<double> joints_stamp_s,
                                std::optional<double> now_s) {
  const CameraState camera =
      camera_state(frame, now_s.value_or(frame.stamp_s), robot->settings().time);
  return begin_image_result(*robot, frame, camera, joints_stamp_s, TimeStatus::ok, now_s, result);
}

void GlImageQuery::Parts::render(const RobotPose& pose, const GlFrame& frame) {
  if (rendered_view != frame.mounted) {
    rendered_view = frame.mounted;
    const Camera& camera = frame.mounted->camera();
    renderer.emplace(robot->model(), camera);
    asked_on_gl = GlRobotImage(camera.width_px, camera.height_px);
  }
  renderer->render(pose, frame.X_BC, asked_on_gl);
}

void GlImageQuery::Parts::evaluate(const GlFrame& frame, const GlRobotImage& of_robot) {
  evaluator.evaluate(method, frame.mounted->camera(), of_robot, frame.images->obstacles.depth_m,
                     robot->model().link_count(), settings, distances);
  tell_image_distances(distances, frame.X_BC, result);
}

}  // namespace berth
