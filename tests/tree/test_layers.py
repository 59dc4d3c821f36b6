"""Dependencies run one way: sim <- sim/gpu <- render <- app, and between the rooms of a floor; no circle of files; sim
without sim/gpu needs no GL, window or HID symbol."""
import collections
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIM_LIBRARY = sys.argv.pop(1)


def own_folders(floor, what):
    """The methods, views or overlays of the program: each is a folder, in which a .c file defines it."""
    return sorted({path.parent.name for path in (ROOT / floor).glob("*/*.c")
                   if re.search(rf"^const {what}_{path.parent.name} =", path.read_text(), re.M)})


# Each room with the rooms of its floor that it may include; all of them are above it in the list.
SIM = {
    "base": "",
    "kernel": "base",
    "box": "base kernel",
    "mesh": "base kernel",
    "def": "base kernel box",
    "points": "base kernel mesh",
    "solids": "base kernel box mesh def",
    "flow": "base kernel box mesh def solids",
    "start": "base kernel box mesh def solids flow",
    "step": "base kernel box def solids flow start",
    "cpu": "base kernel box def solids flow start step",
    "methods/shared": "base kernel box def solids flow step cpu",
}
METHODS = own_folders("sim/methods", "Method method")
SIM |= {f"methods/{name}": "base kernel box def solids flow step cpu methods/shared" for name in METHODS}
SIM_INSIDE = {f"sim/{name}" for name in SIM if name == "cpu" or name.startswith("methods/")}  # for no other floor
PUBLIC = "sim"  # sim/*.h: every part may include these headers; each includes the others alone
GL = {"": "", "compute": "", "fragment": "", "points": ""}
BACKENDS = {"sim/gpu/compute", "sim/gpu/fragment"}  # other floors know them by name only
RENDER = {
    "ui": "",
    "frame": "ui",
    "particles": "frame",
    "picking": "frame particles",
    "water": "frame particles",
}
VIEWS = own_folders("render/views", "ViewKind view")
OVERLAYS = own_folders("render/overlays", "OverlayKind overlay")
RENDER |= {name: "frame particles" for name in [*(f"views/{name}" for name in VIEWS), *(f"overlays/{name}" for name in OVERLAYS)]}
RENDER[""] = " ".join(RENDER)
APP = {
    "base": "",
    "run/measure": "base",
    "scene/yaml": "base",
    "scene/import": "base scene/yaml",
    "scene": "base run/measure scene/yaml scene/import",
    "run/recording": "base scene/yaml scene",
    "input/device": "base run/recording",
    "input": "base scene/yaml scene run/recording input/device",
    "files/foreign": "base scene/yaml scene/import scene",
    "files": "base scene/yaml scene files/foreign",
    "cli/args": "base scene files",  # the command line as data, for all parts below the commands
    "run/playback": "base scene/yaml scene files/foreign files",
    "run": "base run/measure scene run/recording input files cli/args",
    "run/compare": "base scene run/recording files run/playback run",
    "bench/cases": "base run/measure scene",
    "bench": "base run/measure scene input cli/args run bench/cases",
    "lab": "base run/measure scene/yaml scene cli/args run bench bench/cases",
    "window/panel": "run/measure scene input run",
    "window": "base scene/yaml scene/import scene run/recording input/device input files run/playback run run/compare cli/args bench window/panel",
    "cli": "base run/measure scene/yaml scene run/recording input/device input files run/playback run run/compare cli/args bench bench/cases lab window",
    "ranks": "base run/measure scene files run cli/args bench lab cli",
}
LIBRARY = {"": ""}  # above the program's parts without a terminal and a window
NOT_OF_LIBRARY = ("app/cli", "app/window", "app/bench", "app/lab", "app/input", "app/ranks", "app/run/compare", "sim/ranks")
FLOORS = [("sim", SIM, []), ("sim/gpu", GL, ["sim"]), ("sim/ranks", {"": ""}, ["sim"]),
          ("render", RENDER, ["sim", "sim/gpu"]), ("app", APP, ["sim", "sim/gpu", "sim/ranks", "render"]),
          ("library", LIBRARY, ["sim", "sim/gpu", "render", "app"])]
DRAWS_NOTHING = {"base", "run/measure", "scene/yaml", "scene/import", "run/recording", "input/device"}  # rooms of app without render and sim/gpu


# What names methods beside their folders and app/bench/cases: the list, presets, the lists of `slosh info`, the scene that `slosh new` writes.
METHOD_LISTS = ["app/cli/new.c", "sim/step/method.c", "app/scene/presets.c", "app/cli/info.c"]

# What names views beside their folders and app/bench/cases: lists.
VIEW_LISTS = ["render/lists.c", "app/bench/bench_table.c"]

# What names overlays beside their folders: the list.
OVERLAY_LISTS = ["render/lists.c"]



# What GLSL includes too: C fills it. Methods, views, overlays and backends have their own in a folder of their name.
SHADERS_OF = {"render/particles": "derived", "sim/gpu/points": "surface"}
SHADERS = {"sim": "", "sim/gpu": "shared sim", "render": "shared render"}


def folder(floor, room):
    return f"{floor}/{room}" if room else floor


def may():
    """Of each folder the folders that it may include."""
    rooms, allowed = {}, {}
    for floor, table, below in FLOORS:
        rooms[floor] = [folder(floor, room) for room in table]
        under = [where for name in below for where in rooms[name]]
        under = [where for where in under if where not in BACKENDS]
        if floor not in ("sim/gpu", "sim/ranks"):
            under = [where for where in under if where not in SIM_INSIDE]
        for room, names in table.items():
            own = [folder(floor, name) for name in names.split()]
            if floor == "sim/gpu":
                own.append("sim/gpu")
            down = [w for w in under if not (floor == "app" and room in DRAWS_NOTHING and not w.startswith("sim/"))]
            down = [where for where in down if where != "sim/ranks" or room == "ranks"]  # no other command needs MPI
            if floor == "library":
                down = ["slosh", *(where for where in down if not where.startswith(NOT_OF_LIBRARY))]
            own_shaders = f"sim/{room}".replace("methods/", "") if floor == "sim" else SHADERS_OF.get(folder(floor, room), room.split("/")[-1])
            blocks = [f"shaders/{name}" for name in [*SHADERS.get(floor, "").split(), own_shaders] if floor in SHADERS]
            allowed[folder(floor, room)] = [*down, *own, folder(floor, room), *blocks, PUBLIC]
    allowed[PUBLIC] = [PUBLIC]
    allowed["include/slosh"] = ["slosh"]  # the C API: its headers include each other alone
    return allowed


def includes(path):
    return re.findall(r'^\s*#\s*include\s+"([^"]+)"', path.read_text(), re.M)


def sources():
    for floor in ("include", "sim", "render", "app", "library"):
        yield from sorted(path for path in (ROOT / floor).rglob("*.[ch]*") if path.suffix in (".c", ".h", ".cpp"))


def part_of(name):
    """The file without its suffix. A header of one file's parts, NAME_parts.h without a .c, belongs to NAME.c."""
    path = pathlib.PurePosixPath(name)
    stem = str(path.with_suffix(""))
    def owned(name):
        return any((ROOT / name).with_suffix(suffix).exists() for suffix in (".c", ".cpp"))

    if path.suffix == ".h" and not owned(stem):
        whole = stem
        while "_" in pathlib.PurePosixPath(whole).name:
            whole = whole.rsplit("_", 1)[0]
            if owned(whole):
                return whole
    return stem


def circles(graph):
    """Strongly connected components of more than one node: Tarjan 1972."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            at = stack.index(node)
            if len(stack) - at > 1:
                found.append(sorted(stack[at:]))
            del stack[at:]

    for node in list(graph):
        if node not in index:
            visit(node)
    return found


class Layers(unittest.TestCase):
    maxDiff = None

    def test_includes_run_one_way(self):
        allowed, seen, wrong = may(), 0, []
        for path in sources():
            where = str(path.parent.relative_to(ROOT))
            self.assertIn(where, allowed, f"{where} is no room of FLOORS")
            for name in includes(path):
                seen += 1
                if str(pathlib.PurePosixPath(name).parent) not in allowed[where]:
                    wrong.append(f"{path.relative_to(ROOT)} includes {name}; {where} may use {allowed[where]}")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 1000)

    def test_rooms_stand_above_what_uses_them(self):
        for floor, table, _ in FLOORS:
            above = []
            for room, names in table.items():
                self.assertEqual([name for name in names.split() if name not in above], [], f"{floor}/{room}")
                above.append(room)

    def test_no_circle_of_files(self):
        graph = collections.defaultdict(set)
        for path in sources():
            here = part_of(str(path.relative_to(ROOT)))
            graph[here] |= {part_of(name) for name in includes(path)} - {here}
        self.assertEqual(circles(graph), [])
        self.assertEqual(circles({"a": ["b"], "b": ["c"], "c": ["a"], "d": ["a"]}), [["a", "b", "c"]])

    def test_each_header_has_a_guard_of_its_own(self):
        """Of two with one guard a file that includes both loses the second, without a word."""
        owners = collections.defaultdict(list)
        for path in [*ROOT.glob("include/**/*.h"), *ROOT.glob("library/**/*.h"), *ROOT.glob("sim/**/*.h"), *ROOT.glob("render/**/*.h"), *ROOT.glob("app/**/*.h"), *ROOT.glob("tests/**/*.h")]:
            guard = re.search(r"^#ifndef (\w+)\n#define \1$", path.read_text(), re.M)
            owners[guard and guard[1]].append(str(path.relative_to(ROOT)))
        owners.pop(None, None)  # lists that are included more than once
        self.assertGreater(len(owners), 150)
        self.assertEqual({guard: names for guard, names in owners.items() if len(names) > 1}, {})

    def test_a_view_is_named_in_its_folder_and_in_lists(self):
        paths = list(sources())
        views = set(VIEWS)
        self.assertGreaterEqual(views, {"spheres", "splat", "volume"})
        found = []
        for path in paths:
            name = str(path.relative_to(ROOT))
            if name in VIEW_LISTS or name.startswith("app/bench/cases/"):
                continue
            for view in views - {path.parent.name}:
                word = (rf'\b(view_{view}|{view}_(def|keys|usual))\b|\bview\.{view}\b|"render/views/{view}/|'
                        rf'\b(view|kind)\b.*"{view}"')
                found += [f"{name}: {match.group()}" for match in re.finditer(word, path.read_text())]
        self.assertEqual(found, [])

    def test_an_overlay_is_named_in_its_folder_and_in_the_list(self):
        self.assertGreaterEqual(set(OVERLAYS), {"glyphs", "trails"})
        found = []
        for path in sources():
            name = str(path.relative_to(ROOT))
            for overlay in set(OVERLAYS) - {path.parent.name}:
                word = rf'\b(overlay_{overlay}|{overlay}_(def|keys|usual))\b|\bview\.{overlay}\b|"render/overlays/{overlay}/'
                found += [name for match in re.finditer(word, path.read_text()) if name not in OVERLAY_LISTS]
        self.assertEqual(found, [])

    def test_a_method_is_named_in_its_folder_and_in_lists(self):
        paths = list(sources())
        methods = set(METHODS)
        self.assertGreaterEqual(methods, {"mueller", "wcsph"})
        word = re.compile("|".join(methods), re.I)
        named = {str(path.relative_to(ROOT)) for path in paths
                 if path.parent.name not in methods and word.search(path.read_text())}
        self.assertEqual(sorted(name for name in named if not name.startswith("app/bench/cases/")), sorted(METHOD_LISTS))

    def test_a_views_shaders_are_its_own(self):
        seen, found = 0, []
        for path in sorted((ROOT / "shaders").glob("*/*.*")):
            for name in re.findall(r'^#include "(?:shaders/)?([^"]+)"', path.read_text(), re.M):
                seen += 1
                if name.split("/")[0] not in (path.parent.name, "common", "shared", "render"):
                    found.append(f"{path.relative_to(ROOT)} includes {name}")
        self.assertGreater(seen, 100)
        self.assertEqual(found, [])

    def test_sim_needs_no_window_and_no_gl(self):
        symbols = subprocess.run(["nm", "--undefined-only", "--format=just-symbols", SIM_LIBRARY], check=True,
                                 capture_output=True, text=True).stdout.split()
        self.assertIn("malloc", symbols)  # nm has read it
        foreign = [s for s in symbols if re.match(r"(gl[A-Z]|glX|egl|epoxy|glfw|hid_|H5|png_|fy_|json_)", s)]
        self.assertEqual(foreign, [])

    def test_cpp_only_in_the_bridge_to_imgui(self):
        folders = {str(p.parent.relative_to(ROOT)) for p in sources() if p.suffix == ".cpp"}
        self.assertEqual(folders, {"render/ui"})


if __name__ == "__main__":
    unittest.main()
