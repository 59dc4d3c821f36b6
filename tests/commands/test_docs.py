"""The pages of docs/ and the READMEs: what the program makes of them is new, examples load, commands are there; how
tools/docs makes pictures anew."""
import contextlib
import importlib.machinery
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import types

import command
from command import CommandTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [*ROOT.glob('docs/**/*.md'), *(path for path in ROOT.glob('**/README.md') if 'build' not in path.parts)]

# What an example is put into: the parts that it names itself take the place of these.
PARTS = {'box': 'box: {size: [1, 1, 1]}\n', 'particles': 'particles: {spacing: 0.05}\n',
         'fluids': 'fluids:\n  - fill: [{block: {min: [-0.2, 0, -0.2], max: [0.2, 0.5, 0.2]}}]\n'}


def example_parts(text):
    """The lines of each key at the left margin."""
    return {part[0].split(':')[0]: ''.join(part) for part in
            [re.findall(r'.*\n', part) for part in re.split(r'^(?=\w)', text, flags=re.M) if part]}


def command_blocks(text):
    """What stands between fences without a language, and `slosh ...` within a line."""
    fence = re.compile(r'^ *```(\w*)\n(.*?)^ *```$', re.S | re.M)
    blocks = [block for language, block in fence.findall(text) if not language]
    return blocks + [words.replace('\n', ' ') for words in re.findall(r'`(slosh [^`]*)`', fence.sub('', text))]


def help_of(*words):
    return subprocess.run([command.PROGRAM, 'help', *words], capture_output=True, text=True, check=True).stdout


def tool(name):
    """A script of tools/ as a module."""
    sys.dont_write_bytecode = True
    module = types.ModuleType(name)
    module.__file__ = str(ROOT / 'tools' / name)
    importlib.machinery.SourceFileLoader(name, module.__file__).exec_module(module)
    return module


PICTURES = """\
```yaml
title: A tank
box: one
```
```yaml
box: another
```
```
mkdir -p x/pictures; cp mine.yaml x/pictures/first.png
```
```
false; touch x/pictures/second.png
```
```
touch not_a_picture
```
"""


class Pictures(CommandTest):
    def test_blocks_of_a_page_are_run(self):
        docs, copy = tool('docs'), pathlib.Path(self.folder)
        self.write('page.md', PICTURES)
        failed = docs.run_page(self.path('page.md'), [], copy)
        self.assertEqual(len(failed), 1)
        self.assertIn('false; touch', failed[0])
        self.assertEqual(self.read('x/pictures/first.png'), b'title: A tank\nbox: another\n')
        self.assertFalse((copy / 'x/pictures/second.png').exists() or (copy / 'not_a_picture').exists())
        self.assertEqual(docs.run_page(self.path('page.md'), ['first'], copy), [])  # the other block is not asked for

    def test_what_one_sees_differs(self):
        docs, paths = tool('docs'), []
        for name, color in (('a', '0x808080'), ('b', '0x828282'), ('c', '0x868686'), ('small', '0x808080')):
            paths.append(pathlib.Path(self.path(f'{name}.png')))
            subprocess.run(['ffmpeg', '-v', 'error', '-f', 'lavfi', '-i', f'color={color}:size={"8x8" if name == "small" else "16x8"}',
                            '-vf', 'format=rgb24', '-frames:v', '1', paths[-1]], check=True)
        self.assertEqual([docs.differs(paths[0], path) for path in paths], [0, 0, 1, 1])
        self.assertEqual(docs.differs(pathlib.Path(self.path('none.png')), paths[0]), 1)


class Older(CommandTest):
    """Pictures that are older than what they show, in a small tree: a scene, a page, a golden picture of its view."""
    PAGE = ('```\nffmpeg -v error -y -f lavfi -i color={}:size=16x16 -frames:v 1 x/pictures/a.png; echo slosh render tank\n```\n'
            '```\ncp x/pictures/a.png x/pictures/b.png\n```\n')

    def setUp(self):
        super().setUp()
        for name in 'scenes', 'tests/images', 'x/pictures', 'docs':
            os.makedirs(self.path(name))
        self.write('scenes/tank.yaml', 'view: {kind: splat}\n')
        self.write('scenes/other.yaml', 'view: {kind: slice}\n')
        for view in 'spheres', 'splat_water', 'slice':
            self.write(f'tests/images/{view}.png', 'golden')
        self.write('page.md', self.PAGE.format('red'))
        subprocess.run(['git', 'init', '-q', '.'], cwd=self.folder, check=True)
        self.docs = tool('docs')
        self.docs.ROOT = pathlib.Path(self.folder)
        with contextlib.redirect_stdout(io.StringIO()), self.assertRaises(SystemExit) as made:
            for name in 'a', 'b':  # both are there before
                subprocess.run(['ffmpeg', '-v', 'error', '-f', 'lavfi', '-i', 'color=blue:size=8x8', '-frames:v', '1', self.path(f'x/pictures/{name}.png')], check=True)
            self.docs.make_pictures([])
        self.assertEqual(made.exception.code, 0)

    def older(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            self.docs.check_pictures()
        return sorted(re.findall(r'/(\w+)\.png is older', said.getvalue()))

    def test_what_was_made_is_new(self):
        self.assertEqual(self.older(), [])
        self.assertEqual(self.read('x/pictures/a.png'), self.read('x/pictures/b.png'))
        self.assertNotIn('older', self.read('docs/pictures.txt').decode())

    def test_what_changes_makes_them_older(self):
        """The scene, the golden picture of its view, the command; and not those of others."""
        for name, old in (('scenes/other.yaml', []), ('tests/images/slice.png', []), ('tests/images/splat_water.png', ['a']),
                          ('scenes/tank.yaml', ['a']), ('tests/images/spheres.png', ['b'])):
            before = self.read(name)
            self.write(name, before + b' ')
            self.assertEqual(self.older(), old, name)
            self.write(name, before)
        self.write('page.md', self.PAGE.format('green'))
        self.assertEqual(self.older(), ['a'])
        self.docs.write_list(self.docs.digests(), set())
        self.assertEqual(self.older(), [])
        self.assertEqual(self.read('docs/pictures.txt').decode().count('older'), 1)
        with contextlib.redirect_stdout(io.StringIO()), self.assertRaises(SystemExit):
            self.docs.make_pictures(['a.png'])
        self.assertEqual((self.older(), self.read('docs/pictures.txt').decode().count('older')), ([], 0))


class Docs(CommandTest):
    def test_pictures_are_new_or_marked(self):
        """By docs/pictures.txt; each is made by a command of a page."""
        done = subprocess.run([ROOT / 'tools/docs', 'pictures', '--check'], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, ''), done.stderr)
        self.assertEqual([picture for picture, digest in tool('docs').digests().items() if not digest], [])

    def test_what_the_program_makes_is_new(self):
        done = subprocess.run([ROOT / 'tools/docs', '--check'], env={**os.environ, 'SLOSH': command.PROGRAM},
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, '', ''))

    def test_every_command_has_its_help(self):
        commands = set(re.findall(r'^  slosh (\w+)', help_of(), re.M)) - {'help'}
        parts = re.findall(r'<!-- made: help (\w+) -->', (ROOT / 'docs/manual/commands.md').read_text())
        self.assertEqual(sorted(parts), sorted(commands))

    def test_examples_of_keys_load(self):
        examples = re.findall(r'```yaml\n(.*?)```', (ROOT / 'docs/manual/keys.md').read_text(), re.S)
        self.assertGreater(len(examples), 15)
        os.symlink(ROOT / 'scenes/meshes', self.path('meshes'))
        for k, example in enumerate(examples):
            self.write(f'{k}.yaml', ''.join({**PARTS, **example_parts(example)}.values()))
            code, said = self.slosh('run', f'{k}.yaml', '-o', 'out.h5part', '--time', '0', '--quiet')
            self.assertEqual(code, 0, said + example)
            self.assertTrue('no effect' not in said or example.startswith('metrics:'), said)

    def test_scenes_of_the_guide_load(self):
        scenes = re.findall(r'```yaml\n(title:.*?)```', (ROOT / 'docs/manual/guide.md').read_text(), re.S)
        self.assertEqual(len(scenes), 2)
        for scene in scenes:
            self.write('mine.yaml', scene)
            self.assertEqual(self.slosh('run', 'mine.yaml', '-o', 'out.h5part', '--time', '0', '--quiet'), (0, ''))

    def test_lines_that_one_changes_are_there(self):
        """What a page of docs/add takes from a file is a line of it."""
        taken = []
        for page in ROOT.glob('docs/add/*.md'):
            for block in re.findall(r'```diff\n(.*?)```', page.read_text(), re.S):
                for name, lines in re.findall(r'^--- a/(.*)\n((?:(?!---).*\n)*)', block, re.M):
                    taken += [(name, line[1:]) for line in lines.splitlines() if line[:1] in ('-', ' ')]
        self.assertGreater(len(taken), 4)
        for name, line in taken:
            # without the end of a macro's line
            self.assertIn(line.rstrip(' \\'), [there.rstrip(' \\') for there in (ROOT / name).read_text().splitlines()], name)

    def test_every_case_is_in_the_table(self):
        """All that run by themselves: cavity_400 and cavity_1000 need --full."""
        code, said = self.slosh('validate', 'nosuch')
        self.assertEqual(code, 2)
        names = set(re.search(r'these are there: (.*)', said)[1].split(', ')) - {'cavity_400', 'cavity_1000'}
        figures = json.loads((ROOT / 'docs/labbook/validation.json').read_text())['cases']
        self.assertEqual({figure['case'] for figure in figures}, names)

    def test_commands_and_their_options_are_there(self):
        commands = re.findall(r'^  slosh (\w+)', help_of(), re.M)
        scenes = {path.stem for path in ROOT.glob('scenes/*.yaml')}
        options = {name: set(re.findall(r'^  (--?[a-z-]+) ', help_of(name), re.M)) for name in commands}
        seen = 0
        for page in PAGES:
            for line in re.sub(r'\\\n', ' ', '\n'.join(command_blocks(page.read_text()))).splitlines():
                for words in re.findall(r'(?:^|[ /])slosh ([^;&|#]*)', re.sub(r'"[^"]*"|\[[^\]]*\]', 'X', line)):
                    name, *rest = words.split() or ['play']
                    if name not in commands and not name.startswith('-'):
                        self.assertTrue(name in scenes or '.' in name or name.isupper(), f'{page}: slosh {words}')
                        name = 'play'
                    seen += 1
                    for option in re.findall(r'(?<![^ ])--?[a-z][a-z-]*', ' '.join(rest)):
                        self.assertIn(option, options[name], f'{page}: slosh {words}')
        self.assertGreater(seen, 50)


if __name__ == '__main__':
    command.main()
