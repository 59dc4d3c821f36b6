"""A scene file that is saved in an editor while the window shows it."""
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import STILL, Window

SAVED = 'still.yaml was saved'


class Reload(Window):
    def setUp(self):
        super().setUp()
        self.open('still.yaml')
        self.said_before = 0

    def said_now(self):
        with open(self.path('said.txt')) as said:
            return said.read()

    def wait_said(self, words):
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
        self.shown(0.1)
        self.keys('ctrl+s')
        self.wait_said('the session')
        out = self.quit()
        self.assertEqual((out['scenes_opened'], out['camera_auto'], out['color_by']), (1, False, 'density'))
        self.assertEqual(self.slosh('replay', self.files('recording')[0], '--quiet'), (0, ''))
        self.assertIn('set gravity=[0, -3, 0]', self.read(self.files('recording')[0]).decode())

    def test_begins_anew(self):
        """With the camera, the view and what the panel has set; what was done by hand is a file."""
        self.drag(1, [(240, 180), (300, 150)])
        self.keys('s')
        self.display.press('Left')
        self.shown(0.2)
        self.display.release('Left')
        self.save(STILL.replace('spacing: 0.1', 'spacing: 0.125'), whole=False)
        self.wait_said(f'{SAVED}: begins anew with particles.spacing')
        self.filled()
        out = self.quit()
        self.assertEqual((out['scenes_opened'], out['camera_auto'], out['color_by']), (2, False, 'density'))
        self.assertLess(out['particles'], 300)
        self.assertEqual(len(self.files('recording')), 1)

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
        time.sleep(0.2)
        out = self.quit()
        self.assertEqual(out['scenes_opened'], 1)
        self.assertNotIn('still.yaml was', self.messages)


if __name__ == '__main__':
    command.main()
