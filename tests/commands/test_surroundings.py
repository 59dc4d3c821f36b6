"""What surrounds the program: standard streams that are closed, as by a daemon or `2>&-`; other programs; a driver without room."""
import os
import resource
import subprocess
import unittest

import command
from command import CommandTest, TinyDiskTest, obey_interrupts, video_frames, whole_steps


class Closed(CommandTest):
    def closed(self, streams, *arguments):
        """The program's exit code and what it said on the streams that are left."""
        done = subprocess.run(['sh', '-c', f'exec "$@" {streams}', 'sh', command.PROGRAM, *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=command.PATIENCE, preexec_fn=obey_interrupts, check=False)
        return done.returncode, done.stdout, done.stderr

    def run_closed(self, streams, *more, time='0.008'):
        return self.closed(streams, 'run', 'scene.yaml', '-o', 'a.h5part', '--time', time, '--every', '0.004', *more)

    def test_snapshots(self):
        for streams in ('2>&-', '>&- 2>&-', '<&- >&- 2>&-'):
            self.assertEqual(self.run_closed(streams, '--forces', 'f.csv'), (0, '', ''), streams)
            self.assertEqual(len(whole_steps(self.path('a.h5part'))), 3)
            self.assertTrue(self.read('f.csv').startswith(b'time,'), self.read('f.csv')[:80])
            self.assertEqual(self.run_closed(streams, '--resume', time='0.012'), (0, '', ''), streams)
            self.assertEqual(len(whole_steps(self.path('a.h5part'))), 4)

    def test_figures_that_cannot_be_written_are_a_failure(self):
        code, _, said = self.run_closed('>&-', '--json', '-', '--quiet')
        self.assertEqual((code, said), (1, '-: cannot write the results: Bad file descriptor\n'))
        self.assertEqual(len(whole_steps(self.path('a.h5part'))), 3)
        self.assertEqual(self.closed('>&-', 'scenes')[::2], (1, 'slosh: standard output: Bad file descriptor\n'))
        self.assertEqual(self.closed('>/dev/full', 'scenes')[::2], (1, 'slosh: standard output: No space left on device\n'))

    def test_children(self):
        """ffmpeg and gnuplot, whose pipes and messages have numbers of their own."""
        small = ['--time', '0.1', '--fps', '20', '--size', '64x48']
        self.assertEqual(self.closed('<&- >&- 2>&-', 'render', 'scene.yaml', '-o', 'a.mp4', *small)[0], 0)
        self.assertEqual(video_frames(self.path('a.mp4')), 2)
        self.write('scene.yaml', command.SCENE + 'probes: [{name: level, height: {at: [0.5, 0, 0]}}]\n')
        self.assertEqual(self.run_closed('<&- >&- 2>&-', '--probes', 'p.svg')[0], 0)
        self.assertIn(b'</svg>', self.read('p.svg')[-100:])
        self.assertEqual(self.read('p.csv').count(b'\n'), 6)


class Tools(CommandTest):
    """What others' programs do, and that they are missing."""
    def with_tools(self, **scripts):
        """An environment that has these programs, and no other."""
        os.mkdir(self.path('bin'))
        for name, script in scripts.items():
            self.write(f'bin/{name}', '#!/bin/sh\n' + script)
            os.chmod(self.path(f'bin/{name}'), 0o700)
        return {**os.environ, 'PATH': self.path('bin')}

    def test_an_empty_film_is_none(self):
        self.write('a.mp4', 'old')
        env = self.with_tools(ffmpeg='while read -r _; do :; done\nexit 0\n')
        code, said = self.slosh('render', 'scene.yaml', '-o', 'a.mp4', '--frames', '2', '--size', '32x32', '--quiet', env=env)
        self.assertEqual(code, 1)
        self.assertIn('\na.mp4: ffmpeg has written nothing\n', said)
        self.assertEqual(self.read('a.mp4'), b'old')
        self.assertEqual(self.entries(), ['a.mp4', 'bin'])

    def test_gnuplot_is_missed_before_the_work(self):
        env = self.with_tools()
        for arguments in (['chart', 'scene.yaml', '-o', 'a.svg'], ['validate', 'free_fall', '-o', 'plots'],
                          ['bench', '--table', 'paper003-spheres', '-o', 'a.svg']):
            code, said = self.slosh(*arguments, '--quiet', env=env)
            self.assertEqual(code, 1, said)
            self.assertRegex(said, r'(?m)^(a\.svg|plots): gnuplot, which draws charts, is not installed; install gnuplot-nox$')
            self.assertNotIn('sh:', said)
            self.assertEqual(self.entries(), ['bin'])


PICTURE = ['render', 'scene.yaml', '-o', 'a.png', '--time', '0', '--size', '32x32']


class Driver(TinyDiskTest):
    def test_a_cache_without_room(self):
        """Mesa maps its file of shaders there, and would end by SIGBUS."""
        line = ' '.join(['XDG_CACHE_HOME=$PWD/disk', command.PROGRAM, *PICTURE])
        done = self.on_disk('200k', line)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('/disk: no room for the driver\'s cache of shaders; each start makes them anew\n', done.stderr)
        self.assertNotIn('no room', self.on_disk('8m', line).stderr)

    @unittest.skipIf('LSAN_OPTIONS' in os.environ, 'a sanitizer needs more')
    def test_little_memory(self):
        """A crash of the driver is a failure that is said, and leaves nothing."""
        crashes = 0
        for mib in (300, 500, 600):
            def limit(size=mib << 20):
                obey_interrupts()
                resource.setrlimit(resource.RLIMIT_AS, (size, size))
            for arguments in (['info'], PICTURE, ['run', 'scene.yaml', '-o', 'a.h5part', '--time', '0', '--backend', 'compute']):
                code, said = self.slosh(*arguments, before=limit, gl_errors=True)
                self.assertIn(code, (0, 1), (mib, arguments, said))
                self.assertEqual([name for name in self.entries() if name.endswith('.tmp')], [])
                crashes += 'a library crashed, the OpenGL driver most likely: memory may be short' in said
        if crashes == 0:
            self.skipTest('this driver does not crash')


if __name__ == '__main__':
    command.main()
