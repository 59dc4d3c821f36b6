"""Dependencies run one way: sim <- sim/gl <- render <- app; sim without sim/gl needs no GL, window or HID symbol."""
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIM_LIBRARY = sys.argv.pop(1)

# What each folder may include of the tree.
MAY = {
    "sim": ["sim", "sim/cpu/parallel.h"],
    "sim/cpu": ["sim", "sim/cpu"],
    "sim/gl": ["sim", "sim/gl"],
    "sim/gl/compute": ["sim", "sim/gl", "sim/gl/compute"],
    "sim/gl/fragment": ["sim", "sim/gl", "sim/gl/fragment"],
    "render": ["sim", "sim/cpu/parallel.h", "sim/gl", "render"],
    "app/device": ["sim", "app/device", "app"],
    "app": ["sim", "sim/gl", "render", "app/device", "app"],
}


def includes(path):
    return re.findall(r'^\s*#\s*include\s+"([^"]+)"', path.read_text(), re.M)


class Layers(unittest.TestCase):
    def test_includes_run_one_way(self):
        seen = 0
        for folder, allowed in MAY.items():
            for path in sorted((ROOT / folder).glob("*.[ch]*")):
                for name in includes(path):
                    seen += 1
                    where = str(pathlib.PurePosixPath(name).parent)
                    self.assertTrue(where in allowed or name in allowed,
                                    f"{path.relative_to(ROOT)} includes {name}; {folder} may use {allowed}")
        self.assertGreater(seen, 100)

    def test_sim_needs_no_window_and_no_gl(self):
        symbols = subprocess.run(["nm", "--undefined-only", "--format=just-symbols", SIM_LIBRARY], check=True,
                                 capture_output=True, text=True).stdout.split()
        self.assertIn("malloc", symbols)  # nm has read it
        foreign = [s for s in symbols if re.match(r"(gl[A-Z]|glX|egl|epoxy|glfw|hid_|H5|png_|fy_|json_)", s)]
        self.assertEqual(foreign, [])

    def test_one_cpp_file(self):
        files = [str(p.relative_to(ROOT)) for folder in MAY for p in (ROOT / folder).glob("*.cpp")]
        self.assertEqual(files, ["render/imgui.cpp"])


if __name__ == "__main__":
    unittest.main()
