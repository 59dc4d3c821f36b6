"""The scripts that people run can be read by their shell, and each figure of tools/figures is drawn by a function."""
import pathlib
import re
import subprocess
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


if __name__ == '__main__':
    unittest.main()
