"""tools/figures draws each of its figures, small, from the scenes and scripts that there are."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = None


class Figures(unittest.TestCase):
    def test_all_are_drawn(self):
        names = re.search(r'^figures=\((.*)\)$', (ROOT / 'tools/figures').read_text(), re.M)[1].split()
        if not shutil.which('pvpython'):
            names.remove('paper004-2')  # ParaView draws its triangulation
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([ROOT / 'tools/figures', '--small', folder, *names], capture_output=True, text=True,
                                  env={**os.environ, 'SLOSH': PROGRAM})
            self.assertEqual(done.returncode, 0, done.stderr[-2000:])
            drawn = {path.stem: path.stat().st_size for path in pathlib.Path(folder).iterdir()}
        self.assertEqual(sorted(drawn), sorted(names))
        self.assertGreater(min(drawn.values()), 300, drawn)


if __name__ == '__main__':
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
