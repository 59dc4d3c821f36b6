"""Each scene of scenes/failures provokes what its comment says, slosh says so in those words, and what the comment names mends it."""
import json
import pathlib
import shlex
import subprocess
import tempfile
import unittest

import command

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = sorted((ROOT / 'scenes/failures').glob('*.yaml'))


def told(path):
    """The two commands of a scene's comment, and the lines that it says."""
    lines = [line[1:].strip() for line in path.read_text().splitlines() if line.startswith('#')]
    commands = [shlex.split(line)[1:] for line in lines if line.startswith('slosh ')]
    return commands, [line.removeprefix('Says: ') for line in lines if line.startswith('Says: ')]


class Failures(unittest.TestCase):
    def said_by(self, words):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([command.PROGRAM, *words, '--threads', '1', '--quiet'], cwd=folder, capture_output=True, text=True,
                                  check=False)
        self.assertIn(done.returncode, (0, 1, 2), (words, done.stderr))
        return done.stderr, done.returncode

    def test_a_run_says_how_it_went(self):
        """The kind's word in the terminal, and the same in the JSON; a run that goes on says it of what it finds."""
        with tempfile.TemporaryDirectory() as folder:
            for scene, more, kind in (('failures/closed_door', ['--time', '1'], 'squeezed'),
                                      ('failures/closed_door', ['--time', '1.1', '--resume'], 'squeezed'),
                                      ('failures/thin_sheet', ['--time', '0.05'], 'holds')):
                done = subprocess.run([command.PROGRAM, 'run', scene, '-o', f'{kind}.h5part', *more, '--json', 'a.json', '--quiet'],
                                      cwd=folder, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                json_ = json.loads((pathlib.Path(folder) / 'a.json').read_text())
                self.assertEqual(json_['outcome'], kind)
                if kind == 'holds':
                    self.assertNotIn('outcome_words', json_)
                else:
                    self.assertIn(f"t = {json_['outcome_time']:.4g} s: {kind}: fluid has lost volume", done.stderr)
                    self.assertRegex(json_['outcome_words'], r'it is pressed by \d')
                    self.assertEqual('--resume' in more, json_['outcome_time'] >= 1)

    def test_energy_that_is_not_watched_is_said(self):
        """Where a solid on a way of its own does work that nobody sums."""
        words = 'energy that grows without work is not watched here: the work of solids'
        ball = 'solids=[{sphere: {centre: [0, 0.5, 0], radius: 0.1}, motion: [{shake: {axis: [1, 0, 0], amplitude: 0.1, frequency: 1}}]}]'
        for more, unwatched in ((['--method', 'pbf', '--set', ball], True), (['--method', 'mueller', '--backend', 'compute', '--set', ball], True),
                                (['--method', 'mueller', '--set', ball], False), (['--method', 'pbf'], False), (['--backend', 'compute'], False)):
            said, code = self.said_by(['info', 'box_slosh', *more])
            self.assertEqual(code, 0, said)
            self.assertEqual(words in said, unwatched, (more, said))

    def test_each_is_said_and_mended(self):
        self.assertGreater(len(SCENES), 16)
        for path in SCENES:
            with self.subTest(path.stem):
                commands, lines = told(path)
                self.assertEqual(len(commands), 2, 'a command that fails, and one that does not')
                self.assertTrue(lines, 'no line of what slosh says')
                self.assertTrue((ROOT / f'docs/manual/failures/{path.stem}.png').exists(), 'no picture; docs/manual/failures.md has the command')
                for words in commands:
                    self.assertEqual(words[1], f'failures/{path.stem}')
                said, code = self.said_by(commands[0])
                for line in lines:
                    self.assertIn(line, said)
                # blew up, or stopped; 2: nothing ran
                self.assertEqual(code > 0, code == 2 or 'the simulation ' in said or 'raise solver.' in said, said)
                said, code = self.said_by(commands[1])
                self.assertEqual((code, said), (0, ''))


if __name__ == '__main__':
    command.main()
