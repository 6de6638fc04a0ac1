// The module hyalite._hyalite: the library's types for Python, as host/python/hyalite/__init__.py shows them to people.
//
// Arrays go in as anything that numpy makes an array of, and come out as views of the library's memory. The GIL is
// released while the library works; numpy is loaded with the first array.
#include "hyalite/hyalite.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace py::literals;

namespace {

[[noreturn]] void refuse(const std::string &what, const std::string &found, const std::string &allowed) {
    throw hyalite::Error(hyalite::ErrorKind::Usage, what + ": found " + found + "; allowed: " + allowed);
}

/// As Python shows it, in a length that a message can have.
std::string textOf(const py::handle &object) {
    constexpr std::size_t most = 100;
    std::string text = py::str(py::repr(object).attr("encode")("utf-8", "replace").attr("decode")("utf-8"));
    return text.size() > most ? text.substr(0, most) + "..." : text;
}

std::string shapeOf(const py::array &array) {
    return "an array of shape " + std::string(py::str(array.attr("shape"))) + " and type " +
           std::string(py::str(array.dtype()));
}

/// An array of numbers without gaps. `kinds` are the kinds of numpy's types that are converted.
template <class Number>
py::array_t<Number, py::array::c_style> arrayOf(const py::object &object, const char *what,
                                                const char *allowed, std::string_view kinds) {
    if (py::hasattr(object, "mask") &&
        py::module_::import("numpy").attr("any")(object.attr("mask")).cast<bool>())
        refuse(what, "a masked array", allowed);
    const py::array array = object.is_none() ? py::array() : py::array::ensure(object);
    if (object.is_none() || !array) {
        PyErr_Clear();
        refuse(what, textOf(py::type::of(object)), allowed);
    }
    if (kinds.find(array.dtype().kind()) == std::string_view::npos)
        refuse(what, shapeOf(array), allowed);
    return py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(array);
}

/// A table with so many columns; None is an empty one if it `isOptional`.
template <class Number>
py::array_t<Number, py::array::c_style> tableOf(const py::object &object, const char *what,
                                                py::ssize_t columns, const char *allowed,
                                                bool isOptional = true) {
    if (object.is_none() && isOptional)
        return py::array_t<Number, py::array::c_style>(std::vector<py::ssize_t>{0, columns});
    auto table = arrayOf<Number>(object, what, allowed, "fiu");
    if (table.ndim() != 2 || table.shape(1) != columns)
        refuse(what, shapeOf(table), allowed);
    return table;
}

template <class Number> std::span<const Number> spanOf(const py::array_t<Number, py::array::c_style> &array) {
    return {array.data(), static_cast<std::size_t>(array.size())};
}

/// A view of the library's memory, which `owner` keeps.
template <class Number>
py::array viewOf(std::span<const Number> values, std::vector<py::ssize_t> shape, const py::object &owner) {
    py::array view(py::dtype::of<Number>(), std::move(shape), values.data(), owner);
    view.attr("setflags")("write"_a = false);
    return view;
}

hyalite::Value valueOf(const std::string &name, py::object value) {
    if (py::hasattr(value, "ndim") && value.attr("ndim").cast<int>() == 0)
        value = value.attr("item")(); // of numpy
    if (py::hasattr(value, "__fspath__"))
        value = value.attr("__fspath__")();
    if (py::isinstance<py::bool_>(value))
        return value.cast<bool>();
    try {
        if (py::isinstance<py::str>(value))
            return value.cast<std::string>();
        if (PyNumber_Check(value.ptr()) != 0 && PySequence_Check(value.ptr()) == 0)
            return value.cast<double>();
        return value.cast<std::vector<double>>();
    } catch (const py::cast_error &) {
        refuse(name, textOf(value), "a number, a text, or several numbers");
    }
}

hyalite::Settings settingsOf(const py::dict &values) {
    hyalite::Settings settings;
    for (const auto &[key, value] : values)
        if (!value.is_none())
            settings.set(key.cast<std::string>(),
                         valueOf(key.cast<std::string>(), py::reinterpret_borrow<py::object>(value)));
    return settings;
}

/// Work of the library without the GIL: its threads call Python, so that the interpreter must not end before it.
std::atomic<int> workCount = 0;
std::atomic<bool> isEnding = false;

/// The library's work, without the GIL.
template <class Work> auto released(const Work &work) {
    struct Counted {
        Counted() { ++workCount; }
        ~Counted() { --workCount; }
        Counted(const Counted &) = delete;
        Counted &operator=(const Counted &) = delete;
    };
    if (isEnding)
        throw hyalite::Error(hyalite::ErrorKind::Stopped, "the interpreter ends");
    const Counted counted;
    const py::gil_scoped_release release;
    return work();
}

/// Stops the work of other threads, and waits for it.
void endWork() {
    isEnding = true;
    const py::gil_scoped_release release;
    while (workCount > 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

/// Python's callbacks, and its signals: Ctrl-C is an exception of the callback that asks for it.
hyalite::Watch watchOf(const py::object &progress, const py::object &message) {
    hyalite::Watch watch;
    if (!progress.is_none())
        watch.progress = [&progress](const std::string &task, double share) {
            const py::gil_scoped_acquire gil;
            progress(task, share);
        };
    if (!message.is_none())
        watch.message = [&message](hyalite::MessageKind kind, const std::string &text) {
            const py::gil_scoped_acquire gil;
            const char *word = kind == hyalite::MessageKind::Warning ? "warning"
                               : kind == hyalite::MessageKind::Note  ? "note"
                                                                     : "advice";
            message(word, py::str(py::bytes(text).attr("decode")("utf-8", "replace")));
        };
    watch.shouldStop = [] {
        if (isEnding)
            return true;
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0)
            throw py::error_already_set();
        return false;
    };
    return watch;
}

py::object parsed(const std::string &json) { return py::module_::import("json").attr("loads")(json); }

py::dict raysOf(const hyalite::Image &image) {
    const hyalite::RayCounts rays = image.rays();
    return py::dict("primary"_a = rays.primary, "shadow"_a = rays.shadow, "reflection"_a = rays.reflection,
                    "refraction"_a = rays.refraction, "bounce"_a = rays.bounce);
}

py::dict layersOf(const py::object &self) {
    const auto &image = self.cast<const hyalite::Image &>();
    py::dict layers;
    for (const hyalite::Layer &layer : image.layers()) {
        std::vector<py::ssize_t> shape{image.height(), image.width()};
        if (layer.channels.size() > 1)
            shape.push_back(static_cast<py::ssize_t>(layer.channels.size()));
        layers[py::str(layer.name)] = viewOf(layer.values, std::move(shape), self);
    }
    return layers;
}

hyalite::Image imageOf(const py::object &pixels, const py::object &alpha) {
    constexpr const char *allowed = "(height, width, 3) of numbers, linear RGB";
    const auto array = arrayOf<float>(pixels, "pixels", allowed, "fiu");
    if (array.ndim() != 3 || array.shape(2) != 3)
        refuse("pixels", shapeOf(array), allowed);
    const auto width = static_cast<int>(array.shape(1));
    const auto height = static_cast<int>(array.shape(0));
    if (alpha.is_none())
        return {width, height, spanOf(array)};
    constexpr const char *allowedAlpha = "(height, width) of numbers in [0, 1]";
    const auto opacity = arrayOf<float>(alpha, "alpha", allowedAlpha, "fiu");
    if (opacity.ndim() != 2 || opacity.shape(0) != height || opacity.shape(1) != width)
        refuse("alpha", shapeOf(opacity), allowedAlpha);
    return {width, height, spanOf(array), spanOf(opacity)};
}

/// Returns what the file has lost.
std::vector<std::string> save(const hyalite::Image &image, const std::string &path, const std::string &tone,
                              bool isHalf, const std::string &compression) {
    std::vector<std::string> losses;
    released([&] {
        image.save(path,
                   {tone, isHalf, compression, [&](const std::string &text) { losses.push_back(text); }});
    });
    return losses;
}

void defineImage(py::module_ &module) {
    const auto shape = [](const hyalite::Image &image) {
        return std::vector<py::ssize_t>{image.height(), image.width(), 3};
    };
    py::class_<hyalite::Image>(module, "Image")
        .def(py::init(&imageOf))
        .def_static(
            "load",
            [](const std::string &path) { return released([&] { return hyalite::Image::load(path); }); })
        .def_property_readonly("width", &hyalite::Image::width)
        .def_property_readonly("height", &hyalite::Image::height)
        .def_property_readonly("is_display_encoded", &hyalite::Image::isDisplayEncoded)
        .def_property_readonly("is_finished", &hyalite::Image::isFinished)
        .def_property_readonly("seconds", &hyalite::Image::seconds)
        .def_property_readonly("rays", &raysOf)
        .def_property_readonly("provenance",
                               [](const hyalite::Image &image) { return parsed(image.provenance()); })
        .def_property_readonly("pixels",
                               [shape](const py::object &self) {
                                   const auto &image = self.cast<const hyalite::Image &>();
                                   return viewOf(image.pixels(), shape(image), self);
                               })
        .def_property_readonly("alpha",
                               [](const py::object &self) -> py::object {
                                   const auto &image = self.cast<const hyalite::Image &>();
                                   if (image.alpha().empty())
                                       return py::none();
                                   return viewOf(image.alpha(), {image.height(), image.width()}, self);
                               })
        .def_property_readonly("variance",
                               [shape](const py::object &self) -> py::object {
                                   const auto &image = self.cast<const hyalite::Image &>();
                                   if (image.variance().empty())
                                       return py::none();
                                   return viewOf(image.variance(), shape(image), self);
                               })
        .def_property_readonly("samples",
                               [](const py::object &self) -> py::object {
                                   const auto &image = self.cast<const hyalite::Image &>();
                                   if (image.samples().empty())
                                       return py::none();
                                   return viewOf(image.samples(), {image.height(), image.width()}, self);
                               })
        .def_property_readonly("layers", &layersOf)
        .def("save", &save)
        .def("png", [](const hyalite::Image &image, const std::string &tone) {
            return py::bytes(released([&] { return image.png(tone); }));
        });
}

/// Row-major 4 x 4 matrices, (n, 4, 4), as their numbers.
py::array_t<double, py::array::c_style> matricesOf(const py::object &object) {
    constexpr const char *allowed = "(n, 4, 4) of numbers, or (4, 4) for one instance";
    if (object.is_none())
        return py::array_t<double, py::array::c_style>(0);
    auto matrices = arrayOf<double>(object, "instances", allowed, "fiu");
    const auto last = matrices.ndim() - 1;
    if ((last != 1 && last != 2) || matrices.shape(last) != 4 || matrices.shape(last - 1) != 4)
        refuse("instances", shapeOf(matrices), allowed);
    if (matrices.size() == 0)
        refuse("instances", "none", "at least one; None: the mesh is there once, as it is");
    return matrices;
}

std::string addMesh(hyalite::Scene &scene, const py::object &vertices, const py::object &faces,
                    const py::object &normals, const py::object &uvs, const py::object &colours,
                    const std::string &material, const py::object &instances, const std::string &name) {
    constexpr const char *allowedFaces =
        "(m, 3) of whole numbers, indices of vertices; or (m, k) of polygons";
    const auto positions = tableOf<double>(vertices, "vertices", 3, "(n, 3) of numbers", false);
    if (positions.shape(0) == 0)
        refuse("vertices", "none", "(n, 3) of numbers");
    const auto indices = arrayOf<std::int64_t>(faces, "faces", allowedFaces, "iu");
    if (indices.ndim() != 2 || indices.shape(1) < 3)
        refuse("faces", shapeOf(indices), allowedFaces);
    std::vector<std::uint32_t> corners;
    corners.reserve(static_cast<std::size_t>(indices.size()));
    const bool isUnsigned = py::array::ensure(faces).dtype().kind() == 'u';
    for (const std::int64_t index : spanOf<std::int64_t>(indices)) {
        if (index < 0 || index >= positions.shape(0))
            refuse("faces",
                   "the index " + (isUnsigned ? std::to_string(static_cast<std::uint64_t>(index))
                                              : std::to_string(index)),
                   "from 0 to " + std::to_string(positions.shape(0) - 1));
        corners.push_back(static_cast<std::uint32_t>(index));
    }
    const auto normalTable =
        tableOf<double>(normals, "normals", 3, "(n, 3) of numbers, a row for each vertex");
    const auto uvTable = tableOf<double>(uvs, "uvs", 2, "(n, 2) of numbers, a row for each vertex");
    const auto colourTable =
        tableOf<float>(colours, "colours", 3, "(n, 3) of numbers in [0, 1], a row for each vertex");
    const auto matrices = matricesOf(instances);
    hyalite::MeshArrays arrays;
    arrays.vertices = spanOf(positions);
    arrays.faces = corners;
    arrays.cornersPerFace = static_cast<std::size_t>(indices.shape(1));
    arrays.normals = spanOf(normalTable);
    arrays.uvs = spanOf(uvTable);
    arrays.colours = spanOf(colourTable);
    return scene.addMesh(arrays, material, spanOf(matrices), name);
}

void addTexture(hyalite::Scene &scene, const std::string &name, const py::object &levels) {
    constexpr const char *allowed = "(height, width), or with 3 or 4 channels, of type uint8";
    const py::array given = py::array::ensure(levels);
    if (!given || !given.dtype().is(py::dtype::of<std::uint8_t>()) || given.ndim() < 2 || given.ndim() > 3) {
        PyErr_Clear();
        refuse("texture", given ? shapeOf(given) : textOf(py::type::of(levels)), allowed);
    }
    const auto array = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(given);
    scene.addTexture(name, static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
                     array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1,
                     {array.data(), static_cast<std::size_t>(array.size())});
}

void setEnvironment(hyalite::Scene &scene, const py::object &radiance, double scale, double rotateDegrees) {
    constexpr const char *allowed = "(height, width, 3) of numbers, linear RGB by longitude and latitude";
    const auto array = arrayOf<float>(radiance, "environment", allowed, "fiu");
    if (array.ndim() != 3 || array.shape(2) != 3)
        refuse("environment", shapeOf(array), allowed);
    scene.setEnvironment(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), spanOf(array),
                         scale, rotateDegrees);
}

void defineScene(py::module_ &module) {
    py::class_<hyalite::Scene>(module, "Scene")
        .def(py::init<>())
        .def(py::init<const hyalite::Scene &>())
        .def_static("load", &hyalite::Scene::load)
        .def_static("from_json", &hyalite::Scene::fromJson)
        .def("set", [](hyalite::Scene &scene, const std::string &key,
                       const std::string &json) { scene.set(key, json); })
        .def("add_material", [](hyalite::Scene &scene, const std::string &name,
                                const std::string &json) { scene.addMaterial(name, json); })
        .def("add_mesh", &addMesh)
        .def("add_texture", &addTexture)
        .def("set_environment", &setEnvironment)
        .def("json", &hyalite::Scene::json)
        .def("check", [](const hyalite::Scene &scene) { released([scene] { scene.check(); }); });
}

hyalite::Image render(hyalite::Renderer &renderer, const hyalite::Scene &scene, const py::dict &settings,
                      const std::vector<std::string> &layers, const std::optional<double> &timeLimit,
                      const py::object &progress, const py::object &message) {
    const hyalite::Settings values = settingsOf(settings);
    const hyalite::RenderOptions options{layers, timeLimit, watchOf(progress, message)};
    return released([&, scene = scene] { return renderer.render(scene, values, options); }); // as it is now
}

void defineRenderer(py::module_ &module) {
    py::class_<hyalite::Renderer>(module, "Renderer")
        .def(py::init([](const std::string &device, int threads, const std::string &kernel) {
            return released([&] {
                return std::make_unique<hyalite::Renderer>(
                    device, hyalite::RendererOptions{.threads = threads, .kernel = kernel});
            });
        }))
        .def_property_readonly("name", &hyalite::Renderer::name)
        .def_property_readonly("description", &hyalite::Renderer::description)
        .def_property_readonly("equal_bits", &hyalite::Renderer::equalBits)
        .def("render", &render);
}

py::dict differenceOf(const hyalite::Difference &difference) {
    const auto map = [&](const std::vector<float> &values) {
        return py::array_t<float>({difference.height, difference.width}, values.data());
    };
    return py::dict("identical"_a = difference.isIdentical, "differing_pixels"_a = difference.differingPixels,
                    "psnr"_a = difference.psnrDecibels, "ssim"_a = difference.ssim,
                    "flip"_a = difference.flip, "flip_map"_a = map(difference.flipMap),
                    "ssim_map"_a = map(difference.ssimMap), "error_map"_a = map(difference.errorMap),
                    "alpha_max"_a = difference.alphaMax, "alpha_mean"_a = difference.alphaMean,
                    "report"_a = parsed(difference.json));
}

void defineChecks(py::module_ &module) {
    module.def("devices", [] {
        py::list list;
        for (const hyalite::Device &device : released([] { return hyalite::devices(); }))
            list.append(parsed(device.json));
        return list;
    });
    module.def("diff", [](const hyalite::Image &reference, const hyalite::Image &test) {
        return differenceOf(released([&] { return hyalite::diff(reference, test); }));
    });
    module.def("compare", [](const hyalite::Scene &scene, const py::dict &settings, const std::string &device,
                             const std::string &against, const py::object &progress,
                             const py::object &message) {
        const hyalite::Settings values = settingsOf(settings);
        const hyalite::Watch watch = watchOf(progress, message);
        const hyalite::Comparison comparison =
            released([&, scene = scene] { return hyalite::compare(scene, values, device, against, watch); });
        return py::make_tuple(comparison.isEqual, comparison.first, comparison.second,
                              differenceOf(comparison.difference), parsed(comparison.json));
    });
    module.def("profile", [](const hyalite::Scene &scene, const py::dict &settings, const std::string &device,
                             int warmups, int repeats, bool counts, bool isUnverified,
                             const std::optional<double> &timeLimit, const py::object &progress,
                             const py::object &message) {
        const hyalite::Settings values = settingsOf(settings);
        const hyalite::ProfileOptions options{
            device, warmups, repeats, counts, isUnverified, timeLimit, watchOf(progress, message)};
        return parsed(released([&, scene = scene] { return hyalite::profile(scene, values, options); }).json);
    });
    module.def("inspect", [](const hyalite::Scene &scene, const py::dict &settings, bool withCoverage,
                             const py::object &progress, const py::object &message) {
        const hyalite::Settings values = settingsOf(settings);
        const hyalite::Watch watch = watchOf(progress, message);
        return parsed(
            released([&, scene = scene] { return hyalite::inspect(scene, values, withCoverage, watch); }));
    });
    module.def("verify", [](const std::string &device, const std::vector<std::string> &kernels,
                            const py::object &progress, const py::object &message) {
        const hyalite::Watch watch = watchOf(progress, message);
        return parsed(released([&] { return hyalite::verify(device, kernels, watch); }).json);
    });
}

/// Error, a RuntimeError, and UsageError, which is a ValueError, too. Both have the attribute "kind".
void defineErrors(py::module_ &module) {
    const auto define = [&](const char *name, const py::object &bases) {
        const std::string path = std::string("hyalite.") + name;
        auto type = py::reinterpret_steal<py::object>(PyErr_NewException(path.c_str(), bases.ptr(), nullptr));
        module.attr(name) = type;
        return type;
    };
    const py::object error = define("Error", py::reinterpret_borrow<py::object>(PyExc_RuntimeError));
    define("UsageError", py::make_tuple(error, py::reinterpret_borrow<py::object>(PyExc_ValueError)));
    py::register_local_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(std::move(thrown));
        } catch (const hyalite::Error &raised) {
            const bool isUsage = raised.kind() == hyalite::ErrorKind::Usage;
            const py::object type =
                py::module_::import("hyalite._hyalite").attr(isUsage ? "UsageError" : "Error");
            const py::object instance =
                type(py::str(py::bytes(raised.what()).attr("decode")("utf-8", "replace")));
            instance.attr("kind") = hyalite::toText(raised.kind());
            PyErr_SetObject(type.ptr(), instance.ptr());
        }
    });
}

} // namespace

PYBIND11_MODULE(_hyalite, module) {
    module.attr("__version__") = hyalite::version();
    module.attr("api_version") = py::make_tuple(HYALITE_API_MAJOR, HYALITE_API_MINOR, HYALITE_API_PATCH);
    defineErrors(module);
    defineImage(module);
    defineScene(module);
    defineRenderer(module);
    defineChecks(module);
    module.def("setting_names", &hyalite::settingNames);
    module.def("prepare_process", &hyalite::prepareProcess);
    module.def("end_work", &endWork);
}
