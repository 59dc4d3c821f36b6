"""slosh devices: what is known, recordings shown, recorded again, and refused."""
import fcntl
import json
import os
import pty
import re
import shlex
import signal
import struct
import subprocess
import termios
import time
import unittest

import h5py

import command
import test_motion
from command import CommandTest, limit_files, obey_interrupts

HEAD = 'slosh device recording 1\nprogram 0.1\n'


def sense(turn=0, buttons=8):
    """A DualSense's report over USB: degrees/s about x, the first byte of buttons."""
    report = bytearray(64)
    report[0] = 1
    report[1:5] = bytes([128, 128, 255, 0])
    report[8] = buttons
    struct.pack_into('<6h', report, 16, 16 * turn, 0, 0, 0, 8192, 0)
    return report.hex()


def cap(x, y, z):
    return (b'\x01' + struct.pack('<3h', x, y, z)).hex()


def recording(seconds=0.4):
    lines = [HEAD + '0.000000 1 plugged dualsense 054c:0ce6 usb DualSense\n'
             '0.000000 2 plugged spacemouse 046d:c626 usb SpaceNavigator\n']
    for i in range(int(seconds * 100)):
        lines.append(f'{i / 100:.6f} 1 report {sense(100, 0x28)}\n')
        lines.append(f'{i / 100:.6f} 2 report {cap(350, -175, 0)}\n')
    lines.append(f'{seconds:.6f} 2 report ff\n')
    return ''.join(lines)


class Case(CommandTest):
    def run_devices(self, *arguments, code=0, before=obey_interrupts):
        done = subprocess.run([command.PROGRAM, 'devices', *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=command.PATIENCE, preexec_fn=before, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done


class Devices(Case):
    def test_lists_what_is_known(self):
        """Whatever is plugged in where this runs."""
        out = self.run_devices('--json', 'a.json').stdout
        if 'no motion device is plugged in' in out:
            for word in ['3Dconnexion SpaceMouse', '046d:c626  SpaceNavigator', '256f:c635', 'Sony DualShock 4', 'Sony DualSense',
                         '054c:0df2']:
                self.assertIn(word, out)
        known = json.loads(self.read('a.json'))['known']
        self.assertIn({'name': 'DualSense', 'family': 'dualsense', 'id': '054c:0ce6'}, known)
        self.assertEqual(self.run_devices('--quiet').stdout, '')

    def test_lists_a_recording(self):
        self.write('a.rec', recording())
        out = self.run_devices('--device', 'file:a.rec', '--json', 'a.json').stdout
        self.assertEqual(out, '1 DualSense (054c:0ce6, USB): 40 reports\n2 SpaceNavigator (046d:c626, USB): 41 reports\n'
                              '2 devices, 0.40 s\n')
        devices = json.loads(self.read('a.json'))['devices']
        self.assertEqual([(d['name'], d['reports']) for d in devices], [('DualSense', 40), ('SpaceNavigator', 41)])

    def test_watch_says_a_line_a_change(self):
        self.write('a.rec', recording())
        began = time.monotonic()
        out = self.run_devices('--watch', '--device', 'file:a.rec', '--json', 'a.json').stdout
        self.assertGreaterEqual(time.monotonic() - began, 0.4)
        lines = out.splitlines()
        self.assertIn('1 DualSense (054c:0ce6): plugged in', lines)
        self.assertIn('1 DualSense: unplugged after 40 reports, 0 refused', lines)
        self.assertIn('2 SpaceNavigator: unplugged after 40 reports, 1 refused', lines)
        pad = [line for line in lines if ' 1 DualSense: turn' in line]
        self.assertEqual(len(pad), 1)  # it says the same all the time
        self.assertRegex(pad[0], r'^0\.\d\d 1 DualSense: turn \+1\.75 \+0\.00 \+0\.00 rad/s, feel \+0\.00 \+9\.81 \+0\.00 m/s2, '
                                 r'left \+0\.00 \+0\.00, right \+1\.00 -1\.00, pull \+0\.00 \+0\.00, buttons cross$')
        mouse = [line for line in lines if ' 2 SpaceNavigator: move' in line]
        self.assertRegex(mouse[0], r': move \+1\.00 \+0\.00 -0\.50, turn \+0\.00 \+0\.00 \+0\.00, buttons$')
        self.assertEqual([(d['reports'], d['refused']) for d in json.loads(self.read('a.json'))['devices']], [(40, 0), (40, 1)])

    def test_a_loose_cable_is_watched_to_the_end(self):
        """Each time it comes it is another device."""
        self.write('a.rec', HEAD + ''.join(f'{n / 20} {n} plugged dualsense 054c:0ce6 usb\n{n / 20} {n} report {sense(n)}\n'
                                           f'{n / 20 + 0.02:.2f} {n} unplugged\n' for n in range(1, 41)))
        said = self.run_devices('--watch', '--device', 'file:a.rec').stdout
        for n in range(1, 41):
            self.assertIn(f'\n{n} DualSense: unplugged after 1 report', '\n' + said)

    def test_lines_are_bounded(self):
        """Ten a second and device, and the last one always."""
        self.write('a.rec', HEAD + '0 1 plugged dualsense 054c:0ce6 usb\n' +
                   ''.join(f'{i / 1000:.6f} 1 report {sense(i)}\n' for i in range(1000)))
        lines = [line for line in self.run_devices('--watch', '--device', 'file:a.rec').stdout.splitlines() if 'turn' in line]
        self.assertTrue(3 <= len(lines) <= 12, lines)
        self.assertIn('turn +17.44', lines[-1])  # 999 degrees/s

    def watch_on_a_terminal(self, rows=0, columns=0):
        """What the terminal is sent."""
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack('4H', rows, columns, 0, 0))
        process = subprocess.Popen([command.PROGRAM, 'devices', '--watch', '--device', 'file:a.rec'], cwd=self.folder, stdout=slave)
        os.close(slave)
        text = b''
        while True:
            try:
                more = os.read(master, 65536)
            except OSError:
                break
            if not more:
                break
            text += more
        os.close(master)
        self.assertEqual(process.wait(60), 0)
        return text.decode()

    def widest(self, text):
        """Of the lines of bars."""
        return max(len(re.sub(r'\x1b\[\d*[A-Z]', '', line)) for line in text.splitlines() if '\x1b[K' in line)

    def test_watch_draws_bars_on_a_terminal(self):
        self.write('a.rec', recording(0.2))
        text = self.watch_on_a_terminal()
        self.assertRegex(text, r'turn  x\[     \|##   \]  \+1\.75 y\[')
        self.assertRegex(text, r'feel  x.* y\[     \|##   \]  \+9\.81 z')
        self.assertRegex(text, r'move  x\[     \|#####\]  \+1\.00 y.* z\[  ###\|     \]  -0\.50')
        self.assertLess(self.widest(text), 80)
        self.assertRegex(text, r'\x1b\[\d+A')

    def test_bars_stay_within_a_small_terminal(self):
        """What is broken in two, or has gone at the top, is not overwritten by the next picture."""
        self.write('a.rec', recording(0.2))
        text = self.watch_on_a_terminal(6, 50)
        self.assertRegex(text, r'turn  x\[     \|##   \]  \+1\.75 y\[')
        self.assertLess(self.widest(text), 50)
        self.assertEqual(max(int(up) for up in re.findall(r'\x1b\[(\d+)A', text)), 5)

    def test_a_replay_is_recorded(self):
        self.write('a.rec', recording())
        self.run_devices('--watch', '--quiet', '--device', 'file:a.rec', '--record', 'b.rec')

        def reports(name):
            return [line.split()[1:] for line in self.read(name).decode().splitlines() if ' report ' in line]
        self.assertEqual(reports('a.rec'), reports('b.rec'))

    def test_a_recording_is_never_written_over(self):
        """Above all not the one that is being played."""
        self.write('a.rec', recording())
        before = self.read('a.rec')
        for name in ['a.rec', './a.rec']:
            done = self.run_devices('--device', 'file:a.rec', '--record', name, code=1)
            self.assertEqual(done.stderr, f'{name}: is there already, and stays as it is; name a new file\n')
        self.assertEqual(self.read('a.rec'), before)
        self.assertEqual(self.entries(), ['a.rec'])

    def wait_for_reports(self, name, process):
        self.wait_for(lambda: os.path.exists(self.path(name)) and self.read(name).count(b' report ') > 5, process)

    def test_ctrl_c_and_kill_leave_a_readable_recording(self):
        self.write('a.rec', recording(20))
        for number, code in [(signal.SIGINT, 130), (signal.SIGKILL, -signal.SIGKILL)]:
            process = self.start('devices', '--record', 'b.rec', '--device', 'file:a.rec')
            self.wait_for_reports('b.rec', process)
            process.send_signal(number)
            self.assertEqual(process.wait(30), code)
            self.assertRegex(self.run_devices('--device', 'file:b.rec').stdout, r'1 DualSense .*: \d+ reports?')
            os.remove(self.path('b.rec'))

    def test_ctrl_c_ends_the_watch_of_what_is_plugged_in(self):
        process = self.start('devices', '--record', 'b.rec')
        self.wait_for(lambda: os.path.exists(self.path('b.rec')), process)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(30), 0)
        self.assertEqual(self.read('b.rec').decode().splitlines()[0], 'slosh device recording 1')

    def test_a_full_disk_is_told(self):
        self.write('a.rec', recording(20))
        done = self.run_devices('--record', 'b.rec', '--device', 'file:a.rec', code=1, before=limit_files(1000))
        self.assertIn('b.rec: cannot be written (File too large); what came before is whole', done.stderr)
        self.run_devices('--device', 'file:b.rec')

    def test_what_is_no_recording_is_refused_before_anything(self):
        self.write('text', 'hello\n')
        self.write('bad.rec', HEAD + '0 1 plugged dualsense 054c:0ce6 usb\n1 1 report 0\n')
        for source, words in [('file:none.rec', 'none.rec: cannot be opened (No such file or directory)'),
                              ('file:.', '.: a directory; name a recording in it'),
                              ('file:text', 'text:1: this is no recording of devices; the first line of one is'),
                              ('file:bad.rec', 'bad.rec:4: a report must stand here'),
                              ('none.rec', "slosh devices: --device must be file:PATH, with the path of a recording, not 'none.rec'")]:
            for more in [[], ['--watch'], ['--record', 'b.rec', '--json', 'b.json']]:
                done = self.run_devices('--device', source, *more, code=2)
                self.assertEqual(done.stdout, '')
                self.assertTrue(done.stderr.startswith(words), done.stderr)
                self.assertEqual(self.entries(), ['bad.rec', 'text'])

    def test_a_closed_pipe_ends_it(self):
        self.write('a.rec', HEAD + '0 1 plugged dualsense 054c:0ce6 usb\n' +
                   ''.join(f'{i / 100:.6f} 1 report {sense(i % 999)}\n' for i in range(6000)))
        process = subprocess.Popen([command.PROGRAM, 'devices', '--watch', '--device', 'file:a.rec'], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.readline()
        process.stdout.close()
        process.stdout = None
        _, said = process.communicate(timeout=command.PATIENCE)
        self.assertEqual((process.returncode, said), (1, b'slosh: standard output: Broken pipe\n'))


class PluggedIn(Case):
    """With a stand-in for hidapi (hidapi_stand_in.c) in the program."""

    def setUp(self):
        super().setUp()
        module = os.path.join(os.path.dirname(command.PROGRAM), 'tests', 'hidapi_stand_in.so')
        self.assertTrue(os.path.exists(module))
        os.symlink(module, self.path('hidapi.so'))  # LD_PRELOAD ends a path at a blank
        os.environ.update(LD_PRELOAD=self.path('hidapi.so'), SLOSH_TEST_HID=self.path('plugged'))
        self.addCleanup(os.environ.pop, 'LD_PRELOAD')
        self.addCleanup(os.environ.pop, 'SLOSH_TEST_HID')

    def plug(self, *lines):
        """What is plugged in from now on."""
        self.write('new', ''.join(line + '\n' for line in lines))
        os.replace(self.path('new'), self.path('plugged'))

    def test_lists_what_may_be_opened_and_what_not(self):
        self.plug(f'054c 0ce6 usb /dev/stand-in0 ready {sense()}', '046d c626 usb /dev/stand-in1 denied 00',
                  '054c 09cc bluetooth /dev/stand-in2 busy 00', '054c 05c4 usb /dev/stand-in3 broken 00',
                  '256f c650 usb /dev/stand-in4 ready 00')
        out = self.run_devices('--json', 'a.json').stdout
        lines = out.splitlines()
        self.assertEqual(len(lines), 4, out)
        self.assertEqual(lines[0], 'DualSense (054c:0ce6, USB, /dev/stand-in0): ready')
        self.assertRegex(lines[1], r'^SpaceNavigator \(046d:c626, USB, /dev/stand-in1\): this user may not open it; '
                                   r'`.*/tools/setup\'? --devices` allows it for good$')
        self.assertEqual(lines[2], 'DualShock 4 (second model) (054c:09cc, Bluetooth, /dev/stand-in2): another program holds it; '
                                   'end that program')
        self.assertIn('it cannot be opened (the stand-in does not open it); unplug it and plug it in again', lines[3])
        devices = json.loads(self.read('a.json'))['devices']
        self.assertEqual([(d['bus'], d['problem'] is None) for d in devices],
                         [('usb', True), ('usb', False), ('bluetooth', False), ('usb', False)])
        script = shlex.split(lines[1].split('`')[1])[0]
        self.assertTrue(os.access(script, os.X_OK))

    def test_watch_notices_what_comes_and_goes(self):
        self.plug('046d c626 usb /dev/stand-in1 denied 00')
        with open(self.path('out'), 'w') as out:
            process = subprocess.Popen([command.PROGRAM, 'devices', '--watch', '--record', 'a.rec'], cwd=self.folder, stdout=out,
                                       stderr=subprocess.DEVNULL, preexec_fn=obey_interrupts)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)

        def said(words):
            return lambda: words.encode() in self.read('out')
        self.wait_for(said('1 SpaceNavigator (046d:c626): this user may not open it'), process)
        self.plug(f'054c 0ce6 usb /dev/stand-in0 ready {sense(100, 0x28)}', f'046d c626 usb /dev/stand-in1 ready {cap(350, 0, 0)}')
        self.wait_for(said('1 SpaceNavigator: move +1.00 +0.00 +0.00'), process)
        self.wait_for(said('2 DualSense: turn +1.75 +0.00 +0.00 rad/s'), process)
        self.plug(f'046d c626 usb /dev/stand-in1 ready {cap(0, 0, 350)}')
        self.wait_for(said('2 DualSense: unplugged after'), process)
        self.wait_for(said('1 SpaceNavigator: move +0.00 -1.00 +0.00'), process)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(30), 0)
        recorded = self.run_devices('--device', 'file:a.rec').stdout
        for name in ['SpaceNavigator', 'DualSense']:
            self.assertRegex(recorded, name + r' \(.*\): \d+ reports?\n')


# Still but for the device; a box that answers at once, and that one looks at from the front.
STILL = """\
box: {size: [1, 1, 1]}
particles: {spacing: 0.1}
fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}]
solver: {sound_speed: 12, step: {dt: 0.01, substeps: 3}}
hand: {response: 0.02}
view: {camera: {from: [0, 0.5, 4], to: [0, 0.5, 0]}}
"""


class Simulated(Case):
    """A recording in the place of a hand, in simulated time."""

    def setUp(self):
        super().setUp()
        os.environ['XDG_CONFIG_HOME'] = self.folder  # no mapping of the user's own
        self.addCleanup(os.environ.pop, 'XDG_CONFIG_HOME')
        self.write('still.yaml', STILL)
        self.tilt = test_motion.Recording()
        self.tilt.still(0.1)
        self.tilt.turn(0, 20)
        self.tilt.turn(2, -30)
        self.write('tilt.rec', test_motion.text(self.tilt))

    def go(self, command_name, *arguments, code=0, device=('--device', 'file:tilt.rec')):
        done, said = self.slosh(command_name, 'still.yaml', *device, *arguments)
        self.assertEqual(done, code, said)
        return said

    def poses(self, name):
        with h5py.File(self.path(name)) as file:
            return [list(file[f'Step#{i}'].attrs['box_orientation']) for i in range(len(file))]

    def test_the_box_turns_as_it_was_recorded(self):
        self.go('run', '-o', 'a.h5part', '--time', '1.5', '--every', '0.1')
        poses = self.poses('a.h5part')
        for at, pose in [(0, (0, 0, 0, 1)), (-1, self.tilt.pose)]:  # and stays when it is unplugged
            self.assertLess(test_motion.between(poses[at], pose), 1, poses[at])
        self.assertGreater(test_motion.between(poses[4], poses[0]), 10)
        self.write('no.yaml', 'dualsense: {pose: {to: nothing}}\n')
        self.go('run', '-o', 'b.h5part', '--time', '1', '--mapping', 'no.yaml')
        self.assertEqual(test_motion.between(self.poses('b.h5part')[-1], (0, 0, 0, 1)), 0)

    def test_a_run_gives_the_same_bits_again(self):
        self.go('run', '-o', 'a.h5part', '--time', '0.6', '--threads', '1')
        self.go('run', '-o', 'b.h5part', '--time', '0.6', '--threads', '2')
        self.assertEqual(self.bits('a.h5part'), self.bits('b.h5part'))
        self.go('run', '-o', 'c.h5part', '--time', '0.3')
        self.go('run', '-o', 'c.h5part', '--time', '0.6', '--resume')
        self.assertEqual(self.bits('a.h5part'), self.bits('c.h5part'))
        plain = ('run', '-o', 'd.h5part', '--time', '0.6')
        self.go(*plain, device=())
        self.assertNotEqual(self.bits('a.h5part'), self.bits('d.h5part'))

    def bits(self, name):
        with h5py.File(self.path(name)) as file:
            steps = [file[f'Step#{i}'] for i in range(len(file))]
            self.assertGreater(len(steps), 10)
            return [[step.attrs['box_orientation'].tobytes()] + [step[key][:].tobytes() for key in ('id', 'x', 'y', 'velocity_1')]
                    for step in steps]

    def test_a_run_is_resumed_with_the_same_hand(self):
        self.go('run', '-o', 'a.h5part', '--time', '0.1')
        self.go('run', '-o', 'b.h5part', '--time', '0.1', device=())
        before = self.read('a.h5part')
        again = ('--time', '0.2', '--resume')
        self.assertIn('a.h5part: --device moved its box; resume with the same one',
                      self.go('run', '-o', 'a.h5part', *again, device=(), code=2))
        self.assertIn('b.h5part: no --device moved its box; resume without one', self.go('run', '-o', 'b.h5part', *again, code=2))
        self.write('gain.yaml', 'dualsense: {gain: 1.5}\n')
        for other in [('--mapping', 'gain.yaml'), ('--set', 'view.camera.from=[4, 0.5, 0]')]:
            self.assertIn('a.h5part: another recording, mapping or camera moved its box',
                          self.go('run', '-o', 'a.h5part', *again, *other, code=2))
        self.assertEqual(self.read('a.h5part'), before)

    def test_a_film_of_it(self):
        film = ('--time', '0.6', '--fps', '5', '--size', '96x64', '--quiet')
        for name in 'a', 'b':
            self.go('render', '-o', name, *film)
        self.go('render', '-o', 'c', *film, device=())
        frames = [f'frame_{i:05d}.png' for i in range(3)]
        for frame in frames:
            self.assertEqual(self.read(f'a/{frame}'), self.read(f'b/{frame}'))
        self.assertEqual([self.read(f'a/{frame}') == self.read(f'c/{frame}') for frame in frames], [True, False, False])

    def test_bench_moves_the_box(self):
        self.go('bench', '--view', 'none', '--frames', '3', '--json', 'a.json')
        self.assertEqual(json.loads(self.read('a.json'))[0]['frames'], 3)

    def test_what_is_wrong_is_refused_before_anything(self):
        self.write('bad.yaml', 'dualsense: {q: 1}\n')
        files = self.entries()
        for arguments, words in [(['--device', 'file:none.rec'], 'none.rec: cannot be opened (No such file or directory)'),
                                 (['--device', 'file:still.yaml'], 'still.yaml:1: this is no recording of devices'),
                                 (['--device', 'file:tilt.rec', '--mapping', 'bad.yaml'], 'bad.yaml:1:'),
                                 (['--mapping', 'bad.yaml'], '--mapping says what motion devices do; add --device file:PATH')]:
            for name, *more in [('render', '-o', 'a.png'), ('render', '-o', 'film'), ('run', '-o', 'a.h5part'),
                                ('bench', '--json', 'a.json')]:
                self.assertIn(words, self.go(name, *more, device=arguments, code=2))
                self.assertEqual(self.entries(), files)
        for name, *more in [('validate',), ('chart', '-o', 'a.svg'), ('replay',), ('export', '-o', 'a.vtp'), ('info',)]:
            self.assertIn(f'slosh {name}: --device is refused: ', self.go(name, *more, code=2))
        self.assertIn('with --play a script shakes the box', self.go('bench', '--play', code=2))
        self.assertEqual(self.entries(), files)


if __name__ == '__main__':
    command.main('Devices', 'PluggedIn', 'Simulated')
