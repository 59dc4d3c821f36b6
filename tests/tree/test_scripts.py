"""The scripts that people run can be read by their shell, each figure of tools/figures is drawn by a function, and the faults
of tools/mutants suit the tree."""
import importlib.machinery
import importlib.util
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
        functions = [name.replace('_', '-') for name in re.findall(r'^(paper\w+|splat\w+|cost\w+)\(\)', text, re.M)]
        self.assertEqual(sorted(names), sorted(functions))
        # what they are drawn of is there; tests/long/test_figures.py draws them
        scenes = set(re.findall(r'^\s*draw ([\w/]+) ', text, re.M)) | {f'papers/{name}' for name in re.findall(r'\{ moments (\w+)', text)}
        files = {f'scenes/{name}.yaml' for name in scenes} | set(re.findall(r'\$root/([\w/]+\.\w+)"', text))
        self.assertGreater(len(files), 12)
        self.assertEqual([name for name in sorted(files) if not (ROOT / name).exists()], [])

    def test_tests_that_scripts_and_lists_name(self):
        """tools/test runs a few tests by name; the lists of tests/CMakeLists.txt give tests their order and labels."""
        run = re.findall(r'tests/test_(\w+) (\w+)', (ROOT / 'tools/test').read_text())
        lists = re.findall(r'^set\((?:first|unsanitized|alone|long) (.*?)\)', (ROOT / 'tests/CMakeLists.txt').read_text(), re.M | re.S)
        listed = [tuple(name.split('.')) for text in lists for name in text.split()]
        self.assertGreater(len(run), 5)
        self.assertGreater(len(listed), 40)
        self.assertEqual([(folder, name) for folder, name in [*run, *listed]
                          if not any(ROOT.glob(f'tests/{folder}/test_{name}.*'))], [])


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


class Words(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        loader = importlib.machinery.SourceFileLoader('words', str(ROOT / 'tools/words'))
        cls.words = importlib.util.module_from_spec(importlib.util.spec_from_loader('words', loader))
        sys.dont_write_bytecode = True
        loader.exec_module(cls.words)

    def long(self, text):
        return len(list(self.words.long_sentences(text)))

    def test_sentences(self):
        thirty = 'word ' * 29
        self.assertEqual((self.long(thirty + 'end.'), self.long(thirty + 'the end.')), (0, 1))
        self.assertEqual(self.long(thirty + 'end. Another one'), 0)
        self.assertEqual(self.long(thirty + '+ x i j k\n\nthe end'), 0)  # a formula; a paragraph
        page = self.words.prose(f'# Title\n\n```sh\n{thirty} the end\n```\n| {thirty} | {thirty} |\n{thirty} `a b`, the end')
        self.assertEqual(self.long(page), 1)

    def test_texts_of_c(self):
        code = '/* "no" */ puts("one "\n     "text"); // "no"\nputs("set grid \'$x\'");'
        self.assertEqual([text for _, text in self.words.texts(code)], ['one text'])

    def test_names(self):
        self.assertEqual(self.words.parts_of('cpu_feelDrift2_AT'), ['cpu', 'feel', 'drift', 'at'])

    def test_comments_at_ends_of_lines_stand_alone(self):
        self.assertEqual([said.strip() for _, said in self.words.comments('a; // one\nb; // two\n// three\n// four')],
                         ['one', 'two', 'three\n four'])


if __name__ == '__main__':
    unittest.main()
