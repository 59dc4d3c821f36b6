"""Ends that nobody asks for in the window: the display goes, a signal comes in the middle of a long call."""
import contextlib
import os
import signal
import sys

import Xlib.error

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import FLUID_COLORS, Display, Window

# A step lasts minutes.
LONG = ['--particles', '20000', '--set', 'solver.method=pbf', '--set', 'solver.corrections=10000', '--set', 'solver.compression=0']


class Ends(Window):
    def under_way(self):
        """In its first step, which begins behind the first picture: nothing else takes seconds."""
        self.wait_for(lambda: self.display.colors(self.window) >= FLUID_COLORS, self.process)
        begun = self.worked()
        self.wait_for(lambda: self.worked() > begun + 1.5, self.process)

    def worked(self):
        """Processor time of the program, s."""
        with open(f'/proc/{self.process.pid}/stat') as stat:
            return sum(int(ticks) for ticks in stat.read().rsplit(')', 1)[1].split()[11:13]) / os.sysconf('SC_CLK_TCK')


class Gone(Ends):
    """Each test has a display of its own."""
    @classmethod
    def setUpClass(cls):
        pass

    @classmethod
    def tearDownClass(cls):
        pass

    def setUp(self):
        self.display = Display()
        self.addCleanup(self.close)
        super().setUp()

    def close(self):
        with contextlib.suppress(Xlib.error.ConnectionClosedError):
            self.display.connection.close()
        self.display.process.kill()
        self.display.process.wait()

    def end_display(self):
        """The exit code and the words of the window whose server is killed."""
        self.display.process.kill()
        return self.process.wait(timeout=command.PATIENCE), self.said_now()

    def move_the_box(self):
        self.display.press('Left')
        self.until(lambda now: now['box_position'][0] < -0.02)

    def replayed(self, name):
        self.assertEqual(self.slosh('replay', name, '--quiet'), (0, ''))
        self.assertIn(' target ', self.read(name).decode())

    def test_the_session_is_saved(self):
        self.open('still.yaml', '--record', 'a.recording')
        self.move_the_box()
        code, said = self.end_display()
        self.assertEqual(code, 1, said)
        self.assertIn('the display is gone', said)
        self.assertNotIn('XIO', said)
        self.replayed('a.recording')

    def test_a_session_without_a_name_is_saved(self):
        self.open('still.yaml')
        self.move_the_box()
        code, said = self.end_display()
        self.assertEqual(code, 1, said)
        self.replayed(*self.files('recording'))

    def test_in_the_middle_of_a_call(self):
        """Of the driver, which does not notice."""
        self.start('still.yaml', '--record', 'a.recording', '--backend', 'compute', *LONG)
        self.under_way()
        code, said = self.end_display()
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r'a\.recording: the session, without its last frame\nthe display is gone\n\Z')
        self.assertIn('commands\n', self.read('a.recording').decode())


class Signals(Ends):
    def test_on_the_solvers_thread(self):
        self.start('still.yaml', '--record', 'a.recording', *LONG)
        self.under_way()
        self.process.send_signal(signal.SIGTERM)
        self.end()
        self.assertIn('a.recording: the session, without its last frame', self.messages)
        self.assertIn('commands\n', self.read('a.recording').decode())

    def test_on_the_windows_thread(self):
        self.start('still.yaml', '--record', 'a.recording', '--backend', 'compute', *LONG)
        self.under_way()
        self.process.send_signal(signal.SIGHUP)
        code = self.process.wait(timeout=command.PATIENCE)
        self.assertEqual(code, 0, self.said_now())
        self.assertIn('a.recording: the session, without its last frame', self.said_now())
        self.assertIn('commands\n', self.read('a.recording').decode())


if __name__ == '__main__':
    command.main()
