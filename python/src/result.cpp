// Results as classes made from visit_fields(): a field that is added to the list is here by itself.
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "berth/results/result_json.hpp"
#include "bindings.hpp"
#include "handles.hpp"

namespace berth::python {
namespace {

template <class T, class Visitor>
void visit(const Part<T>& part, Visitor&& visitor) {
  if constexpr (std::is_same_v<T, LinkResult>) {
    visit_fields(*part, *part.result, visitor);
  } else {
    visit_fields(*part, visitor);
  }
}

struct Ignore {
  void operator()(const Field&, const auto&) const {}
};
template <class T>
concept HasFields = requires(const T& value) {
  visit_fields(value, Ignore());
};

/// The value of a field as Python has it.
class ToPython {
 public:
  explicit ToPython(std::shared_ptr<const Result> result) : result_(std::move(result)) {}

  template <class T>
  py::object operator()(const T& value) const {
    if constexpr (HasFields<T>) {
      return py::cast(Part<T>{result_, &value});
    } else {
      return py::cast(value);
    }
  }
  template <class T>
  py::object operator()(const std::optional<T>& value) const {
    return value ? (*this)(*value) : py::none();
  }
  template <class T>
  py::object operator()(const std::vector<T>& values) const {
    py::list all;
    for (const T& value : values) all.append((*this)(value));
    return all;
  }
  py::object operator()(const std::vector<float>& numbers) const {
    return py::array_t<float>(std::ssize(numbers), numbers.data());
  }
  py::object operator()(const Eigen::Vector3f& p) const { return py::array_t<float>(3, p.data()); }
  py::object operator()(const Pixel& pixel) const {
    return pixel.u < 0 ? py::none() : py::object(py::make_tuple(pixel.u, pixel.v));
  }
  py::object operator()(const FateCounts& counts) const { return dict_of(counts); }
  py::object operator()(const CameraState& camera) const { return py::cast(camera.status); }
  py::object operator()(const CameraPlace& at) const {
    return at.place < 0 ? py::none() : py::cast(result_->cameras[at.place].camera);
  }
  py::object operator()(const KnownLink& at) const {
    return at.place < 0 ? py::none() : py::cast((*result_->link_names)[at.place]);
  }
  py::object operator()(const ObstacleOf& of) const {
    return of.pair.is_known() ? py::cast(of.pair.obstacle_is) : py::none();
  }
  py::object operator()(const SeparationOf&) const {
    return py::cast(Part<Separation>{result_, &*result_->separation});
  }

 private:
  std::shared_ptr<const Result> result_;
};

/// The type of that, as annotations have it.
template <class T>
std::string type_in_python(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    return std::is_same_v<T, bool> ? "bool" : std::is_integral_v<T> ? "int" : "float";
  } else if constexpr (std::is_convertible_v<T, std::string_view>) {
    return "str";
  } else if constexpr (std::is_enum_v<T>) {
    return py::str(py::type::of<T>().attr("__name__"));
  } else if constexpr (std::is_same_v<T, Eigen::Vector3f>) {
    return "numpy.ndarray";
  } else if constexpr (std::is_same_v<T, std::vector<float>>) {
    return "Optional[numpy.ndarray]";
  } else if constexpr (std::is_same_v<T, Pixel>) {
    return "Optional[Tuple[int, int]]";
  } else if constexpr (std::is_same_v<T, FateCounts>) {
    return "Dict[str, int]";
  } else if constexpr (std::is_same_v<T, CameraState>) {
    return type_in_python(value.status);
  } else if constexpr (std::is_same_v<T, CameraPlace> || std::is_same_v<T, KnownLink>) {
    return "Optional[str]";
  } else if constexpr (std::is_same_v<T, SeparationOf>) {
    return "Separation";
  } else if constexpr (std::is_same_v<T, ObstacleOf>) {
    return "Optional[" + type_in_python(value.pair.obstacle_is) + "]";
  } else if constexpr (requires { value.has_value(); }) {
    return "Optional[" + type_in_python(typename T::value_type()) + "]";
  } else if constexpr (requires { value.front(); }) {
    return "List[" + type_in_python(typename T::value_type()) + "]";
  } else {
    return py::str(py::type::of<Part<T>>().attr("__name__"));
  }
}

/// Nothing where this result has no such field.
template <class T>
py::object value_of(const Part<T>& part, std::string_view name) {
  py::object found = py::none();
  visit(part, [&](const Field& field, const auto& value) {
    if (field.name == name) found = ToPython(part.result)(value);
  });
  return found;
}

template <class T>
bool has_field(const Part<T>& part, std::string_view name) {
  bool found = false;
  visit(part, [&](const Field& field, const auto&) { found = found || field.name == name; });
  return found;
}

/// A property for each field of `full`, but those that the class has already. Those that `bare` has
/// not are None in some results.
template <class T>
void bind_fields(py::class_<Part<T>>& bound, const Part<T>& full, const Part<T>& bare) {
  const auto bind = [&](const std::string& name, const std::string& text) {
    bound.def_property_readonly(
        name.c_str(), [name](const Part<T>& part) { return value_of(part, name); }, text.c_str());
  };
  visit(full, [&](const Field& field, const auto& value) {
    const std::string name(field.name);
    if (py::hasattr(bound, name.c_str())) return;
    std::string type = type_in_python(value);
    if (!has_field(bare, name) && !type.starts_with("Optional")) type = "Optional[" + type + "]";
    bind(name, fmt::format("{}: {}", type, field.sentence));
  });
}

template <class T>
std::string text_of(const Part<T>& part, const std::string& name) {
  std::string text;
  visit(part, [&](const Field& field, const auto& value) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", field.name,
                        std::string(py::repr(ToPython(part.result)(value))));
  });
  return fmt::format("{}({})", name, text);
}

std::string text_of(const Part<LinkResult>& link, const std::string& name) {
  return fmt::format("{}({}, {}, {:.4f} m)", name, link->link, name_of(link->status),
                     link->distance_m);
}

template <class T>
py::class_<Part<T>> bind_part(py::module_& m, const char* name, const char* what,
                              const Part<T>& full, const Part<T>& bare) {
  py::class_<Part<T>> bound(m, name, what);
  bind_fields(bound, full, bare);
  bound.def("__repr__", [name](const Part<T>& part) { return text_of(part, name); });
  return bound;
}

/// Makes an array of all links for each number and point of `link`.
struct Columns {
  template <class T>
  void operator()(const Field& field, const T& value) const {
    constexpr int kCount = std::is_same_v<T, float>             ? 1
                           : std::is_same_v<T, Eigen::Vector3f> ? 3
                                                                : 0;
    if constexpr (std::is_base_of_v<SpacePair, T> || std::is_same_v<T, KnownPair>) {
      const bool is_known = std::is_same_v<T, KnownPair>;
      visit_fields(value, Columns{bound, link, std::string(field.name) + "_",
                                  is_known ? "to what is known: " : "to what is occupied alone: "});
    } else if constexpr (kCount > 0) {
      const auto offset =
          reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(&link);
      bound.def_property_readonly(
          (prefix + std::string(field.name)).c_str(),
          [offset](const py::object& self) {
            const std::vector<LinkResult>& links = self.cast<const Part<Result>&>()->links;
            std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(links.size())};
            std::vector<py::ssize_t> strides = {sizeof(LinkResult)};
            if (kCount > 1) {
              shape.push_back(kCount);
              strides.push_back(sizeof(float));
            }
            const char* first = reinterpret_cast<const char*>(links.data()) + offset;
            return read_only(reinterpret_cast<const float*>(first), shape, strides, self);
          },
          fmt::format("numpy.ndarray: ({}), {}{}", kCount > 1 ? "links, 3" : "links,", of,
                      field.sentence)
              .c_str());
    }
  }

  py::class_<Part<Result>>& bound;
  const LinkResult& link;
  std::string prefix = {};
  std::string of = {};
};

using ResultPart = Part<Result>;
using LinkPart = Part<LinkResult>;

LinkPart link_at(const ResultPart& result, py::ssize_t index) {
  const auto count = static_cast<py::ssize_t>(result->links.size());
  if (index < 0) index += count;
  if (index < 0 || index >= count) throw py::index_error(fmt::format("there are {} links", count));
  return {result.result, &result->links[index]};
}

std::vector<std::string> link_names(const ResultPart& result) {
  std::vector<std::string> names;
  for (const LinkResult& link : result->links) names.push_back(link.link);
  return names;
}

LinkPart link_named(const ResultPart& result, const std::string& name) {
  for (const LinkResult& link : result->links) {
    if (link.link == name) return {result.result, &link};
  }
  throw py::key_error(fmt::format("\"{}\" is no link of the robot; expected one of {}", name,
                                  fmt::join(link_names(result), ", ")));
}

std::optional<LinkPart> nearest(const ResultPart& result) {
  if (result->nearest < 0) return {};
  return link_at(result, result->nearest);
}

std::optional<LinkPart> nearest_to_all(const ResultPart& result) {
  const LinkResult* nearest = result->nearest_to_all();
  if (!nearest) return {};
  return LinkPart{result.result, nearest};
}

std::vector<bool> link_is_moved(const ResultPart& result) {
  std::vector<bool> moved;
  for (const LinkResult& link : result->links) moved.push_back(link.is_moved);
  return moved;
}

/// A row for each pose.
auto along(float SpacePair::*length) {
  return [length](const Part<LookAhead>& ahead) {
    const std::size_t links = ahead.result->links.size();
    py::array_t<float> table({ahead->poses.size(), links});
    for (std::size_t i = 0; i < ahead->poses.size(); ++i) {
      for (std::size_t k = 0; k < links; ++k) {
        table.mutable_at(i, k) = ahead->poses[i][k].nearest.*length;
      }
    }
    return table;
  };
}

void bind_look_ahead(py::module_& m) {
  py::class_<Part<LookAhead>>(m, "LookAhead",
                              "Poses that the robot may take, against what the cameras see now.")
      .def_property_readonly(
          "distance_m", along(&SpacePair::distance_m),
          "numpy.ndarray: (poses, links), as in Result; no pose where the result\n"
          "is stale")
      .def_property_readonly("lower_bound_m", along(&SpacePair::lower_bound_m),
                             "numpy.ndarray: (poses, links), as in Result")
      .def_property_readonly(
          "first_nearer", [](const Part<LookAhead>& ahead) { return ahead->first_nearer; },
          "Optional[int]: the first pose at which some link may be nearer than the limit");
}

}  // namespace

void bind_result(py::module_& m) {
  // One that has all that a result may have; what `bare` has not is not in each.
  const auto full = std::make_shared<Result>();
  full->has_visibility = true;
  full->has_candidates = true;
  full->link_names = std::make_shared<const std::vector<std::string>>();
  full->cameras.resize(1);
  full->links.resize(1);
  full->links[0].id = 1;
  full->links[0].is_moved = true;
  full->links[0].gradient = full->links[0].occupied.gradient = {0};
  full->links[0].known.gradient = {0};
  full->separation.emplace().links.resize(1);
  const auto bare = std::make_shared<Result>();
  const auto bind = [&]<class T>(const T& part, const char* name, const char* what) {
    return bind_part(m, name, what, Part<T>{full, &part}, Part<T>{bare, &part});
  };
  const LinkResult& link = full->links.front();
  bind(link.visibility.surface, "SightShares", "What cameras see of a surface or a space.");
  bind(link.visibility, "LinkVisibility", "What cameras see of a link and around it.");
  bind(link.occupied, "SpacePair", "The closest points of a link and of what is near.");
  bind(link.known, "KnownPair",
       "The closest points of a link and of the environment, other links and other robots.");
  bind(full->separation->links.front(), "LinkSeparation", "One link's part in a separation.");
  bind(full->time, "Timeliness", "How a result stands in time.");
  bind(full->cameras.front(), "CameraResult", "One camera's part in a result.");
  bind(link, "LinkResult", "One link's part in a result.");
  bind_look_ahead(m);
  py::class_<ResultPart> result(
      m, "Result",
      "All that a request gives; it stays as it is. Arrays have a row for each of link_names,\n"
      "look into the result, read only, and keep it alive. What is not known is NaN, a whole\n"
      "number -1, all else None. Points and directions are in the robot's root frame (base), or\n"
      "in the camera's optical frame (camera).");
  result.def_property_readonly("link_names", &link_names, "List[str]: the links, in this order")
      .def_property_readonly("link_is_moved", &link_is_moved,
                             "List[bool]: whether a joint moves the link")
      .def_property_readonly("nearest", &nearest,
                             "Optional[LinkResult]: the nearest link that a joint moves")
      .def_property_readonly("nearest_to_all", &nearest_to_all,
                             "Optional[LinkResult]: the moved link that is nearest to anything: "
                             "occupied, unknown or known")
      .def_property_readonly(
          "ahead",
          [](const ResultPart& r) {
            return Part<LookAhead>{r.result, &r->ahead};
          },
          "LookAhead: what was asked about poses ahead")
      .def("__getitem__", &link_at, py::arg("index"), "The link with this number.")
      .def("__getitem__", &link_named, py::arg("name"), "The link of this name.")
      .def("__len__", [](const ResultPart& r) { return r->links.size(); })
      .def(
          "to_json", [](const ResultPart& r) { return result_json(*r); },
          "As a line of `berth run --format json`.")
      .def("__repr__", [](const ResultPart& r) {
        const LinkResult* near = r->nearest_link();
        return fmt::format("Result({} links, {}{})", r->links.size(), name_of(r->status),
                           near ? fmt::format(", nearest {} {:.4f} m", near->link, near->distance_m)
                                : std::string());
      });
  visit_fields(link, *full, Columns{result, link});
  bind_fields(result, ResultPart{full, full.get()}, ResultPart{bare, bare.get()});
}

}  // namespace berth::python
