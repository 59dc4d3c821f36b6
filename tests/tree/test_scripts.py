"""The scripts that people run can be read by their shell, each figure of tools/figures is drawn by a function, and the faults
of tools/mutants suit the tree."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Scripts(unittest.TestCase):
    def test_syntax(self):
        scripts = [path for path in [*ROOT.glob('tools/*'), *ROOT.glob('.ci/*')]
                   if path.is_file() and re.match(rb'#!.*\bbash\n', path.read_bytes())]
        self.assertGreater(len(scripts), 5)
        for path in scripts:
            checked = subprocess.run(['bash', '-n', path], capture_output=True, text=True)
            self.assertEqual((checked.returncode, checked.stderr), (0, ''))

    def test_figures(self):
        text = (ROOT / 'tools/figures').read_text()
        names = re.search(r'^figures=\((.*)\)$', text, re.M)[1].split()
        functions = [name.replace('_', '-') for name in re.findall(r'^(paper\w+|splat\w+)\(\)', text, re.M)]
        self.assertEqual(sorted(names), sorted(functions))


class Mutants(unittest.TestCase):
    ENTRY = 'fault some: what\nfile sim/box/walls.c\n- x[a] = high;\n+ x[a] = low;\ntests sim.walls commands.replay dfsph.walls\n'

    def check(self, text=None):
        """(exit code, what it says) of tools/mutants --check, of its own file or of another one."""
        with tempfile.NamedTemporaryFile('w', suffix='.txt') as file:
            file.write(text or '')
            file.flush()
            done = subprocess.run([sys.executable, ROOT / 'tools/mutants', '--check', *([file.name] if text else [])],
                                  capture_output=True, text=True)
        return done.returncode, done.stderr

    def test_they_suit_the_tree(self):
        self.assertEqual(self.check(), (0, ''))

    def test_what_is_stale_or_wrong_is_refused(self):
        self.assertEqual(self.check(self.ENTRY), (0, ''))
        for old, new, words in [
                ('walls.c', 'wand.c', 'wants a file that is there'), ('= high', '= higher', 'has the old line 0 times'),
                ('- x[a] = high;', '- held = true;', 'has the old line 3 times'), ('= low', '= high', 'with two lines'),
                ('sim.walls', 'sim.wells', 'there is no test sim.wells'), ('commands.r', 'commands.o', 'no test commands.oeplay'),
                ('file', 'files', 'not a line of a fault'), ('fault some', 'fault', 'not a line of a fault')]:
            code, said = self.check(self.ENTRY.replace(old, new, 1))
            self.assertEqual(code, 2, old)
            self.assertIn(words, said)
        self.assertIn('the second of its kind', self.check(2 * self.ENTRY)[1])


if __name__ == '__main__':
    unittest.main()
