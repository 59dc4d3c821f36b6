"""Calls run the way that includes do: of each object file's undefined symbols, the folder that defines them is one that the
caller's folder may include (test_layers.py), and no two folders name each other's symbols."""
import collections
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
# A row of a list (sim/step/method.c, render/lists.c ...): the list names each of its rows, whichever folder owns the row.
ROW = re.compile(r"(method|backend|term|view|overlay)_[a-z]+$")
# Letters are drawn by Dear ImGui, whose one C++ file is the bridge: frame/text.h has the functions for all views.
UPWARD = {("render/frame", "render/ui")}
BUILD = pathlib.Path(sys.argv[1])
sys.argv[1] = ""  # test_layers takes the library that only its own tests read
from test_layers import ROOT, circles, may  # noqa: E402


def objects():
    """(folder, object file) of each source of sim, render and app that is still there."""
    for path in BUILD.rglob("*.o"):
        match = re.search(r"/(sim(?:/gpu|/ranks)?|render|app)/CMakeFiles/[^/]+\.dir/(.+)\.o$", "/" + str(path.relative_to(BUILD)))
        if match and (ROOT / match[1] / match[2]).exists():
            yield str(pathlib.PurePosixPath(match[1], match[2]).parent), path


def symbols(paths):
    """Of each object file the names that it defines for others, and the names that it looks for."""
    text = subprocess.run(["nm", "--extern-only", "--format=posix", "--print-file-name", *paths], check=True, capture_output=True,
                          text=True).stdout
    found = {str(path): (set(), set()) for path in paths}
    for path, name, kind in re.findall(r"^(.*): (\S+) (\S)", text, re.M):
        found[path][kind == "U"].add(name)
    return found


def calls(files):
    """{(caller's folder, owner's folder): names}."""
    files = list(files)
    found, owner, wanted = symbols([path for _, path in files]), {}, collections.defaultdict(set)
    for folder, path in files:
        defined, undefined = found[str(path)]
        owner.update(dict.fromkeys(defined, folder))
        wanted[folder] |= undefined
    edges = collections.defaultdict(set)
    for folder, names in wanted.items():
        for name in names & owner.keys():
            if owner[name] != folder and not ROW.match(name):
                edges[folder, owner[name]].add(name)
    return edges


class Calls(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.edges = calls(objects())

    def test_objects_were_read(self):
        self.assertGreater(len(self.edges), 100)
        self.assertIn("world_create", set().union(*self.edges.values()))

    def test_calls_run_one_way(self):
        allowed = may()
        wrong = [f"{caller} calls {owner}: {', '.join(sorted(names)[:5])}" for (caller, owner), names in sorted(self.edges.items())
                 if owner not in allowed[caller] and (caller, owner) not in UPWARD]
        self.assertEqual(wrong, [])

    def test_no_folders_call_in_a_circle(self):
        graph = collections.defaultdict(set)
        for caller, owner in self.edges:
            graph[caller].add(owner)
        self.assertEqual(circles(graph), [])


if __name__ == "__main__":
    unittest.main()
