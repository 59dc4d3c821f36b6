"""kill -9 at many random moments: each file is whole, and what goes on comes to the same bytes."""
import os
import random
import shutil
import signal
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
import test_export
import test_probes
import test_resume
from command import whole_steps


class Moments:
    """Random ones, within the time that the program takes without a kill."""

    def __init__(self, within):
        self.seed, self.within = random.randrange(1 << 30), within
        self.numbers = random.Random(self.seed)

    def wait(self):
        time.sleep(0.02 + self.numbers.random() * self.within)


def took(action):
    began = time.monotonic()
    action()
    return time.monotonic() - began


class Resume(test_resume.ResumeTest):
    def test_a_run_goes_on(self):
        steps = self.whole()
        moments = Moments(0.6 * took(lambda: self.go(name='again.h5part')))
        kills = 0
        for _ in range(60):  # a busy machine lets many a run end before its moment has come
            if kills > 10:
                break
            process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', test_resume.TIME, '--every', test_resume.EVERY,
                                 '--quiet', '--resume', '--threads', str(1 + kills % 2))
            moments.wait()
            process.kill()
            kills += process.wait() == -signal.SIGKILL
            if os.path.exists(self.path('a.h5part')):
                self.assertGreater(len(whole_steps(self.path('a.h5part'))), 0, f'seed {moments.seed}')
                shutil.copy(self.path('a.h5part'), self.path('b.h5part'))
                self.go('--resume', name='b.h5part')
                self.same('whole.h5part', 'b.h5part')
                if len(whole_steps(self.path('a.h5part'))) > steps / 2:
                    os.remove(self.path('a.h5part'))
        self.assertGreater(kills, 10)


class Probes(test_probes.ProbesTest):
    def test_a_table_goes_on(self):
        moments = Moments(0.7 * took(lambda: self.go('--probes', 'whole.csv', name='whole.h5part')))
        kills = 0
        for _ in range(40):
            if kills > 5:
                break
            process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', test_probes.TIME, '--every', test_probes.EVERY,
                                 '--quiet', '--resume', '--probes', 'a.csv')
            moments.wait()
            process.kill()
            kills += process.wait() == -signal.SIGKILL
            self.go('--resume', '--probes', 'a.csv')
            self.assertEqual(self.read('whole.csv'), self.read('a.csv'), f'seed {moments.seed}')
            os.remove(self.path('a.h5part'))
            os.remove(self.path('a.csv'))
        self.assertGreater(kills, 5)


class Run(test_export.SeriesTest):
    def test_its_file_has_whole_steps(self):
        moments = Moments(0.05)
        for _ in range(5):
            process = self.write_on('0.004', 200000)
            moments.wait()
            process.kill()
            process.wait()
            self.assertGreater(len(whole_steps(self.path('a.h5part'))), 0)
            self.assertEqual(self.entries(), ['a.h5part'])


class Export(test_export.SeriesTest):
    def test_what_a_killed_run_left(self):
        moments = Moments(0.3)
        for _ in range(5):
            process = self.write_on('0.004')
            moments.wait()
            process.kill()
            process.wait()
            self.export('a.pvd')
            self.assert_whole_series('a', len(whole_steps(self.path('a.h5part'))))

    def test_an_export_that_is_killed(self):
        self.make()
        self.stretch(3000)
        moments = Moments(0.2)
        for _ in range(6):
            process = self.begin()
            moments.wait()
            process.kill()
            if process.wait() == 0:
                shutil.rmtree(self.path('b'))
                os.remove(self.path('b.pvd'))
                continue
            self.assertFalse({'b', 'b.pvd'} & set(self.entries()), f'seed {moments.seed}')
            self.assertTrue(all(name.endswith('.tmp') for name in self.entries() if name != 'a.h5part'))


if __name__ == '__main__':
    command.main()
