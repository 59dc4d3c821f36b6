"""Pictures that are made to be shown: a camera that flies and turns, a title, GIF."""
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import STILL

PATH = '{time: 0, from: [3, 2, 3], to: [0, 0, 0]}, {time: 0.05, from: [0.5, 1.5, 3], to: [0, 0.2, 0], fov: 40}, ' \
       '{time: 0.1, from: [2, 1, 0], to: [0, 0, 0]}'


def gif_frames(data):
    """Delays of the pictures, in hundredths of a second, and whether it plays again and again."""
    assert data[:6] == b'GIF89a'
    flags = data[10]
    at, delays, delay, loops = 13 + (3 * 2 << (flags & 7) if flags & 128 else 0), [], None, False

    def skip(at):
        while data[at]:
            at += 1 + data[at]
        return at + 1
    while data[at] != 0x3b:
        if data[at] == 0x21:
            if data[at + 1] == 0xf9:
                delay, = struct.unpack('<H', data[at + 4:at + 6])
            loops |= data[at + 3:at + 14] == b'NETSCAPE2.0'
            at = skip(at + 2)
        else:
            assert data[at] == 0x2c
            flags = data[at + 9]
            at = skip(at + 11 + (3 * 2 << (flags & 7) if flags & 128 else 0))
            delays.append(delay)
    return delays, loops


class Film(command.CommandTest):
    def render(self, name, *settings, time='0.05'):
        self.write('still.yaml', STILL)
        arguments = [word for setting in ('view.carries_scene=false', *settings) for word in ('--set', setting)]
        code, said = self.slosh('render', 'still.yaml', '-o', name, '--time', time, '--size', '160x120', '--quiet', *arguments)
        self.assertEqual(code, 0, said)
        return self.read(name)

    def test_camera(self):
        """At a keyframe it is the picture of a camera that is set by hand."""
        flown = self.render('a.png', f'view.camera_path=[{PATH}]')
        self.assertEqual(flown, self.render('b.png', 'view.camera={from: [0.5, 1.5, 3], to: [0, 0.2, 0], fov: 40}'))
        self.assertNotEqual(flown, self.render('c.png', f'view.camera_path=[{PATH}]', time='0.06'))
        self.assertNotEqual(self.render('d.png'), self.render('e.png', 'view.camera_turn=100'))
        self.assertNotEqual(self.render('d.png'), self.render('e.png', 'view.title=A tank'))
        code, said = self.slosh('info', 'still.yaml', '--set', f'view.camera_path=[{PATH}, {{time: 0.1, from: [1, 1, 1], to: [0, 0, 0]}}]')
        self.assertEqual(code, 2)
        self.assertIn('view.camera_path[3].time must be later than that of the keyframe before, 0.1 s', said)

    def test_gif(self):
        self.write('still.yaml', STILL)
        arguments = ['render', 'still.yaml', '-o', 'a.gif', '--frames', '5', '--size', '63x47', '--quiet', '--set', 'view.camera_turn=90']
        self.assertEqual(self.slosh(*arguments, '--fps', '25')[0], 0)
        self.assertEqual(gif_frames(self.read('a.gif')), ([4] * 5, True))
        self.assertEqual(struct.unpack('<HH', self.read('a.gif')[6:10]), (63, 47))
        code, said = self.slosh(*arguments, '--fps', '60')
        self.assertEqual(code, 1)
        self.assertIn('a.gif: a .gif has at most 50 pictures a second, not 60', said)


if __name__ == '__main__':
    command.main()
