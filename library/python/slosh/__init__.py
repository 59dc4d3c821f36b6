"""slosh: fluids of particles (SPH), as a module over libslosh.so.1.

    import slosh
    world = slosh.World("dam_break", {"fluids[0].viscosity": 2})
    while world.time < 1:
        world.step()
        print(world.time, world.position[:, 0].max())

Units are SI. Positions and velocities are in the box's frame, with the origin at the centre of the box's floor and y up.
Errors are slosh.Error, in slosh's words. A world belongs to one thread at a time.
"""
import ctypes
import json
import os
import pathlib
import warnings

import numpy

__all__ = ["Error", "Record", "Run", "Picture", "World", "open", "render", "scenes", "version"]


class Error(Exception):
    """What slosh says is wrong; what would be right."""


class _Error(ctypes.Structure):
    _fields_ = [("message", ctypes.c_char * 1024)]


class _Column(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("data", ctypes.c_void_p), ("count", ctypes.c_size_t), ("stride", ctypes.c_size_t),
                ("components", ctypes.c_int), ("type", ctypes.c_int), ("unit", ctypes.c_char_p)]


_TYPES = {1: numpy.float32, 2: numpy.uint32, 3: numpy.uint64}
_Tell = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p)


def _load():
    """SLOSH_LIBRARY, the library of a built tree or of the same prefix, or that of the system."""
    here = pathlib.Path(__file__).parent
    near = [here.parent.parent / "libslosh.so.1", *sorted(here.parents[2].glob("libslosh.so.1")), *sorted(here.parents[2].glob("*/libslosh.so.1"))]
    names = [os.environ.get("SLOSH_LIBRARY"), *(str(path) for path in near if path.exists()), "libslosh.so.1"]
    if "OMP_WAIT_POLICY" not in os.environ:  # libgomp reads this when it is loaded; else idle threads spin for milliseconds
        os.environ.setdefault("GOMP_SPINCOUNT", "1000")
    return ctypes.CDLL(next(name for name in names if name))


_lib = _load()
_P, _S, _D, _N, _I, _B = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_double, ctypes.c_size_t, ctypes.c_int, ctypes.c_bool
_Doubles, _Texts, _E = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_char_p), ctypes.POINTER(_Error)
for _name, _result, *_arguments in [
        ("version", _S), ("scene_name", _S, _N),
        ("scene_load", _P, _S, _Texts, _N, _E), ("scene_parse", _P, _S, _S, _N, _Texts, _N, _E), ("scene_free", None, _P),
        ("world_create", _P, _P, _E), ("world_destroy", None, _P), ("world_on_message", None, _P, _Tell, _P),
        ("world_step", _B, _P, _E), ("world_substep", _B, _P, _E), ("world_run", _B, _P, _D, _E),
        ("world_time", _D, _P), ("world_steps", ctypes.c_uint64, _P), ("world_count", _N, _P), ("world_dimensions", _I, _P),
        ("world_dt", _D, _P), ("world_spacing", _D, _P), ("world_support_radius", _D, _P), ("world_box_size", None, _P, _Doubles),
        ("world_gravity", None, _P, _Doubles), ("world_box", None, _P, _Doubles, _Doubles), ("world_outcome", _S, _P),
        ("world_hash", ctypes.c_uint64, _P), ("world_settings", _S, _P), ("world_column_name", _S, _P, _N),
        ("world_column", _B, _P, _S, ctypes.POINTER(_Column), _E), ("world_write", _B, _P, _P, _P, _N, _N, _E),
        ("world_watch_forces", _B, _P, _E), ("world_force", _D, _P, _I, _Doubles, _Doubles, _E), ("world_solid_count", _I, _P),
        ("world_probe_count", _N, _P), ("world_probe_name", _S, _P, _N), ("world_read_probes", _B, _P, _Doubles, _N, _E),
        ("world_set", _B, _P, _S, _E), ("world_move_box", _B, _P, _Doubles, _Doubles, _E),
        ("world_carry_box", _B, _P, _Doubles, _Doubles, _E), ("world_save", _B, _P, _S, _E), ("world_load", _B, _P, _S, _E),
        ("record_create", _P, _P, _S, _E), ("record_add", _B, _P, _P, _E), ("record_close", None, _P),
        ("run_open", _P, _S, _E), ("run_close", None, _P), ("run_count", _N, _P), ("run_time", _B, _P, _N, _Doubles, _E),
        ("run_column", _B, _P, _N, _S, ctypes.POINTER(_Column), _E), ("run_column_name", _S, _P, _N),
        ("mesh_create", _P, _P, _D, _D, _E), ("mesh_free", None, _P), ("mesh_vertex_count", _N, _P), ("mesh_vertices", _P, _P),
        ("mesh_triangle_count", _N, _P), ("mesh_triangles", _P, _P),
        ("picture_create", _P, _P, _Texts, _N, _I, _I, _E), ("picture_free", None, _P), ("picture_draw", _B, _P, _P, _N, _E),
        ("picture_renderer", _S, _P)]:
    _function = getattr(_lib, f"slosh_{_name}")
    _function.restype, _function.argtypes = _result, _arguments


def _call(name, *arguments):
    """Calls a function that can fail; returns what it gives, or raises Error."""
    error = _Error()
    result = getattr(_lib, f"slosh_{name}")(*arguments, ctypes.byref(error))
    if result is None or result is False or (name == "world_force" and result < 0):
        raise Error(error.message.decode(errors="replace"))
    return result


def _numbers(values, count):
    """`count` doubles, or None."""
    if values is None:
        return None
    array = numpy.asarray(values, dtype=float)
    if array.shape != (count,):
        raise Error(f"{values!r} must be {count} numbers")
    return (ctypes.c_double * count)(*array)


def _read(name, handle, *counts):
    arrays = [(ctypes.c_double * count)() for count in counts]
    getattr(_lib, f"slosh_{name}")(handle, *arrays)
    return [numpy.array(array) for array in arrays]


def _text(value):
    """A setting's value as YAML: JSON is YAML, and a text stays as it is."""
    if isinstance(value, str):
        return value
    return json.dumps(value, default=lambda other: other.tolist())


def _settings(settings):
    pairs = settings.items() if hasattr(settings, "items") else (text.split("=", 1) for text in settings or ())
    texts = [f"{path}={_text(value)}".encode() for path, value in pairs]
    return (ctypes.c_char_p * len(texts))(*texts), len(texts)


def _names(function, handle):
    names = []
    while (name := function(handle, len(names))) is not None:
        names.append(name.decode())
    return names


def _array(column, owner):
    """A view of the column that keeps its owner alive."""
    kind = numpy.dtype(_TYPES[column.type])
    shape = (column.count, 3) if column.components == 3 else (column.count,)
    strides = (column.stride, kind.itemsize) if column.components == 3 else (column.stride,)
    if column.count == 0:
        return numpy.zeros(shape, kind)
    size = (column.count - 1) * column.stride + column.components * kind.itemsize
    memory = (ctypes.c_char * size).from_address(column.data)
    memory._owner = owner
    array = numpy.ndarray(shape, kind, memory, 0, strides)
    array.flags.writeable = False
    return array


def version():
    """The version of the library: "0.1"."""
    return _lib.slosh_version().decode()


def scenes():
    """Names of the scenes of slosh."""
    names = []
    while (name := _lib.slosh_scene_name(len(names))) is not None:
        names.append(name.decode())
    return names


class World:
    """A fluid in its box.

    scene: a file, or the name of a scene of slosh; with text=... the name of that YAML in messages. settings: {path: value},
    as after --set of the program; "particles" is --particles. tell: called with each message; None: warnings.warn.
    """

    def __init__(self, scene, settings=None, *, text=None, tell=None):
        self._handle = None
        texts, count = _settings(settings)
        name = os.fsencode(scene)
        if text is None:
            made = _call("scene_load", name, texts, count)
        else:
            text = text.encode()
            made = _call("scene_parse", name, text, len(text), texts, count)
        try:
            self._handle = _call("world_create", made)
        finally:
            _lib.slosh_scene_free(made)
        self._as_parameter_ = self._handle
        say = tell or (lambda words: warnings.warn(words, stacklevel=3))
        self._tell = _Tell(lambda _, words: say(words.decode(errors="replace")))
        _lib.slosh_world_on_message(self, self._tell, None)

    def __del__(self):
        if self._handle is not None and _lib is not None:
            _lib.slosh_world_destroy(self._handle)

    # ---- steps ----

    def step(self):
        """Advances by a frame of the scene, which is some steps of the solver."""
        _call("world_step", self)

    def substep(self):
        """Advances by one step of the solver."""
        _call("world_substep", self)

    def run(self, until):
        """Advances to the first state at or after the time `until`, s."""
        _call("world_run", self, until)

    time = property(lambda self: _lib.slosh_world_time(self), doc="s")
    steps = property(lambda self: _lib.slosh_world_steps(self), doc="steps of the solver since time 0")
    dt = property(lambda self: _lib.slosh_world_dt(self), doc="length of the last step of the solver, s")
    count = property(lambda self: _lib.slosh_world_count(self), doc="particles")
    dimensions = property(lambda self: _lib.slosh_world_dimensions(self), doc="2 or 3")
    spacing = property(lambda self: _lib.slosh_world_spacing(self), doc="m")
    support_radius = property(lambda self: _lib.slosh_world_support_radius(self), doc="m")
    box_size = property(lambda self: _read("world_box_size", self, 3)[0], doc="m")
    gravity = property(lambda self: _read("world_gravity", self, 3)[0], doc="in the box's frame, m/s2")
    box_position = property(lambda self: _read("world_box", self, 3, 4)[0], doc="of the box's origin in the world, m")
    box_orientation = property(lambda self: _read("world_box", self, 3, 4)[1], doc="unit quaternion x y z w")
    outcome = property(lambda self: _lib.slosh_world_outcome(self).decode(), doc='"holds", or how the run failed')
    hash = property(lambda self: _lib.slosh_world_hash(self), doc="equal states have equal hashes")

    @property
    def settings(self):
        """{path: value} of all settings, with changes."""
        return {path: entry["value"] for path, entry in json.loads(_lib.slosh_world_settings(self)).items()}

    # ---- particles ----

    @property
    def fields(self):
        """Names of the columns: position, velocity, density, ..."""
        return _names(_lib.slosh_world_column_name, self)

    def _column(self, name):
        column = _Column(size=ctypes.sizeof(_Column))
        _call("world_column", self, str(name).encode(), ctypes.byref(column))
        return column

    def __getitem__(self, name):
        """A column as an array without a copy, read-only: of shape (n,), or (n, 3). Its values change when the world's state
        is read again; copy() keeps them. The order of particles changes between steps: world["id"] identifies them."""
        return _array(self._column(name), self)

    def unit(self, name):
        """The unit of a column: "kg/m3"."""
        return self._column(name).unit.decode()

    position = property(lambda self: self["position"], doc="(n, 3) float32, m; a view as world[...]")
    velocity = property(lambda self: self["velocity"], doc="(n, 3) float32, m/s; a view as world[...]")

    def write(self, position=None, velocity=None):
        """Writes positions, velocities or both, (n, 3) each, in the present order; afterwards the order may be another."""
        arrays = [None if rows is None else numpy.ascontiguousarray(rows, dtype=numpy.float32) for rows in (position, velocity)]
        for rows in arrays:
            if rows is not None and rows.shape != (self.count, 3):
                raise Error(f"an array of shape {rows.shape}, and the world has {self.count} particles: ({self.count}, 3)")
        _call("world_write", self, *(None if rows is None else rows.ctypes.data for rows in arrays), self.count, 0)

    def surface(self, level=0.5, cell=0.5):
        """The fluid's surface: vertices (n, 3) in m and triangles (m, 3). cell: of the grid, in spacings."""
        mesh = _call("mesh_create", self, level, cell)
        try:
            vertices, triangles = _lib.slosh_mesh_vertex_count(mesh), _lib.slosh_mesh_triangle_count(mesh)
            rows = ctypes.string_at(_lib.slosh_mesh_vertices(mesh), 12 * vertices)
            indices = ctypes.string_at(_lib.slosh_mesh_triangles(mesh), 12 * triangles)
        finally:
            _lib.slosh_mesh_free(mesh)
        return (numpy.frombuffer(rows, numpy.float32).reshape(-1, 3).copy(),
                numpy.frombuffer(indices, numpy.uint32).reshape(-1, 3).copy())

    # ---- forces and probes ----

    def force(self, body=-1):
        """Mean force (N) and torque (N m) of the fluid on a body since the last call for it: (force, torque, seconds).
        body: -1 for the box, else the number of a solid. The first call of all begins the sums."""
        force, torque = (ctypes.c_double * 3)(), (ctypes.c_double * 3)()
        seconds = _call("world_force", self, body, force, torque)
        return numpy.array(force), numpy.array(torque), seconds

    @property
    def forces(self):
        """{"box": force, "solid_0": force, ...}, N: means since the last reading."""
        bodies = range(-1, _lib.slosh_world_solid_count(self))
        return {"box" if body < 0 else f"solid_{body}": self.force(body)[0] for body in bodies}

    @property
    def probes(self):
        """{name: value} of the scene's probes at the present state; NaN: no fluid there."""
        names = _names(_lib.slosh_world_probe_name, self)
        values = (ctypes.c_double * len(names))()
        _call("world_read_probes", self, values, len(names))
        return dict(zip(names, values))

    # ---- changes, from the next step on ----

    def set(self, path, value):
        """Sets a live key: world.set("gravity", [0, -3, 0])."""
        _call("world_set", self, f"{path}={_text(value)}".encode())

    def move_box(self, position=(0, 0, 0), orientation=None):
        """Moves the box like a hand, to an offset (m) of its centre from home, and a quaternion x y z w about the centre."""
        _call("world_move_box", self, _numbers(position, 3), _numbers(orientation, 4))

    def carry_box(self, position=(0, 0, 0), orientation=None):
        """Puts the box there at once; the fluid comes along and feels no force."""
        _call("world_carry_box", self, _numbers(position, 3), _numbers(orientation, 4))

    # ---- files ----

    def save(self, path):
        """Saves the state as a file NAME.h5part of one step."""
        _call("world_save", self, os.fsencode(path))

    def load(self, path):
        """Continues from the last step of a file, to the same bits; the scene and the settings must be the same."""
        _call("world_load", self, os.fsencode(path))

    def record(self, path):
        """A Record of this world: with world.record("run.h5part") as file: ... file.add()."""
        return Record(self, path)


class Record:
    """A file NAME.h5part that gets a step at each add()."""

    def __init__(self, world, path):
        self._world = world
        self._handle = _call("record_create", world, os.fsencode(path))

    def add(self):
        """Adds the present state."""
        _call("record_add", self._handle, self._world)

    def close(self):
        """Closes the file; a record without a step leaves none."""
        _lib.slosh_record_close(self._handle)
        self._handle = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        if getattr(self, "_handle", None) is not None and _lib is not None:
            self.close()


class Run:
    """A recorded run: times, and steps by number; run[-1]["position"]."""

    def __init__(self, path):
        self._handle = None
        self._handle = self._as_parameter_ = _call("run_open", os.fsencode(path))

    def __del__(self):
        if self._handle is not None and _lib is not None:
            _lib.slosh_run_close(self._handle)

    def __len__(self):
        return _lib.slosh_run_count(self)

    @property
    def times(self):
        """Time of each step, s."""
        time = ctypes.c_double()
        return numpy.array([_call("run_time", self, k, ctypes.byref(time)) and time.value for k in range(len(self))])

    @property
    def fields(self):
        """Names of the columns in the file."""
        return _names(_lib.slosh_run_column_name, self)

    def __getitem__(self, index):
        if not -len(self) <= index < len(self):
            raise IndexError(f"there is no step {index}; the file has {len(self)}")
        return Step(self, index % len(self))


class Step:
    """A step of a recorded run."""

    def __init__(self, run, index):
        self.run, self.index = run, index

    @property
    def time(self):
        """s"""
        time = ctypes.c_double()
        _call("run_time", self.run, self.index, ctypes.byref(time))
        return time.value

    def __getitem__(self, name):
        """A column, an array of its own."""
        column = _Column(size=ctypes.sizeof(_Column))
        _call("run_column", self.run, self.index, str(name).encode(), ctypes.byref(column))
        return _array(column, self.run).copy()

    position = property(lambda self: self["position"], doc="(n, 3) float32, m")
    velocity = property(lambda self: self["velocity"], doc="(n, 3) float32, m/s")


def open(path):
    """Opens a recorded run, NAME.h5part."""
    return Run(path)


class Picture:
    """Draws a world again and again. view: spheres, splat, volume, ...; None: the scene's. settings: live keys, such as
    {"view.color_by": "pressure"}. Needs EGL and OpenGL 4.5. Belongs to the thread that makes it."""

    def __init__(self, world, view=None, size=(640, 480), settings=None):
        self._handle = None
        self._world = world
        self.width, self.height = (int(pixels) for pixels in size)
        texts, count = _settings({**({"view.kind": view} if view else {}), **(settings or {})})
        self._handle = _call("picture_create", world, texts, count, self.width, self.height)

    def __del__(self):
        if self._handle is not None and _lib is not None:
            _lib.slosh_picture_free(self._handle)

    renderer = property(lambda self: _lib.slosh_picture_renderer(self._handle).decode(), doc="the name of OpenGL's renderer")

    def draw(self):
        """The present state: (height, width, 3) uint8, sRGB, rows from the top."""
        image = numpy.empty((self.height, self.width, 3), numpy.uint8)
        _call("picture_draw", self._handle, image.ctypes.data, image.nbytes)
        return image


def render(world, view=None, size=(640, 480), settings=None):
    """One picture of the world, as Picture.draw; for many pictures keep a Picture."""
    return Picture(world, view, size, settings).draw()
