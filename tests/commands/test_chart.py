"""slosh chart: draws, keeps its runs, does none of them twice."""
import os
import subprocess

import command

SMALL = ['--set', 'particles.spacing=0.1', '--time', '0.1', '--method', 'mueller']


class Chart(command.CommandTest):
    def run_it(self, *words):
        return subprocess.run([command.PROGRAM, 'chart', *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=120, check=False)

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding='utf-8') as file:
            return file.read()

    def test_a_scene_twice(self):
        with open(os.path.join(self.folder, 'tank.yaml'), 'w', encoding='utf-8') as file:
            file.write(command.SCENE)
        first = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertTrue('the finest run is the reference' in self.read('out.svg'))
        self.assertTrue('differ by 1e-6' in self.read('out.svg'))
        rows = self.read('out.csv')
        self.assertEqual(len(rows.splitlines()), 1 + 6 + 1 + 3)
        again = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        self.assertEqual(again.stdout, first.stdout)  # times and all: nothing ran again
        self.assertEqual(self.read('out.csv'), rows)
        # one of them lost: only that one runs again
        with open(os.path.join(self.folder, 'out.csv'), 'w', encoding='utf-8') as file:
            file.writelines(line + '\n' for line in rows.splitlines()[:-1])
        self.assertEqual(self.run_it('tank.yaml', '-o', 'out.svg', *SMALL).returncode, 0)
        kept = self.read('out.csv').splitlines()
        self.assertEqual(len(kept), len(rows.splitlines()))
        self.assertEqual(kept[:-1], rows.splitlines()[:-1])

    def test_a_case(self):
        done = self.run_it('free_fall', '-o', 'out.png', '--method', 'mueller')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.getsize(os.path.join(self.folder, 'out.png')) > 1000)

    def test_what_is_wrong_is_said(self):
        self.assertEqual(self.run_it('dam_break', '-o', 'out.gif').returncode, 2)
        self.assertEqual(self.run_it('no_such_scene', '-o', 'out.svg').returncode, 2)
        self.assertEqual(self.run_it('dam_break', '-o', 'out.svg', '--sweep', 'view=none').returncode, 2)
        self.assertEqual(os.listdir(self.folder), ['scene.yaml'])


if __name__ == '__main__':
    command.main()
