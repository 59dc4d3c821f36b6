"""sim/gpu/gl_call_rows.h has each function of OpenGL that slosh calls: one that is not there would not be counted."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]


class Calls(unittest.TestCase):
    def test_rows_are_the_functions_that_are_called(self):
        called = set()
        for folder in ('sim', 'render', 'app'):
            for path in (ROOT / folder).rglob('*.[ch]*'):
                if path.name != 'gl_call_rows.h':
                    called |= set(re.findall(r'\bgl[A-Z]\w+(?=\()', path.read_text(encoding='utf-8')))
        rows = re.findall(r'^GL_(?:CALL|RUN|SETTING)\(.*?, (gl\w+),', (ROOT / 'sim/gpu/gl_call_rows.h').read_text(encoding='utf-8'), re.M)
        self.assertEqual(rows, sorted(called))

    def test_a_clear_is_not_behind_a_write(self):
        """NVIDIA's driver (580) lets a clear overtake a later write: a buffer of the solver is cleared by a pass, or when it is made."""
        clears = {path.name: path.read_text(encoding='utf-8').count('glClearNamedBuffer') for path in (ROOT / 'sim/gpu/compute').glob('*.c')}
        self.assertEqual({name: n for name, n in clears.items() if n}, {'passes.c': 1})


if __name__ == '__main__':
    unittest.main()
