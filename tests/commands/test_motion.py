"""Motion devices in the window: recorded reports turn and move the box on the screen."""
import math
import re
import struct

import command
from test_window import Window

HEADER = 'slosh device recording 1\n'
RATE = 250  # reports a second
GYRO, ACCELEROMETER = 16, 8192  # per degree/s, per g


def dualsense(rates, felt, sticks=(128, 128, 128, 128), buttons=(8, 0, 0), triggers=(0, 0)):
    """A report over USB: degrees a second and g about and along x, y, z."""
    report = bytearray(64)
    report[0] = 1
    report[1:5] = bytes(sticks)
    report[5:7] = bytes(triggers)
    report[8:11] = bytes(buttons)
    struct.pack_into('<3h', report, 16, *(round(rate * GYRO) for rate in rates))
    struct.pack_into('<3h', report, 22, *(round(g * ACCELEROMETER) for g in felt))
    return report.hex()


def product(a, b):
    """Of quaternions x y z w."""
    (ax, ay, az, aw), (bx, by, bz, bw) = a, b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def turn_about(axis, degrees):
    half = math.radians(degrees) / 2
    return tuple(math.sin(half) if k == axis else 0 for k in range(3)) + (math.cos(half),)


class Recording:
    """What a device reports that is turned about its own axes, from level."""
    def __init__(self, number=1, family='dualsense', ids='054c:0ce6'):
        self.time = 0
        self.pose = (0, 0, 0, 1)
        self.number = number
        self.lines = [(0, f'0.000000 {number} plugged {family} {ids} usb test\n')]

    def line(self, what):
        self.lines.append((self.time, f'{self.time:.6f} {self.number} {what}\n'))

    def report(self, axis=0, rate=0, **more):
        """One more, `rate` degrees a second about x, y or z."""
        self.time += 1 / RATE
        self.pose = product(self.pose, turn_about(axis, rate / RATE))
        x, y, z, w = self.pose
        up = (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w))  # in its own frame
        self.line('report ' + dualsense([rate if k == axis else 0 for k in range(3)], up, **more))

    def still(self, seconds, **more):
        for _ in range(round(seconds * RATE)):
            self.report(**more)

    def turn(self, axis, angle, seconds=0.3):
        for _ in range(round(seconds * RATE)):
            self.report(axis, angle / seconds)

    def unplugged(self):
        self.line('unplugged')


def text(*recordings):
    return HEADER + ''.join(line for _, line in sorted(sum((r.lines for r in recordings), []), key=lambda line: line[0]))


def between(a, b):
    """Degrees from one pose to the other."""
    return 2 * math.degrees(math.acos(min(abs(sum(x * y for x, y in zip(a, b))), 1)))


class Motion(Window):
    def begin(self, *recordings, arguments=()):
        self.write('motion.txt', text(*recordings))
        self.open('still.yaml', '--device', 'file:motion.txt', '--set', 'view.camera={from: [0, 1, 4], to: [0, 0.5, 0]}',
                  *arguments)

    def play(self, *recordings, arguments=()):
        """The window with the recordings until all reports have been taken."""
        self.begin(*recordings, arguments=arguments)
        self.take_all(*recordings)

    def take_all(self, *recordings):
        """Not one report may be lost."""
        reports = sum(' report ' in line for recording in recordings for _, line in recording.lines)
        self.until(lambda now: now['device_reports'] >= reports)
        self.assertEqual(self.figures()['device_reports'], reports)

    def turns(self, pose, within=1):
        """Until the box has come there: so many degrees off at most."""
        self.until(lambda now: between(now['box_orientation'], pose) < within)

    def test_the_box_turns_by_the_angle_recorded(self):
        recording = Recording()
        recording.still(0.6)
        for axis, angle in ((0, 25), (1, -40), (2, -30)):
            recording.turn(axis, angle)
        recording.still(0.3)
        self.play(recording)
        self.turns(recording.pose)
        self.runs(0.2)  # and stays
        out = self.quit()
        self.assertLess(between(out['box_orientation'], recording.pose), 1, out['box_orientation'])

    def test_unplugged_the_box_stays(self):
        recording = Recording()
        recording.still(0.6)
        recording.turn(2, -30)
        recording.unplugged()
        self.play(recording)
        self.wait_said('DualSense is gone')
        self.turns(recording.pose)
        self.runs(0.2)
        out = self.quit()
        self.assertLess(between(out['box_orientation'], recording.pose), 1)
        self.assertRegex(self.messages, r'DualSense is in your hand[^\0]*DualSense is gone; the box stays where it is')

    def test_a_stick_and_a_trigger_touch_the_fluid(self):
        """The camera stays; the stroke is recorded, and done again. Where it came before the finger was there, again with more
        time before it."""
        self.write('no.yaml', 'dualsense: {pose: {to: nothing}}\n')
        for before in 1, 4, 16, 64:
            recording = Recording()
            recording.still(before)
            recording.still(0.7, triggers=(0, 255), sticks=(128, 128, 200, 128))
            recording.still(0.3)
            recording.still(0.3, triggers=(255, 0))
            recording.still(0.3)
            self.begin(recording, arguments=['--mapping', 'no.yaml', '--record', 'a.recording'])
            self.at(200, 180)
            self.key('t')
            self.wait_said('touch: ')
            if self.figures()['device_reports'] < before * RATE:
                break
            self.quit()
        self.take_all(recording)
        self.drawn()
        self.keys('Escape')
        out = self.quit()
        self.assertEqual(out['camera_from'], [0, 1, 4])
        touches = re.findall(r'^\d+ touch (\w+)(.*)$', self.read('a.recording').decode(), re.M)
        ways = [way for way, _ in touches]
        self.assertEqual([way for k, way in enumerate(ways) if k == 0 or way != ways[k - 1]], ['stir', 'none', 'pull', 'none'])
        places = [float.fromhex(rest.split()[0]) for way, rest in touches if way == 'stir']
        self.assertGreater(places[-1] - places[0], 0.1)
        self.assertEqual(self.slosh('replay', 'a.recording', '--quiet', '--threads', '1'), (0, ''))

    def test_two_devices(self):
        pad, cap = Recording(), Recording(2, 'spacemouse', '046d:c626')
        pad.still(0.3)
        pad.turn(0, 20)
        pad.still(1.3)
        cap.time = 0.5
        for _ in range(60):  # most of its way to the right, for a second
            cap.time += 1 / 60
            cap.line('report 01' + struct.pack('<3h', 300, 0, 0).hex())
            cap.line('report 02' + struct.pack('<3h', 0, 0, 0).hex())
        cap.line('report 01' + bytes(6).hex())
        self.play(pad, cap)
        self.turns(pad.pose)
        self.until(lambda now: now['box_position'][0] > 0.1)
        out = self.quit()
        self.assertLess(between(out['box_orientation'], pad.pose), 1)
        self.assertRegex(self.messages, 'SpaceNavigator is in your hand')

    def test_buttons_sticks_and_the_neutral_pose(self):
        recording = Recording()
        recording.still(0.3)
        recording.still(0.6, sticks=(128, 128, 255, 128))  # the scene goes to the right
        recording.still(0.1, buttons=(0x88, 0, 0))  # triangle: neutral
        recording.turn(1, 30)
        recording.still(0.5)
        recording.still(0.1, buttons=(8, 0x20, 0))  # options: pause
        recording.still(0.1)
        self.play(recording)
        self.rest()
        out = self.quit()
        self.assertLess(out['camera_from'][0], -1)
        self.assertEqual((out['camera_auto'], out['paused']), (False, True))
        self.assertEqual(out['box_position'], [0, 0, 0])

    def test_nothing_is_lost_before_the_first_picture(self):
        """A push that begins with the recording, when there is no box yet."""
        cap = Recording(1, 'spacemouse', '046d:c626')
        for push in [350] * 18 + [0]:
            cap.line('report 01' + struct.pack('<3h', push, 0, 0).hex())
            cap.time += 1 / 60
        cap.time += 1
        cap.unplugged()
        self.play(cap)
        self.until(lambda now: now['box_position'][0] > 0.2)  # 0.3 s at 1 m/s
        self.quit()

    def test_a_mapping_of_ones_own_and_the_neutral_key(self):
        self.write('own.yaml', 'dualsense: {pose: {gain: 2}}\n')
        recording = Recording()
        recording.still(0.3)
        recording.turn(2, 15)
        recording.still(60)  # longer than the test
        self.begin(recording, arguments=['--mapping', 'own.yaml', '--record', 'a.rec'])
        self.turns(turn_about(2, 30), 1.5)
        self.keys('l')
        self.turns((0, 0, 0, 1))
        self.quit()
        turned = [[float.fromhex(x) for x in line.split()[5:]] for line in self.read('a.rec').decode().split('\n')
                  if ' target ' in line]
        self.assertLess(min(between(pose, turn_about(2, 30)) for pose in turned), 1.5)  # so sent, not only reached
        self.assertEqual(self.slosh('replay', 'a.rec', '--quiet'), (0, ''))

    def test_what_is_wrong_is_refused_before_the_window(self):
        self.write('bad.yaml', 'dualsense:\n  gian: 2\n')
        self.write('no.txt', 'no recording\n')
        for arguments, message in ((['--device', 'file:none.txt'], 'none.txt'),
                                   (['--device', 'file:no.txt'], 'no.txt'),
                                   (['--mapping', 'none.yaml'], 'none.yaml: cannot be opened'),
                                   (['--mapping', 'bad.yaml'], "bad.yaml:2:3: unknown key 'gian'; did you mean 'gain'?")):
            code, said = self.slosh('still.yaml', *arguments)
            self.assertEqual(code, 2, said)
            self.assertIn(message, said)


class Mapping(command.CommandTest):
    def test_written_checked_and_explained(self):
        self.assertEqual(self.slosh('devices', '--write-mapping', 'my.yaml'), (0, ''))
        self.assertEqual(self.slosh('devices', '--mapping', 'my.yaml'), (0, ''))
        written = self.read('my.yaml').decode()
        code, said = self.slosh('devices', '--write-mapping', 'my.yaml')
        self.assertEqual(code, 1)
        self.assertIn('stays as it is', said)
        for more in [['--watch'], ['--record', 'a.rec'], ['--json', 'a.json']]:
            code, said = self.slosh('devices', '--mapping', 'my.yaml', *more)
            self.assertEqual(code, 2)
            self.assertIn('look at no device; leave --watch, --record, --device and --json out', said)
        self.write('my.yaml', written.replace('dead_zone', 'deadzone'))
        code, said = self.slosh('devices', '--mapping', 'my.yaml')
        self.assertEqual(code, 2)
        self.assertRegex(said, r"my\.yaml:\d+:3: unknown key 'deadzone'; did you mean 'dead_zone'\?")


if __name__ == '__main__':
    command.main('Motion.test_the_box_turns_by_the_angle_recorded Motion.test_two_devices Mapping',
                 'Motion.test_unplugged_the_box_stays Motion.test_buttons_sticks_and_the_neutral_pose '
                 'Motion.test_nothing_is_lost_before_the_first_picture '
                 'Motion.test_a_mapping_of_ones_own_and_the_neutral_key Motion.test_a_stick_and_a_trigger_touch_the_fluid '
                 'Motion.test_what_is_wrong_is_refused_before_the_window')
