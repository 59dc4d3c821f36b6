"""Calls run the way that includes do: of each object file's undefined symbols, the folder that defines them is one that the
caller's folder may include (test_layers.py), no two folders name each other's symbols, and no files of a folder call each
other in a circle."""
import collections
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
# A row of a list (sim/step/method.c, render/lists.c ...): the list names each of its rows, whichever folder owns the row.
ROW = re.compile(r"((method|backend|term|view|overlay|effect)_[a-z]+|action_[a-z_]+)$")
# Folders with a circle of calls between files, and why.
CIRCLES = {
    "app/run": "a jump in time simulates, and a step keeps the history",
}
BUILD = pathlib.Path(sys.argv[1])
sys.argv[1] = ""  # test_layers takes the library that only its own tests read
from test_layers import ROOT, circles, may  # noqa: E402

def objects():
    """(source file, object file) of each source of sim, render, app and library that is still there."""
    for path in BUILD.rglob("*.o"):
        match = re.search(r"/(sim(?:/gpu|/ranks)?|render|app|library)/CMakeFiles/[^/]+\.dir/(.+)\.o$", "/" + str(path.relative_to(BUILD)))
        if match and (ROOT / match[1] / match[2]).exists():
            yield str(pathlib.PurePosixPath(match[1], match[2])), path

def symbols(paths):
    """Of each object file the names that it defines for others, those of functions, and the names that it looks for."""
    text = subprocess.run(["nm", "--extern-only", "--format=posix", "--print-file-name", *paths], check=True, capture_output=True,
                          text=True).stdout
    found = {str(path): (set(), set(), set()) for path in paths}
    for path, name, kind in re.findall(r"^(.*): (\S+) (\S)", text, re.M):
        found[path][2 if kind == "U" else 0].add(name)
        if kind in "TW":
            found[path][1].add(name)
    return found

def calls(found, place, defines):
    """{(caller's place, owner's place): names}: `place` of a source file, `defines` of the sets of symbols()."""
    owner, wanted = {}, collections.defaultdict(set)
    for source, names in found:
        owner.update(dict.fromkeys(names[defines], place(source)))
        wanted[place(source)] |= names[2]
    edges = collections.defaultdict(set)
    for here, names in wanted.items():
        for name in names & owner.keys():
            if owner[name] != here and not ROW.match(name):
                edges[here, owner[name]].add(name)
    return edges

def folder_of(source):
    return str(pathlib.PurePosixPath(source).parent)

class Calls(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        files = list(objects())
        found = symbols([path for _, path in files])
        cls.found = [(source, found[str(path)]) for source, path in files]
        cls.edges = calls(cls.found, folder_of, 0)

    def test_objects_were_read(self):
        self.assertGreater(len(self.edges), 100)
        self.assertIn("world_create", set().union(*self.edges.values()))

    def test_calls_run_one_way(self):
        allowed = may()
        wrong = [f"{caller} calls {owner}: {', '.join(sorted(names)[:5])}" for (caller, owner), names in sorted(self.edges.items())
                 if owner not in allowed[caller]]
        self.assertEqual(wrong, [])

    def test_no_folders_call_in_a_circle(self):
        graph = collections.defaultdict(set)
        for caller, owner in self.edges:
            graph[caller].add(owner)
        self.assertEqual(circles(graph), [])

    def test_no_files_of_a_folder_call_in_a_circle(self):
        """Calls of functions: a table that another file reads is no call."""
        graph = collections.defaultdict(set)
        for caller, owner in calls(self.found, str, 1):
            if folder_of(caller) == folder_of(owner):
                graph[caller].add(owner)
        self.assertGreater(len(graph), 100)
        found = circles(graph)
        self.assertEqual([circle for circle in found if folder_of(circle[0]) not in CIRCLES], [])
        self.assertEqual({folder_of(circle[0]) for circle in found}, set(CIRCLES))

if __name__ == "__main__":
    unittest.main()
