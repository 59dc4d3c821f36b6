"""A scene file that is saved in an editor while the window shows it."""
import glob
import os
import resource
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import STILL, Window

SAVED = 'still.yaml was saved'


class Reload(Window):
    def setUp(self):
        super().setUp()
        self.open('still.yaml')
        self.said_before = 0

    def wait_said(self, words, times=1):
        """After what was said the last time."""
        self.wait_for(lambda: words in self.said_now()[self.said_before:], self.process)
        self.said_before = len(self.said_now())

    def save(self, text, whole=True):
        """As editors do: beside it, then renamed; or in place."""
        self.write('still.yaml~' if whole else 'still.yaml', text)
        if whole:
            os.rename(self.path('still.yaml~'), self.path('still.yaml'))

    def test_live(self):
        """The camera is where it was put, time runs on, and the session does it again."""
        self.drag(1, [(240, 180), (300, 150)])
        self.save(STILL + 'gravity: [0, -3, 0]\nview: {color_by: density}\n')
        self.wait_said(f'{SAVED}: ')
        self.drawn()
        self.keys('ctrl+s')
        self.wait_said('the session')
        out = self.quit()
        self.assertEqual((out['scenes_opened'], out['camera_auto'], out['color_by']), (1, False, 'density'))
        self.assertEqual(self.slosh('replay', self.files('recording')[0], '--quiet'), (0, ''))
        self.assertIn('set gravity=[0, -3, 0]', self.read(self.files('recording')[0]).decode())

    def test_begins_anew(self):
        """With the camera, the view and what the panel has set; what was done by hand is a file."""
        self.drag(1, [(240, 180), (300, 150)])
        self.keys('s', 'v')
        self.display.press('Left')
        self.until(lambda now: now['box_position'][0] < -0.02)
        self.display.release('Left')
        self.save(STILL.replace('spacing: 0.1', 'spacing: 0.125'), whole=False)
        self.wait_said(f'{SAVED}: begins anew with particles.spacing')
        self.filled()
        self.keys('v')  # a video goes on
        self.wait_said('.mp4: the video')
        out = self.quit()
        self.assertEqual((out['scenes_opened'], out['camera_auto'], out['color_by']), (2, False, 'density'))
        self.assertLess(out['particles'], 300)
        self.assertEqual(len(self.files('recording')), 1)

    def test_files_that_it_names(self):
        """They begin it anew; and the camera moves by itself until it is taken."""
        self.write('h.csv', 'x,height\n-0.5,0.2\n0.5,0.4\n')
        self.save(STILL.replace('0.4, 0.5]}', '0.4, 0.5]}, below: h.csv') + 'view: {camera_turn: 20}\n')
        self.wait_said(f'{SAVED}: begins anew with ')
        self.filled()
        self.write('h.csv', 'x,height\n-0.5,0.2\n0.5,0.3\n')
        self.wait_said(f'{SAVED}: begins anew with a file that it names')
        self.filled()
        still = self.display.picture(self.window)
        self.wait_for(lambda: self.display.picture(self.window) != still, self.process)
        self.drag(1, [(240, 180), (300, 150)])
        self.keys('ctrl+shift+s')
        self.wait_said('still-2.yaml: the scene with ')
        out = self.quit()
        self.assertEqual((out['scenes_opened'], out['camera_auto']), (3, False))
        self.assertIn('camera_turn: 0', self.read('still-2.yaml').decode())

    def test_a_session_that_cannot_be_saved_goes_on(self):
        """With --record, where no file may be as large: said once; when there is room again it is saved and begins anew."""
        self.quit()
        self.write('still.yaml', STILL + 20000 * '#' + '\n')
        self.open('still.yaml', '--record', 'a.recording')
        resource.prlimit(self.process.pid, resource.RLIMIT_FSIZE, (8192, resource.RLIM_INFINITY))
        self.save(STILL.replace('spacing: 0.1', 'spacing: 0.125'))
        self.wait_said('recording: cannot be written: File too large')
        self.runs(0.3)
        self.assertNotIn('begins anew', self.said_now())
        self.assertEqual(self.said_now().count('recording: cannot be written: File too large'), 1, self.said_now())
        resource.prlimit(self.process.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        self.save(STILL.replace('spacing: 0.1', 'spacing: 0.12'))
        self.wait_said(f'{SAVED}: begins anew with particles.spacing')
        out = self.quit()
        self.assertEqual(out['scenes_opened'], 2)
        self.assertEqual(len(self.files('recording')), 1)

    def has_child(self):
        names = glob.glob(f'/proc/{self.process.pid}/task/*/children')
        return subprocess.run(['cat', *names], capture_output=True, check=False).stdout != b''

    def test_a_mesh_that_takes_long(self):
        """The window goes on meanwhile, and its end does not wait for it."""
        os.mkfifo(self.path('m.mtl'))  # who opens it waits for another one
        self.write('m.obj', 'mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
        for spacing in (0.1, 0.12):
            self.save(STILL.replace('0.1', str(spacing)) + 'solids: [{mesh: {file: m.obj, centre: [0, 0.7, 0]}}]\n')
            self.wait_for(self.has_child, self.process)
            if spacing == 0.1:
                self.display.press('Left')
                self.until(lambda now: now['box_position'][0] < -0.02)
                self.display.release('Left')
                self.assertTrue(self.has_child())
                os.close(os.open(self.path('m.mtl'), os.O_WRONLY | os.O_NONBLOCK))
                self.wait_said('m.obj: the mesh is open')
        self.process.send_signal(signal.SIGTERM)
        self.end()

    def test_broken(self):
        """The last good one goes on, until it is mended."""
        self.save(STILL.replace('size: [1, 1, 1]', 'size: [1, 1'), whole=False)
        self.wait_said('still.yaml:')
        self.save(STILL.replace('spacing: 0.1', 'spacing: -1'))
        self.wait_said('still.yaml:3:22: particles.spacing')
        self.assertIsNone(self.process.poll())
        self.save('')
        os.remove(self.path('still.yaml'))  # between two writes, and back before anyone asks
        self.save(STILL)
        self.wait_said('still.yaml is right again')
        self.drawn()
        out = self.quit()
        self.assertEqual(out['scenes_opened'], 1)
        self.assertNotIn('still.yaml was', self.messages)


if __name__ == '__main__':
    command.main('Reload.test_live Reload.test_broken Reload.test_a_session_that_cannot_be_saved_goes_on',
                 'Reload.test_begins_anew Reload.test_files_that_it_names Reload.test_a_mesh_that_takes_long')
