#include <pybind11/stl.h>

#include <mutex>
#include <shared_mutex>

#include "arrays.hpp"
#include "berth/pipeline/configuration_check.hpp"
#include "bindings.hpp"
#include "handles.hpp"

namespace berth::python {
namespace {

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The check with the frames that it was prepared with.
class SharedCheck {
 public:
  explicit SharedCheck(const std::shared_ptr<Robot>& robot) : check_(robot) {}

  ResultStatus prepare(const py::object& of, std::optional<double> now_s) {
    std::vector<std::shared_ptr<const Frame>> frames = frames_of(of);
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    frames_ = std::move(frames);
    return check_.prepare(frames_, now_s);
  }

  py::array ask(const Rows& configurations, const ConfigurationMargins& margins, bool resolve) {
    const std::span<const double> positions = numbers_of(configurations, "configurations");
    return verdicts(configurations.shape(0), [&](std::span<Verdict> out) {
      check_.ask(positions, margins, out);
      if (resolve) check_.resolve(positions, margins, out);
    });
  }

  py::array ask_motions(const Rows& from, const Rows& to, const ConfigurationMargins& margins) {
    const std::span<const double> first = numbers_of(from, "from_configurations");
    const std::span<const double> last = numbers_of(to, "to_configurations");
    return verdicts(from.shape(0),
                    [&](std::span<Verdict> out) { check_.ask_motions(first, last, margins, out); });
  }

 private:
  std::span<const double> numbers_of(const Rows& rows, const char* name) const {
    const auto joints = std::ssize(check_.robot().model().joints);
    if (rows.ndim() == 2 && rows.shape(1) == joints) {
      return {rows.data(), static_cast<std::size_t>(rows.size())};
    }
    throw std::invalid_argument(fmt::format("{}: {} dimensions; expected an array of N x {} joints",
                                            name, rows.ndim(), joints));
  }
  template <class Ask>
  py::array verdicts(py::ssize_t count, const Ask& ask) {
    py::array_t<std::uint8_t> out(count);
    const std::span<Verdict> of{reinterpret_cast<Verdict*>(out.mutable_data()),
                                static_cast<std::size_t>(count)};
    const py::gil_scoped_release release;
    const std::shared_lock lock(mutex_);
    ask(of);
    return out;
  }

  std::shared_mutex mutex_;
  ConfigurationCheck check_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

ConfigurationMargins margins_of(double margin_m,
                                const std::map<std::string, double>& link_margins_m,
                                const std::vector<std::string>& without,
                                std::optional<double> known_margin_m) {
  return {margin_m, {link_margins_m.begin(), link_margins_m.end()}, without, known_margin_m};
}

}  // namespace

void bind_configurations(py::module_& m) {
  py::class_<SharedCheck>(
      m, "ConfigurationCheck",
      "Whether a robot would be free at each of very many configurations, or on motions between\n"
      "them, for what the cameras see now: for planners and sampling controllers. Free and near "
      "are\n"
      "certified. Any number of threads may ask.")
      .def(py::init<const std::shared_ptr<Robot>&>(), py::arg("robot"),
           py::call_guard<py::gil_scoped_release>())
      .def("prepare", &SharedCheck::prepare, py::arg("frames"), py::arg("now_s") = std::nullopt,
           "Takes up the newest Frame of each camera, as Query.ask does. Returns a ResultStatus:\n"
           "while it is stale, all verdicts are undecided; where it is degraded, a camera is left\n"
           "out, and more may be free than with it.")
      .def(
          "ask",
          [](SharedCheck& self, const Rows& configurations, double margin_m,
             const std::map<std::string, double>& link_margins_m,
             const std::vector<std::string>& without, std::optional<double> known_margin_m,
             bool resolve) {
            return self.ask(configurations,
                            margins_of(margin_m, link_margins_m, without, known_margin_m), resolve);
          },
          py::arg("configurations"), py::arg("margin_m") = 0.03,
          py::arg("link_margins_m") = std::map<std::string, double>(),
          py::arg("without") = std::vector<std::string>(), py::arg("known_margin_m") = std::nullopt,
          py::arg("resolve") = false,
          "uint8, one Verdict for each row of configurations (N x joints, rad or m): free, each\n"
          "moved link is farther than its margin from all that is seen or unknown; near, one is\n"
          "not; undecided. link_margins_m: other margins by the links' names; without: links that\n"
          "are not asked about; known_margin_m: the margin to the environment, own links and "
          "other\n"
          "robots, which count only with it. resolve: the exact search decides what is undecided,\n"
          "some milliseconds each.")
      .def(
          "ask_motions",
          [](SharedCheck& self, const Rows& from, const Rows& to, double margin_m,
             const std::map<std::string, double>& link_margins_m,
             const std::vector<std::string>& without, std::optional<double> known_margin_m) {
            return self.ask_motions(from, to,
                                    margins_of(margin_m, link_margins_m, without, known_margin_m));
          },
          py::arg("from_configurations"), py::arg("to_configurations"), py::arg("margin_m") = 0.03,
          py::arg("link_margins_m") = std::map<std::string, double>(),
          py::arg("without") = std::vector<std::string>(), py::arg("known_margin_m") = std::nullopt,
          "The same for straight motions in joint space, row by row from the one to the other.");
}

}  // namespace berth::python
