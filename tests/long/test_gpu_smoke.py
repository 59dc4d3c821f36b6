"""tools/gpu_smoke on this driver, with a hundredth of the particles: each row's command is one that slosh takes."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / 'tools/gpu_smoke'
PROGRAM = os.path.abspath(sys.argv.pop(1))
ROWS = ['a GPU is there', 'fragment finds the same', 'methods, a million', 'views, a million', 'forces are numbers', 'pictures']


class Smoke(unittest.TestCase):
    def smoke(self, *words):
        return subprocess.run([SCRIPT, *words], capture_output=True, text=True, timeout=500, check=False, env=dict(os.environ, SLOSH=PROGRAM))

    def test_rows(self):
        with tempfile.TemporaryDirectory() as folder:
            found = os.path.join(folder, 'smoke.json')
            for name in ROWS:  # one by one, since names have commas
                done = self.smoke('--scale', '0.002', '--row', name, '--json', found)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                row, = json.loads(pathlib.Path(found).read_text(encoding='utf-8'))
                self.assertEqual((row['row'], row['failures']), (name, []))
                self.assertIn(f'{name} ', done.stdout)

    def test_a_wrong_result_fails(self):
        done = self.smoke('--scale', '1', '--row', 'a GPU is there')
        if 'software driver' in done.stdout:
            self.assertEqual(done.returncode, 1, done.stdout)
        done = self.smoke('--row', 'nothing')
        self.assertEqual(done.returncode, 1)
        self.assertIn("no row 'nothing'", done.stderr)


if __name__ == '__main__':
    unittest.main()
