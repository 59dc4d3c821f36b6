"""Bad scenes and settings: exit code 2, a message with the place, no file. Each kind by `run`, some by every command; all that
the loader refuses, with its words: tests/scene."""
import os
import random
import re

import command
from command import SCENE, CommandTest

# What each command would write.
COMMANDS = [['run', '-o', 'out.h5part'], ['render', '-o', 'out.png'], ['render', '-o', 'out.mp4'],
            ['render', '-o', 'out'], ['bench', '--json', 'out.json'], ['info', '--json', 'out.json']]


class BadInput(CommandTest):
    def refused(self, scene, place, words, *more, commands=None):
        """Every command refuses it, with a message that begins with `place` and contains `words`."""
        before = self.entries()
        for name, *output in commands or COMMANDS:
            with self.subTest(command=name, output=output):
                code, said = self.slosh(name, scene, *output, *more)
                self.assertEqual(code, 2, said)
                self.assertTrue(said.startswith(place), f'{said!r} does not begin with {place!r}')
                self.assertRegex(said, words)
                self.assertEqual(self.entries(), before)

    def refused_text(self, text, line, words, commands=COMMANDS[:1]):
        """As a scene file; `line` None: a message without a line is fine."""
        self.write('bad.yaml', text)
        self.refused('bad.yaml', 'bad.yaml:' if line is None else f'bad.yaml:{line}:', words, commands=commands)
        if line is not None:
            code, said = self.slosh('run', 'bad.yaml', '-o', 'out.h5part')
            self.assertEqual(code, 2)
            self.assertRegex(said, rf'^bad\.yaml:{line}:\d+: \S.*\n')

    def changed(self, old, new):
        """The good scene with one text in place of another, and the line of that."""
        self.assertIn(old, SCENE)
        return SCENE.replace(old, new, 1), SCENE[:SCENE.index(old)].count('\n') + 1

    def refused_change(self, old, new, words, commands=COMMANDS[:1]):
        text, line = self.changed(old, new)
        self.refused_text(text, line, words, commands)

    def test_the_scene_itself_is_good(self):
        code, said = self.slosh('run', 'scene.yaml', '-o', 'out.h5part', '--time', '0', '--quiet')
        self.assertEqual((code, said), (0, ''))

    def test_not_yaml(self):
        self.write('bad.yaml', 'box: {size: [1, 1\nfluids: ]]}\n')
        self.refused('bad.yaml', 'bad.yaml:2:', '.')

    def test_unknown_key(self):
        self.refused_change('spacing: 0.1', 'spacng: 0.1', r"spacng.*spacing", COMMANDS)

    def test_wrong_type(self):
        self.refused_change('spacing: 0.1', 'spacing: [1, 2]', 'number')
        self.refused_change('spacing: 0.1', 'spacing: small', 'number')
        self.refused_change('size: [1, 1, 1]', 'size: 1', '.')

    def test_negative_spacing(self):
        self.refused_change('spacing: 0.1', 'spacing: -0.1', '-0.1')

    def test_nan_spacing(self):
        for value in ('.nan', 'nan', '.inf'):
            self.refused_change('spacing: 0.1', f'spacing: {value}', '.')

    def test_fluid_outside_the_box(self):
        self.refused_change('max: [0, 0.5, 0.5]', 'max: [0, 5, 0.5]', 'box')

    def test_two_billion_particles(self):
        text = SCENE.replace('spacing: 0.1', 'spacing: 0.00063')  # 0.5 m3 / (0.63 mm)^3
        self.refused_text(text, 3, 'particles')
        self.refused('scene.yaml', '', 'particles', '--particles', '2000000000', commands=COMMANDS[:3])

    def test_missing_file(self):
        self.refused('missing.yaml', 'missing.yaml', 'No such file|not found|no such')

    def test_directory(self):
        os.mkdir(self.path('folder.yaml'))
        self.refused('folder.yaml', 'folder.yaml', 'folder|directory')

    def test_a_folder_named_like_a_scene(self):
        os.mkdir(self.path('bowl'))
        code, said = self.slosh('run', 'bowl', '-o', 'bowl.h5part', '--time', '0', '--quiet')
        self.assertEqual(code, 0, said)

    def test_files_of_other_commands(self):
        for text, takes, commands in (
                ('slosh recording 1\nprogram 0.1\n', 'the window, slosh replay and slosh render take it', COMMANDS[:1]),
                ('\x89HDF\r\n\x1a\n', 'slosh play, slosh render and slosh export take it', COMMANDS[:2]),
                ('slosh device recording 1\n', '--device file:PATH takes it', COMMANDS[:2])):
            self.write('other', text.encode('latin-1'))
            self.refused('other', 'other: ', f'no scene; {takes}', commands=commands)

    def test_a_scene_that_is_nearly_named(self):
        self.refused('dam_brake', 'dam_brake: no such file', "did you mean 'dam_break'", commands=COMMANDS[:2])

    def test_empty_file(self):
        self.refused_text('', None, 'empty')

    def test_binary_noise(self):
        noise = random.Random(1)
        for size in (10, 100000):
            self.write('bad.yaml', bytes(noise.randrange(256) for _ in range(size)))
            self.refused('bad.yaml', 'bad.yaml', '.', commands=COMMANDS[:1])
        self.write('bad.yaml', b'\x7fELF\0\0\0')
        self.refused('bad.yaml', 'bad.yaml', '.', commands=COMMANDS[:2])

    def test_megabytes_of_braces(self):
        self.refused_text('{' * 3_000_000, None, '.')

    def test_anchors_that_refer_to_themselves(self):
        self.refused_text(SCENE + 'view: &a {camera: *a}\n', None, '.')
        self.refused_text('&a [*a, *a]\n', None, '.')

    def test_settings(self):
        self.refused('scene.yaml', '', r'partcles.*particles', '--set', 'partcles.spacing=1')
        for setting, words in (('particles.spacing=-1', r'-1'), ('solver.method=magic', r'magic.*mueller'), ('particles.spacing', r'=')):
            self.refused('scene.yaml', '', words, '--set', setting, commands=COMMANDS[:1])
        for setting, meant in (('fluids.viscosity=3', 'fluids[0].viscosity'),
                               ('fluids[1].fill.block.min=[0,0,0]', 'fluids[1].fill[0].block.min'),
                               ('motion.rock.angle=3', 'motion[0].rock.angle')):
            self.refused('scene.yaml', f'--set {setting}: ', re.escape(f"did you mean '{meant}'?"), '--set', setting,
                         commands=COMMANDS[:1])

    def test_command_line(self):
        for arguments, words in ((['--tme', '1'], '--tme'), (['--threads'], '--threads'),
                                 (['--threads', 'many'], 'many'), (['--backend', 'abacus'], 'abacus.*cpu')):
            self.refused('scene.yaml', '', words, *arguments, commands=[COMMANDS[0], COMMANDS[2]])
        for option, value in (('--backend', 'cuda'), ('--method', 'sph'), ('--view', 'x'), ('--threads', 'many')):
            self.refused('scene.yaml', f'{option} {value}: ', value, option, value, commands=[COMMANDS[0], COMMANDS[4]])
        for option in ('--sweep', '--set'):  # what they stand for, said by the one or the other
            self.refused('scene.yaml', f'{option} solver.backend=cuda: ', 'cuda', option, 'solver.backend=cuda',
                         commands=[['bench']])
        self.refused('--backend=cuda', '--backend cuda: ', 'cuda', '--table', 'paper003-spheres', commands=[['bench']])
        for command_ in COMMANDS[:4]:
            self.refused('scene.yaml', '', '--time', '--time', '-1', commands=[command_])
        self.refused('scene.yaml', "cannot tell the format from 'x.webm'; use .png, .mp4", '.', '-o', 'x.webm', commands=[['render']])
        code, said = self.slosh('rnder', 'scene.yaml')
        self.assertEqual(code, 2)
        self.assertIn('render', said)


if __name__ == '__main__':
    command.main()
