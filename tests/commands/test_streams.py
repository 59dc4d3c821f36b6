"""A program whose standard streams are closed, as by a daemon or `2>&-`: what it says goes into no output."""
import subprocess

import command
from command import CommandTest, obey_interrupts, video_frames, whole_steps


class Closed(CommandTest):
    def closed(self, streams, *arguments):
        """The program's exit code and what it said on the streams that are left."""
        done = subprocess.run(['sh', '-c', f'exec "$@" {streams}', 'sh', command.PROGRAM, *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=120, preexec_fn=obey_interrupts, check=False)
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


if __name__ == '__main__':
    command.main()
