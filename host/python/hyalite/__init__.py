"""Hyalite: a ray tracer on any Vulkan device, whose every pixel can be checked.

    import hyalite
    image = hyalite.render("cornell", spp=64, width=320)
    image.pixels                 # numpy float32 (height, width, 3), linear RGB
    image.save("cornell.exr")

Scenes are files, names of shipped scenes, dictionaries as scene files have them, or arrays (`Scene`). World space is
right-handed with +y up; colours are linear RGB; rows of pixels come from the top.

Settings are those of the command line, with _ for -: spp=64, max_depth=5, integrator="path", width=640,
camera_position=(0, 1, 5). `setting_names()` lists them, and `hyalite render --help` says what each does. They override
what the scene says.

Errors are `hyalite.Error`, a RuntimeError whose `kind` is "bad input", "no device", "limit exceeded", "device lost",
"output not written", "stopped" or "internal"; or `hyalite.UsageError`, a ValueError, too, for settings and arguments.
Ctrl-C ends a render when its running dispatch ends, and the next one works. A process that was forked after the first
render gets an Error: start processes by the method "spawn".
"""

from __future__ import annotations

import atexit
import itertools
import json
import operator
import os
import threading
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _hyalite
from ._hyalite import Error, UsageError, __version__, api_version

Error.__doc__ = """What went wrong. `kind` is "bad input", "no device", "limit exceeded", "device lost", ..."""
Error.kind = "internal"
UsageError.__doc__ = """A setting or an argument that is not allowed; a ValueError, too."""
UsageError.kind = "usage"

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Comparison", "Difference", "Error", "Image", "Renderer", "Scene", "UsageError", "api_version", "compare",
    "devices", "diff", "inspect", "load_image", "prepare_process", "profile", "render", "setting_names", "verify",
]

Progress = Callable[[str, float], object]
"""Called with the task ("load", "render", ...) and its share that is finished, in [0, 1], by any thread."""

Message = Callable[[str, str], object]
"""Called with "warning", "note" or "advice" and a sentence."""

SceneLike = Union["Scene", str, "os.PathLike[str]", Mapping[str, Any]]


def _plain(value: Any) -> Any:
    """What json knows of numpy's arrays and numbers, of paths and of mappings."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        return dict(value)
    raise UsageError(f"scene: found {value!r:.100}; allowed: numbers, texts, lists, dictionaries and arrays")


def _text(document: Any) -> str:
    """JSON text of a document."""
    try:
        return json.dumps(document, default=_plain, allow_nan=False)
    except ValueError as error:
        if isinstance(error, UsageError):
            raise
        raise UsageError(f"scene: {error}; allowed: finite numbers") from None
    except TypeError as error:
        raise UsageError(f"scene: {error}") from None


def _called(**callbacks: Any) -> None:
    for name, callback in callbacks.items():
        if callback is not None and not callable(callback):
            raise UsageError(f"{name}: found {callback!r:.100}; allowed: something to call")


def _words(name: str, words: Sequence[str]) -> List[str]:
    if isinstance(words, str) or not all(isinstance(word, str) for word in words):
        raise UsageError(f"{name}: found {words!r:.100}; allowed: a list of names")
    return list(words)


def _seconds(limit: Optional[float]) -> Optional[float]:
    try:
        return None if limit is None else float(limit)
    except (TypeError, ValueError):
        raise UsageError(f"time_limit: found {limit!r:.100}; allowed: a number of seconds") from None


class Image:
    """Pixels, and what is known of them. They do not change: copy the arrays to work on them."""

    def __init__(self, pixels: ArrayLike, alpha: Optional[ArrayLike] = None):
        """An image of one's own pixels: (height, width, 3), linear RGB; multiplied by `alpha`, (height, width), if it is
        given."""
        self._image = pixels if isinstance(pixels, _hyalite.Image) else _hyalite.Image(pixels, alpha)

    @property
    def pixels(self) -> NDArray[np.float32]:
        """The means of the samples, (height, width, 3), linear RGB; of a PNG that was loaded, its levels in [0, 1].
        A view, without a copy."""
        return self._image.pixels

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        pixels = self.pixels
        if dtype is not None and pixels.dtype != dtype:
            return pixels.astype(dtype)
        return pixels.copy() if copy else pixels

    @property
    def alpha(self) -> Optional[NDArray[np.float32]]:
        """Opacity in [0, 1], (height, width), by which `pixels` are multiplied, unless they are those of a PNG. None of
        an opaque image."""
        return self._image.alpha

    @property
    def variance(self) -> Optional[NDArray[np.float32]]:
        """The unbiased estimate of the variance of `pixels`, of their shape; NaN below two samples a pixel. None of an
        image that was not rendered."""
        return self._image.variance

    @property
    def samples(self) -> Optional[NDArray[np.uint32]]:
        """Samples of each pixel, (height, width). None of an image that was not rendered."""
        return self._image.samples

    @property
    def layers(self) -> Dict[str, NDArray[np.float32]]:
        """The layers that were asked for, by name: (height, width, channels), or (height, width) of one channel.
        "depth" is planar, along the view direction, and 1e10 where nothing is met."""
        return self._image.layers

    @property
    def width(self) -> int:
        """In pixels."""
        return self._image.width

    @property
    def height(self) -> int:
        """In pixels."""
        return self._image.height

    @property
    def shape(self) -> Tuple[int, int, int]:
        """(height, width, 3)"""
        return (self.height, self.width, 3)

    @property
    def is_finished(self) -> bool:
        """Whether all samples are there; false if the time limit has ended the render."""
        return self._image.is_finished

    @property
    def rays(self) -> Dict[str, int]:
        """Numbers of rays that were traced, by kind."""
        return self._image.rays

    @property
    def seconds(self) -> float:
        """Time in the renderer, from the first ray to the last."""
        return self._image.seconds

    @property
    def provenance(self) -> Dict[str, Any]:
        """What was rendered, how, and by what, as the files have it in their attributes."""
        return self._image.provenance

    def __copy__(self) -> Image:
        return self  # it does not change

    def __deepcopy__(self, memo: Any) -> Image:
        return self

    def save(
        self,
        path: Union[str, os.PathLike[str]],
        tone: str = "gamma",
        *,
        half: bool = False,
        compression: str = "zip",
    ) -> None:
        """Writes a .png, .exr, .hdr or .pfm file, which appears whole or not at all. An EXR has the layers; PNG and EXR
        have alpha.

        tone: a PNG's curve, "gamma", "srgb", "aces" or "agx".
        half: an EXR's colours are 16-bit floats, at most 65504; data stay 32-bit.
        compression: an EXR's; "none", "rle", "zips", "zip" and "piz" keep every bit, "pxr24", "b44", "b44a", "dwaa" and
        "dwab" do not.

        What the file loses is a warning."""
        for loss in self._image.save(os.fsencode(path), tone, bool(half), str(compression)):
            warnings.warn(loss, stacklevel=2)

    def png(self, tone: str = "gamma") -> bytes:
        """The bytes of a PNG."""
        return self._image.png(tone)

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        return f"<hyalite.Image {self.width}x{self.height}>"


def load_image(path: Union[str, os.PathLike[str]]) -> Image:
    """Reads colours and alpha of a PNG, OpenEXR, Radiance or PFM file."""
    return Image(_hyalite.Image.load(os.fsencode(path)))


class Scene:
    """A file, a shipped scene, a dictionary as scene files have it, or what is added to an empty scene.

    What is added to an empty scene is framed and, if nothing shines, lit as a bare mesh is, until the scene gets a
    "camera"."""

    def __init__(self, source: Optional[SceneLike] = None, folder: Union[str, os.PathLike[str]] = "."):
        """`folder` is where the files that a dictionary names are."""
        if source is None:
            self._scene = _hyalite.Scene()
        elif isinstance(source, Scene):
            self._scene = _hyalite.Scene(source._scene)
        elif isinstance(source, Mapping):
            self._scene = _hyalite.Scene.from_json(_text(dict(source)), os.fsencode(folder))
        else:
            try:
                self._scene = _hyalite.Scene.load(os.fsencode(source))
            except TypeError:
                raise UsageError(
                    f"scene: found {source!r:.100}; allowed: a file, the name of a shipped scene, or a dictionary"
                ) from None

    def __copy__(self) -> Scene:
        return Scene(self)

    def __deepcopy__(self, memo: Any) -> Scene:
        return Scene(self)

    def __contains__(self, key: object) -> bool:
        return key in self.document

    def __iter__(self) -> Iterator[str]:
        return iter(self.document)

    def __setitem__(self, key: str, value: Any) -> None:
        """Sets a member of the document: scene["camera"] = {"position": [0, 1, 5], "target": [0, 0, 0]}."""
        if not isinstance(key, str):
            raise UsageError(f"scene: found {key!r:.100}; allowed: the name of a member")
        self._scene.set(key, _text(value))

    def __getitem__(self, key: str) -> Any:
        return self.document[key]

    @property
    def document(self) -> Dict[str, Any]:
        """The document, a copy; "file" of a mesh may be the name of its arrays."""
        return json.loads(self._scene.json())

    def add_material(self, name: str, material: Mapping[str, Any]) -> str:
        """Defines a material as scene files have it, such as {"type": "dielectric", "ior": 1.5}. Returns its name."""
        self._scene.add_material(name, _text(dict(material)))
        return name

    def add_mesh(
        self,
        vertices: ArrayLike,
        faces: ArrayLike,
        *,
        normals: Optional[ArrayLike] = None,
        uvs: Optional[ArrayLike] = None,
        colours: Optional[ArrayLike] = None,
        material: Union[None, str, Mapping[str, Any]] = None,
        instances: Optional[ArrayLike] = None,
        name: str = "",
    ) -> str:
        """Adds a mesh, of which the arrays are copied. Returns its name.

        vertices: (n, 3), world space unless instances place them; float64 is kept until a far scene is moved near zero.
        faces: (m, 3) indices of vertices, counter-clockwise seen from outside; or (m, k) of polygons, concave or not.
        normals: (n, 3), of any length. uvs: (n, 2), v grows upwards. colours: (n, 3), linear, in [0, 1].
        material: the name of one of the scene's, or a dictionary; None: matt grey, or white under colours.
        instances: (k, 4, 4) affine matrices to world space, which multiply columns; None: it is there once, as it is.
        """
        if not isinstance(name, str):
            raise UsageError(f"name: found {name!r:.100}; allowed: a text")
        if isinstance(material, Mapping):
            taken = self.document.get("materials", {})
            if not isinstance(taken, dict):
                self.add_material("material", material)  # says what is wrong with it
            material_name = next(key for key in map("material {}".format, itertools.count(1)) if key not in taken)
            text = _text(material)
            given = self._scene.add_mesh(vertices, faces, normals, uvs, colours, material_name, instances, name)
            self._scene.add_material(material_name, text)
            return given
        if not isinstance(material, (str, type(None))):
            raise UsageError(f"material: found {material!r:.100}; allowed: a name, a dictionary or None")
        return self._scene.add_mesh(vertices, faces, normals, uvs, colours, material or "", instances, name)

    def add_texture(self, name: str, levels: ArrayLike) -> str:
        """Defines a texture of uint8, (height, width) or (height, width, 3 or 4), sRGB where it is a colour, by the name
        that "file" has for it in materials. Returns the name."""
        self._scene.add_texture(str(name), levels)
        return name

    def set_environment(self, radiance: ArrayLike, *, scale: float = 1.0, rotate_degrees: float = 0.0) -> None:
        """Light from all around: (height, width, 3), linear RGB by longitude and latitude. The middle is -z."""
        try:
            numbers = float(scale), float(rotate_degrees)
        except (TypeError, ValueError):
            raise UsageError(f"environment: found {scale!r:.50} and {rotate_degrees!r:.50}; allowed: numbers") from None
        self._scene.set_environment(radiance, *numbers)

    def check(self) -> None:
        """Loads all of it. Raises Error for what a render would refuse."""
        self._scene.check()

    def __repr__(self) -> str:
        document = self.document
        shown = document["file"] if list(document) == ["file"] else ", ".join(document)
        return f"<hyalite.Scene {shown}".rstrip() + ">"


def _scene_of(scene: SceneLike) -> Any:
    return scene._scene if isinstance(scene, Scene) else Scene(scene)._scene


class Renderer:
    """A Vulkan device, or the CPU twin, that is opened once and renders many images.

    Threads may share it: their renders take turns, and those of several renderers run at once. It keeps the last scene,
    so that other views of it, with other cameras, sizes and samples, begin at once."""

    def __init__(self, device: str = "auto", *, threads: int = 0, kernel: str = ""):
        """`device`: "auto", "cpu" (the twin of the kernels), "cpu-double", or a device by index or part of its name.
        `threads`: of the CPU twin; 0: all. `kernel`: for experiments; the image is the same with each."""
        try:
            self._renderer = _hyalite.Renderer(str(device), operator.index(threads), str(kernel))
        except (TypeError, OverflowError):
            raise UsageError(f"threads: found {threads!r:.100}; allowed: a whole number") from None

    @property
    def name(self) -> str:
        """"cpu", or the name of the device."""
        return self._renderer.name

    @property
    def description(self) -> str:
        """For people: with index, driver and type."""
        return self._renderer.description

    @property
    def equal_bits(self) -> str:
        """How sure it is that images have the bits of the CPU twin's: "promised", or "measured" with the reason."""
        return self._renderer.equal_bits

    def render(
        self,
        scene: SceneLike,
        *,
        layers: Sequence[str] = (),
        time_limit: Optional[float] = None,
        progress: Optional[Progress] = None,
        message: Optional[Message] = None,
        **settings: Any,
    ) -> Image:
        """The image of a scene: the same on every device and machine, bit for bit.

        layers: views beside the colours, such as "albedo", "normal", "depth", "id".
        time_limit: in seconds; then it ends with what is finished.
        """
        _called(progress=progress, message=message)
        return Image(
            self._renderer.render(
                _scene_of(scene), settings, _words("layers", layers), _seconds(time_limit), progress, message
            )
        )

    def __repr__(self) -> str:
        return f"<hyalite.Renderer {self.name}>"


_renderers: Dict[str, Renderer] = {}
_renderers_lock = threading.Lock()
atexit.register(_renderers.clear)  # while the driver's threads are there
atexit.register(_hyalite.end_work)  # before that: renders of other threads


def _forget_lock() -> None:
    global _renderers_lock
    _renderers_lock = threading.Lock()  # a thread that had the old one is not in this process


os.register_at_fork(after_in_child=_forget_lock)


def _shared_renderer(device: str) -> Renderer:
    with _renderers_lock:
        if device not in _renderers:
            _renderers[device] = Renderer(device)
        return _renderers[device]


def render(scene: SceneLike, *, device: str = "auto", **options: Any) -> Image:
    """The image of a scene, by a device that is opened by the first call and stays open: see `Renderer.render`.
    A file is read by each call; a `Scene` is read once.

    hyalite.render("cornell", spp=64, layers=["albedo", "depth"])"""
    return _shared_renderer(str(device)).render(scene, **options)


class Difference(NamedTuple):
    """How two images differ. Maps are (height, width), float32."""

    identical: bool
    """In every bit."""
    differing_pixels: int
    psnr: float
    """In decibels, for a peak of 1; infinite for no error."""
    ssim: Optional[float]
    """Mean structural similarity; None for a side below 11 pixels, or NaN."""
    flip: float
    """Mean FLIP error: HDR-FLIP of linear images."""
    flip_map: NDArray[np.float32]
    """In [0, 1]."""
    ssim_map: NDArray[np.float32]
    """Of the window around each pixel; NaN near the edges."""
    error_map: NDArray[np.float32]
    """Squared errors."""
    alpha_max: float
    """Largest difference of alpha; an image without alpha is opaque."""
    alpha_mean: float
    """Mean absolute difference of alpha."""
    report: Dict[str, Any]
    """All metrics, as `hyalite diff --report` has them."""

    def __repr__(self) -> str:
        return f"<hyalite.Difference: {'identical' if self.identical else f'FLIP {self.flip:.4g}, {self.psnr:.4g} dB'}>"


class Comparison(NamedTuple):
    """Two renders of one scene."""

    equal: bool
    """Bit for bit."""
    first: Image
    second: Image
    difference: Difference
    report: Dict[str, Any]
    """With both renderers and, if they differ, the first step of a path that does."""

    def __repr__(self) -> str:
        return f"<hyalite.Comparison: {'equal' if self.equal else 'NOT equal'}, {self.first.width}x{self.first.height}>"


def _image_of(image: Union[Image, ArrayLike, os.PathLike[str]]) -> Any:
    if isinstance(image, Image):
        return image._image
    if isinstance(image, (str, os.PathLike)):
        return load_image(image)._image
    return Image(image)._image


def diff(reference: Union[Image, ArrayLike, str], test: Union[Image, ArrayLike, str]) -> Difference:
    """Compares two images of one size; each may be an Image, an array (height, width, 3) of linear RGB, or a file. Colours
    are compared over black."""
    return Difference(**_hyalite.diff(_image_of(reference), _image_of(test)))


def compare(
    scene: SceneLike,
    against: str = "cpu",
    *,
    device: str = "auto",
    progress: Optional[Progress] = None,
    message: Optional[Message] = None,
    **settings: Any,
) -> Comparison:
    """Renders a scene by two renderers that are opened for it, and compares the images."""
    _called(progress=progress, message=message)
    equal, first, second, difference, report = _hyalite.compare(
        _scene_of(scene), settings, str(device), str(against), progress, message
    )
    return Comparison(equal, Image(first), Image(second), Difference(**difference), report)


def devices() -> List[Dict[str, Any]]:
    """The Vulkan devices, by index, and last the CPU twin, as `hyalite devices --json` tells of them."""
    return _hyalite.devices()


def profile(
    scene: SceneLike,
    *,
    device: str = "auto",
    warmups: int = 1,
    repeats: int = 5,
    counts: bool = False,
    verified: bool = True,
    time_limit: Optional[float] = None,
    progress: Optional[Progress] = None,
    message: Optional[Message] = None,
    **settings: Any,
) -> Dict[str, Any]:
    """Measures renders of a scene, as `hyalite profile --report` writes it: times are in milliseconds. `counts` renders
    twice more and counts the work of the rays; without `verified` the first frame is not compared with the CPU's."""
    _called(progress=progress, message=message)
    return _hyalite.profile(
        _scene_of(scene), settings, str(device), operator.index(warmups), operator.index(repeats), bool(counts),
        not verified, _seconds(time_limit), progress, message,
    )


def inspect(
    scene: SceneLike,
    *,
    coverage: bool = False,
    progress: Optional[Progress] = None,
    message: Optional[Message] = None,
    **settings: Any,
) -> Dict[str, Any]:
    """What a scene is made of: "bounds", "camera", "nodes", "materials", "lights" and more, as `hyalite inspect --json`
    prints it. With `coverage` also which objects and materials cover which share of the picture."""
    _called(progress=progress, message=message)
    return _hyalite.inspect(_scene_of(scene), settings, bool(coverage), progress, message)


def verify(
    device: str = "auto",
    *,
    kernels: Sequence[str] = (),
    progress: Optional[Progress] = None,
    message: Optional[Message] = None,
) -> Dict[str, Any]:
    """Renders small shipped scenes with every kernel of a device (or "cpu"), and compares their films with shipped
    hashes: "passed" is whether all have the same bits."""
    _called(progress=progress, message=message)
    return _hyalite.verify(str(device), _words("kernels", kernels), progress, message)


def setting_names() -> List[str]:
    """The names of all settings, in the order of help texts."""
    return _hyalite.setting_names()


def prepare_process() -> None:
    """Prepares the process as the command line does its own: settings of the allocator, and lavapipe's environment
    variables when a device is opened, which make its renders faster. Call it first; nothing else does it."""
    _hyalite.prepare_process()
