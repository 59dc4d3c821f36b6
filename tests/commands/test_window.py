"""The window under a virtual display, driven by real key and mouse events."""
import contextlib
import glob
import json
import os
import re
import select
import shutil
import signal
import struct
import subprocess
import tempfile
import time

import Xlib.display
from Xlib import X, XK, Xatom
from Xlib.protocol import event

import command
from command import CommandTest, obey_interrupts, video_frames

WIDTH, HEIGHT = 480, 360
FLUID_COLORS = 400  # text alone has fewer

# GLFW unloads it before leaks are counted, and what it kept for its own end would be counted among them.
DRIVER = '/usr/lib/x86_64-linux-gnu/dri/swrast_dri.so'

MODIFIERS = {'shift': 'Shift_L', 'ctrl': 'Control_L'}

# GLFW takes two presses of a key within one millisecond of the server's clock for one, and the input method's copy of it.
KEY_APART = 0.002

# At rest, and gentle: nothing moves but what a hand moves.
STILL = """\
title: A still tank
box: {size: [1, 1, 1]}
particles: {spacing: 0.1}
fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}]
solver: {sound_speed: 15, step: {dt: 0.01, substeps: 5}}
"""


def png_size(data):
    return struct.unpack('>II', data[16:24])


class Display:
    """An Xvfb of its own, without a window manager."""
    def __init__(self):
        read, write = os.pipe()
        self.process = subprocess.Popen(['Xvfb', '-displayfd', str(write), '-screen', '0', '800x600x24', '-nolisten', 'tcp'],
                                        pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            self.name = ':' + answer.readline().strip()
        self.connection = Xlib.display.Display(self.name)
        self.root = self.connection.screen().root
        self.root.change_attributes(event_mask=X.SubstructureNotifyMask)
        self.pings = 0
        self.pressed = 0

    def tell(self, window, protocol, value):
        """As a window manager does."""
        kind, name = (self.connection.intern_atom(word) for word in ('WM_PROTOCOLS', protocol))
        message = event.ClientMessage(window=window, client_type=kind, data=(32, [name, value, window, 0, 0]))
        self.connection.create_resource_object('window', window).send_event(message)
        self.connection.sync()

    def press_close_button(self, window):
        self.tell(window, 'WM_DELETE_WINDOW', X.CurrentTime)

    def picture(self, window):
        """Its pixels, as far as they lie on the screen."""
        drawn = self.connection.create_resource_object('window', window)
        size = drawn.get_geometry()
        return drawn.get_image(0, 0, min(size.width, WIDTH), min(size.height, HEIGHT), X.ZPixmap, 0xffffffff).data

    def colors(self, window):
        return len(set(memoryview(self.picture(window)).cast('I')))

    def ping(self, window):
        """The window answers when it has taken all events that were sent before, between two pictures."""
        self.pings += 1
        self.tell(window, '_NET_WM_PING', self.pings)

    def answered(self, seconds=0.2):
        """Whether the last ping is, within that time."""
        while self.connection.pending_events() or select.select([self.connection], [], [], seconds)[0]:
            answer = self.connection.next_event()
            if answer.type & 127 == X.ClientMessage and answer.data[1][1] == self.pings:
                return True
        return False

    def codes(self, key):
        """The codes of a key such as `ctrl+s` or `plus` with those held before it, by the layout of this moment."""
        while self.connection.pending_events():
            change = self.connection.next_event()
            if change.type == X.MappingNotify:
                self.connection.refresh_keyboard_mapping(change)
        *held, name = key.split('+')
        symbol = XK.string_to_keysym(MODIFIERS.get(name, name))
        code, column = min(self.connection.keysym_to_keycodes(symbol), key=lambda pair: pair[1])
        held = [MODIFIERS[word] for word in held] + ['Shift_L'] * (column == 1 and 'shift' not in held)
        return [self.connection.keysym_to_keycode(XK.string_to_keysym(word)) for word in held] + [code]

    def fake(self, kind, codes):
        for code in codes:
            self.connection.xtest_fake_input(kind, code)
        self.connection.sync()

    def press(self, key):
        time.sleep(max(self.pressed + KEY_APART - time.monotonic(), 0))
        self.fake(X.KeyPress, self.codes(key))
        self.pressed = time.monotonic()

    def release(self, key):
        self.fake(X.KeyRelease, self.codes(key)[::-1])

    def opened(self, seconds):
        """The next window of the program that is shown within that time, or None."""
        while self.connection.pending_events() or select.select([self.connection], [], [], seconds)[0]:
            shown = self.connection.next_event()
            if shown.type == X.MapNotify and 'slosh' in (shown.window.get_wm_class() or ()):
                return shown.window.id
        return None

    def close(self):
        self.connection.close()
        self.process.terminate()
        self.process.wait()


class Window(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.display = Display()

    @classmethod
    def tearDownClass(cls):
        cls.display.close()

    def setUp(self):
        super().setUp()
        self.write('still.yaml', STILL)
        self.environment = dict(os.environ, DISPLAY=self.display.name)
        if 'LSAN_OPTIONS' in os.environ and os.path.exists(DRIVER):
            self.environment['LD_PRELOAD'] = DRIVER

    def xdo(self, *arguments):
        return subprocess.run(['xdotool', *map(str, arguments)], env=self.environment, capture_output=True, text=True,
                              check=True, timeout=command.PATIENCE).stdout

    def open(self, *arguments, size=(WIDTH, HEIGHT)):
        """Starts the window and waits until it shows its fluid."""
        self.start(*arguments, size=size)
        self.filled()

    def filled(self):
        """Until it shows a fluid, and has taken what was done to it."""
        self.wait_for(lambda: self.display.colors(self.window) >= FLUID_COLORS, self.process)
        self.drawn()

    def opened(self, scenes):
        """The same, when so many scenes have been opened."""
        self.until(lambda now: now['scenes_opened'] == scenes)
        self.filled()

    def start(self, *arguments, size=(WIDTH, HEIGHT)):
        """Starts the window and waits until it takes events."""
        self.said = open(self.path('said.txt'), 'w+')
        self.addCleanup(self.said.close)
        self.process = subprocess.Popen([command.PROGRAM, *arguments, '--size', f'{size[0]}x{size[1]}', '--json', 'out.json'],
                                        cwd=self.folder, env=self.environment, stderr=self.said, stdout=self.said,
                                        preexec_fn=obey_interrupts)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)
        self.window = None

        def found():
            self.window = self.display.opened(0.2)
            return self.window is not None
        self.wait_for(found, self.process)
        self.focus()

    def shown(self, seconds=0):
        """Until it has taken what was done to it."""
        self.display.ping(self.window)
        self.wait_for(self.display.answered, self.process)
        time.sleep(seconds)

    def figures(self):
        """Those of the session so far, when the window has taken what was done to it."""
        self.shown()
        if os.path.exists(self.path('out.json')):
            os.remove(self.path('out.json'))
        self.process.send_signal(signal.SIGUSR1)
        self.display.ping(self.window)  # wakes it
        self.wait_for(lambda: os.path.exists(self.path('out.json')), self.process)
        return json.loads(self.read('out.json'))

    def until(self, condition):
        """The figures, as soon as the condition holds for them."""
        found = []

        def holds():
            found[:] = [self.figures()]
            return condition(found[0])
        self.wait_for(holds, self.process)
        return found[0]

    def rest(self):
        """Until all that was asked for is done and shown: where time stands, or the simulation."""
        return self.until(lambda now: now['at_rest'])

    def runs(self, seconds):
        """Until so much more is simulated."""
        begun = self.figures()['simulated_seconds']
        return self.until(lambda now: now['simulated_seconds'] >= begun + seconds)

    def drawn(self, pictures=2):
        """Until it has taken what was done to it, and shows what came of it: nothing more comes; or the solver has taken what
        waited between two steps, and so many pictures have been drawn, since values come with the second."""
        before = self.figures()
        return self.until(lambda now: now['at_rest'] or (now['pictures'] >= before['pictures'] + pictures and
                                                         now['steps'] - before['steps'] not in (0, 1)))

    def settled(self):
        """The picture, where time stands, when no finer one will come."""
        self.until(lambda now: now['at_rest'] and not now['finer_to_come'])
        return self.display.picture(self.window)

    def said_now(self):
        with open(self.path('said.txt')) as said:
            return said.read()

    def wait_said(self, words, times=1):
        self.wait_for(lambda: self.said_now().count(words) >= times, self.process)

    def focus(self):
        self.display.connection.create_resource_object('window', self.window).set_input_focus(X.RevertToParent, X.CurrentTime)
        self.shown()

    def key(self, key):
        """Pressed and let go; `drawn` waits for what it does."""
        self.display.press(key)
        self.display.release(key)

    def keys(self, *keys):
        for key in keys:
            self.key(key)
            self.drawn()

    def at(self, x, y):
        self.display.connection.create_resource_object('window', self.window).warp_pointer(x, y)
        self.drawn()

    def drag(self, button, points, modifier=None):
        self.at(*points[0])
        if modifier:
            self.display.press(modifier)
        self.display.fake(X.ButtonPress, [button])
        for point in points[1:]:
            self.at(*point)
        self.display.fake(X.ButtonRelease, [button])
        if modifier:
            self.display.release(modifier)
        self.drawn()

    def end(self):
        """Waits for the end, which must be a good one; the session's figures."""
        code = self.process.wait(timeout=command.PATIENCE)
        self.said.seek(0)
        self.messages = self.said.read()
        self.assertEqual(code, 0, self.messages)
        figures = json.loads(self.read('out.json'))
        self.assertEqual(figures['gl_errors'], 0, self.messages)
        return figures

    def quit(self):
        """Once more where it asks, because what was done is not saved."""
        if os.path.exists(self.path('out.json')):
            os.remove(self.path('out.json'))
        asked = self.said_now().count('Ctrl+Q once more')
        self.key('ctrl+q')
        end = time.monotonic() + command.PATIENCE
        while self.process.poll() is None and self.said_now().count('Ctrl+Q once more') == asked and time.monotonic() < end:
            time.sleep(0.01)
        if self.process.poll() is None:
            self.key('ctrl+q')
        return self.end()

    def files(self, extension):
        return [name for name in self.entries() if re.fullmatch(r'slosh-\d{8}-\d{6}(-\d)?\.' + extension, name)]


class Keys(Window):
    def test_nothing_pressed(self):
        self.open('still.yaml')
        self.until(lambda now: now['pictures'] > 5 and now['simulated_seconds'] > 0.3)
        out = self.quit()
        self.assertEqual((out['paused'], out['speed'], out['camera_auto'], out['color_by'], out['help']),
                         (False, 1, True, 'speed', False))
        self.assertEqual(out['size'], [WIDTH, HEIGHT])
        self.assertEqual(out['box_position'], [0, 0, 0])
        self.assertGreater(out['first_picture_ms'], 0)

    def test_time(self):
        self.open('still.yaml')
        self.keys('space')
        stands = self.rest()
        self.assertTrue(stands['paused'])
        self.keys('space')
        self.until(lambda now: now['steps'] > stands['steps'])
        self.keys('equal', 'plus', 'minus', 'space')
        self.xdo('key', 'r', 'period', 'n', 'period')  # back at the start, and paused
        self.rest()
        out = self.quit()
        self.assertEqual((out['paused'], out['speed']), (True, 2))
        self.assertEqual(out['steps'], 15)  # three frames of five substeps
        self.assertAlmostEqual(out['time'], 0.03)

    def test_looks(self):
        self.open('still.yaml')
        self.keys('s', 'c', 'c', 'p', 'h')
        self.keys('Escape')  # closes the help
        self.assertIsNone(self.process.poll())
        self.keys('F1')
        self.keys('F1', 'F2')
        out = self.quit()
        self.assertEqual((out['color_by'], out['colormap']), ('density', 'plasma'))
        self.assertEqual((out['help'], out['panel']), (False, False))

    def test_what_no_world_keeps_by_itself(self):
        """Accelerations are kept from when they are shown; what other methods keep is left out."""
        self.open('still.yaml', '--set', 'view.color_by=acceleration_x')
        self.until(lambda now: now['steps'] > 0)
        self.keys('s', 's', 's', 's', 's')  # those that one plays with, round and round
        out = self.quit()
        self.assertEqual(re.findall('coloured by (.*)', self.messages), ['speed', 'density', 'pressure', 'vorticity', 'fluid'])
        self.assertEqual(out['color_by'], 'fluid')

    def test_files(self):
        self.open('still.yaml')
        self.keys('F12')
        self.keys('v')
        self.until(lambda now: now['video_pictures'] > 20)
        self.keys('v', 'ctrl+s', 'i')
        self.wait_for(lambda: len(self.files('png')) == 2 and self.files('recording'), self.process)
        out = self.quit()
        pictures, videos, recordings = self.files('png'), self.files('mp4'), self.files('recording')
        self.assertEqual([len(pictures), len(videos), len(recordings)], [2, 1, 1], self.messages)
        self.assertEqual(png_size(self.read(pictures[0])), (WIDTH, HEIGHT))
        self.assertGreater(len(set(self.read(pictures[0]))), 200)  # not one colour
        self.assertEqual(video_frames(self.path(videos[0])), out['video_pictures'])
        for name in pictures + videos + recordings:
            self.assertIn(name, self.messages)
        self.assertEqual(self.slosh('replay', recordings[0], '--quiet'), (0, ''))

    def test_a_pause_is_in_the_video(self):
        self.open('still.yaml')
        self.keys('space')
        self.rest()
        self.keys('v')
        self.until(lambda now: now['video_pictures'] > 25)
        self.keys('v')
        out = self.quit()
        name, = self.files('mp4')
        self.assertEqual(video_frames(self.path(name)), out['video_pictures'])

    def test_a_video_is_whole_when_the_window_is_closed(self):
        self.open('still.yaml')
        self.keys('F9')
        self.until(lambda now: now['video_pictures'] > 10)
        out = self.quit()
        self.assertEqual(video_frames(self.path(self.files('mp4')[0])), out['video_pictures'])

    def raise_children(self):
        """What the program makes at the lowest priority never comes on a machine with other work."""
        with open(f'/proc/{self.process.pid}/task/{self.process.pid}/children') as file:
            for child in file.read().split():
                with contextlib.suppress(PermissionError, ProcessLookupError):
                    os.setpriority(os.PRIO_PROCESS, int(child), 0)

    def test_list_of_scenes(self):
        """A card opens its scene; pictures come from the user's cache, which another process fills."""
        cache = tempfile.mkdtemp(prefix='slosh-test-')
        self.addCleanup(shutil.rmtree, cache, ignore_errors=True)
        drivers = os.environ.get('XDG_CACHE_HOME') or os.path.expanduser('~/.cache')  # its shaders need not be compiled anew
        self.environment |= {'XDG_CACHE_HOME': cache, 'MESA_SHADER_CACHE_DIR': drivers}
        self.open('still.yaml')
        self.keys('space', 'F3')  # nothing else draws
        before = self.display.colors(self.window)
        self.wait_for(lambda: self.raise_children() or glob.glob(os.path.join(cache, 'slosh/scenes-*/scene.png')), self.process)
        self.wait_for(lambda: self.display.colors(self.window) > before + 50, self.process)  # it has come
        self.keys('Escape')
        self.assertIsNone(self.process.poll())
        self.keys('ctrl+o')
        self.at(200, 80)  # the first one: scene.yaml
        self.xdo('click', 1)
        self.opened(2)
        out = self.quit()
        self.assertEqual((out['scene'], out['scenes_opened'], out['scenes']), ('./scene.yaml', 2, False))

    def test_the_next_view(self):
        self.open('still.yaml')
        self.keys('F4', 'd')
        out = self.quit()
        self.assertEqual(out['view'], 'volume')  # spheres, splat, volume
        self.assertIn('view splat: ', self.messages)

    def test_the_end_asks_where_what_was_done_is_not_saved(self):
        """Keys and the window's cross alike, and Escape says no: it never ends anything."""
        self.open('still.yaml')
        self.keys('Escape')
        self.assertIn('nothing is open that could be closed; Ctrl+Q closes the window\n', self.said_now())
        self.drag(1, [(200, 200), (220, 200), (240, 210)], 'ctrl')
        for ask in 'ctrl+q', None:
            if ask:
                self.key(ask)
            else:
                self.display.press_close_button(self.window)
            self.drawn()
            self.keys('Escape')  # no
        self.assertIsNone(self.process.poll())
        question = 'what you did is not saved: Ctrl+S saves it, Ctrl+Q once more closes the window, Escape keeps it open\n'
        for told in question, 'the window stays open\n':
            self.assertEqual(self.said_now().count(told), 2)
        self.keys('ctrl+s')
        self.wait_for(lambda: self.files('recording'), self.process)
        self.drawn()
        self.key('ctrl+q')
        self.end()
        self.assertEqual(self.messages.count(question), 2)

    def test_scenes(self):
        self.write('zz.yaml', STILL.replace('0.4, 0.5', '0.3, 0.5'))
        self.write('yy.yaml', 'box: {size: wide}\n')
        self.open('still.yaml')
        for scenes, key in enumerate(('bracketright',  # yy.yaml is broken: zz.yaml
                                      'Tab',  # scene.yaml, round and round
                                      'bracketleft', 'bracketleft',  # zz.yaml, still.yaml
                                      'Tab'), 2):
            self.key(key)
            self.opened(scenes)
        out = self.quit()
        self.assertRegex(self.messages, r'yy\.yaml:1:\d+: box\.size')
        self.assertEqual((os.path.basename(out['scene']), out['particles']), ('zz.yaml', 300))
        self.assertEqual(out['scenes_opened'], 6)

    def test_the_next_scene_keeps_the_view_that_was_chosen(self):
        self.write('t.yaml', STILL + 'view: {kind: splat}\n')  # has it too
        self.write('u.yaml', STILL)
        self.open('still.yaml', '--view', 'splat', '--set', 'view.splat.weights=w1')
        for scenes in 2, 3:
            self.key('Tab')
            self.opened(scenes)
        out = self.quit()
        self.assertEqual((os.path.basename(out['scene']), out['view'], out['view_settings']['view.splat.weights']['value']),
                         ('u.yaml', 'splat', 'w1'))
        self.open('t.yaml')  # what a file says is no choice
        self.key('Tab')
        self.opened(2)
        self.assertEqual(self.quit()['view'], 'spheres')

    def test_the_users_layout(self):
        def layout(name):
            subprocess.run(['setxkbmap', name], env=self.environment, check=True, timeout=command.PATIENCE, stderr=subprocess.DEVNULL)
        self.addCleanup(layout, 'us')
        layout('de')  # where + is right of P, and Z is left of X
        self.open('still.yaml')
        self.keys('plus', 'plus', 'minus', 'p')
        out = self.quit()
        self.assertEqual((out['speed'], out['scenes_opened'], out['panel']), (2, 1, True))

    def test_record_keeps_all_sessions(self):
        self.open('still.yaml', '--record', 'a.rec')
        self.runs(0.3)  # a session worth keeping
        self.keys('r')
        self.wait_for(lambda: self.files('recording'), self.process)
        self.quit()
        kept = self.files('recording')
        self.assertEqual(len(kept), 1)
        for name in (*kept, 'a.rec'):
            self.assertEqual(self.slosh('replay', name, '--quiet'), (0, ''))

    def test_fullscreen(self):
        self.open('still.yaml')
        self.keys('F11')
        self.until(lambda now: now['fullscreen'] and now['size'] == [800, 600])
        self.quit()


class Past(Window):
    BAR = 331  # the middle of the time line's, pixels from the top

    def play_and_pause(self):
        """A second, in which the box is moved."""
        self.open('still.yaml', '--record', 'a.rec')
        self.display.press('Left')
        self.until(lambda now: now['box_position'][0] < -0.1)
        self.display.release('Left')
        self.until(lambda now: now['time'] > 1)
        self.keys('space')
        self.rest()

    def replayed(self):
        code, said = self.slosh('replay', 'a.rec', '--json', 'replay.json')
        self.assertEqual(code, 0, said)
        return json.loads(self.read('replay.json'))

    def test_steps_back(self):
        """The state is that of then; what is saved is all that was done."""
        self.play_and_pause()
        self.keys('comma', 'comma', 'comma', 'period')
        self.rest()
        out = self.quit()
        replayed = self.replayed()
        self.assertEqual(out['paused'], True)
        self.assertEqual(out['steps'], replayed['steps'] - 10)
        self.assertAlmostEqual(out['time'], replayed['simulated_seconds'] - 0.02)
        self.assertNotIn('cut off', self.messages)

    def test_a_picture_again(self):
        """Three steps back and on: the same to the byte."""
        self.open('still.yaml', '--set', 'solver.backend=compute', '--set', 'solver.reproducible=true', '--set', 'view.color_by=speed')
        self.keys('Left')
        self.runs(0.2)
        pictures = []
        for keys in ['space'], ['comma'] * 3 + ['period'] * 3:
            before = self.files('png')
            self.keys(*keys)
            self.rest()
            self.keys('F12')
            self.wait_for(lambda: len(self.files('png')) > len(before), self.process)
            name, = set(self.files('png')) - set(before)
            pictures.append(self.read(name))
        self.quit()
        self.assertEqual(*pictures)

    def test_on_again(self):
        """From half a second back time runs on as it did, and beyond."""
        self.play_and_pause()
        newest = self.figures()['steps']
        self.keys('shift+comma')
        self.assertLess(self.rest()['steps'], newest)
        self.keys('space')
        self.until(lambda now: now['steps'] > newest + 50)
        self.keys('space', 'shift+comma', 'shift+comma', 'End')
        self.rest()
        out = self.quit()
        self.assertEqual(out['steps'], self.replayed()['steps'])
        self.assertNotIn('cut off', self.messages)

    def test_the_line_is_dragged(self):
        """Left of its begin is the scene's start; the camera stays."""
        self.play_and_pause()
        self.drag(1, [(300, self.BAR), (250, self.BAR), (20, self.BAR - 40)])
        self.rest()
        out = self.quit()
        self.assertEqual((out['steps'], out['paused'], out['camera_auto']), (0, True, True))
        self.assertGreater(self.replayed()['steps'], 100)

    def test_the_line_comes_to_the_mouse(self):
        """Near the lower edge while time runs; a press on it pauses."""
        self.open('still.yaml')
        self.drag(1, [(300, self.BAR), (300, self.BAR)])  # not there yet: the mouse brings it
        self.keys('shift+t')
        self.drag(1, [(300, 100), (320, 100)])  # above it: the camera's
        out = self.quit()
        self.assertEqual((out['paused'], out['camera_auto']), (True, False))

    def test_what_is_done_in_the_past_cuts_the_rest_off(self):
        self.play_and_pause()
        self.drag(1, [(300, self.BAR), (250, self.BAR)])
        self.rest()
        self.display.press('Up')
        self.shown()
        self.keys('space')
        self.until(lambda now: now['box_position'][2] < -0.15)
        self.display.release('Up')
        self.keys('space')
        self.quit()
        self.assertEqual(self.messages.count('cut off'), 1, self.messages)
        self.assertGreater(self.replayed()['commands'], 5)

    def test_without_memory(self):
        self.open('still.yaml', '--past', '0')
        self.keys('space', 'comma', 'comma')
        self.rest()
        self.quit()
        self.assertEqual(self.messages.count('--past'), 1, self.messages)


class Mouse(Window):
    def there_and_back(self):
        """Past a pole; the press is looked at when the mouse is somewhere else already, as behind a slow picture."""
        self.keys('space')
        self.at(200, 80)  # above the fluid: no value is shown there
        before = self.settled()
        self.process.send_signal(signal.SIGSTOP)
        self.xdo('mousedown', 1)
        self.xdo('mousemove', '--window', self.window, 240, 50)
        self.process.send_signal(signal.SIGCONT)
        self.at(210, 350)
        away = self.display.picture(self.window)
        self.at(200, 80)
        self.xdo('mouseup', 1)
        after = self.settled()
        self.assertGreater(sum(map(bytes.__ne__, *map(self.rows, (before, away)))), HEIGHT // 2)
        self.assertEqual(sum(map(bytes.__ne__, *map(self.rows, (before, after)))), 0)

    @staticmethod
    def rows(picture):
        return [picture[at:at + 4 * WIDTH] for at in range(0, len(picture), 4 * WIDTH)]

    def test_camera(self):
        self.open('still.yaml', '--record', 'a.recording')
        self.drag(1, [(240, 180), (260, 180), (300, 190)])
        self.there_and_back()
        self.drag(3, [(240, 180), (240, 200)])
        self.xdo('click', 4)
        self.drawn()
        out = self.quit()
        self.assertFalse(out['camera_auto'])
        self.assertEqual(out['box_position'], [0, 0, 0])
        self.assertLess(out['camera_from'][0], 0.9)  # the scene went to the right: the eye to the left

    def test_camera_goes_home(self):
        self.open('still.yaml')
        self.drag(2, [(240, 180), (260, 190)])
        self.keys('Home')
        self.assertTrue(self.quit()['camera_auto'])

    def test_box_follows_and_the_fluid_answers(self):
        self.open('still.yaml', '--record', 'a.recording')
        self.drag(1, [(200, 200), (230, 200), (260, 200)], 'shift')
        self.until(lambda now: now['box_position'][0] > 0.1)
        out = self.quit()
        self.assertGreater(out['latency_events'], 0)
        self.assertGreater(out['events_ms'], 0)
        self.assertTrue(out['camera_auto'])
        self.assertEqual(self.slosh('replay', 'a.recording', '--quiet', '--threads', '1'), (0, ''))
        text = self.read('a.recording').decode()
        self.write('b.recording', re.sub(r'\d+ target .*\n', '', text))
        code, said = self.slosh('replay', 'b.recording')
        self.assertEqual(code, 1)
        self.assertIn('different after', said)

    def test_touch_stirs_the_fluid(self):
        """By real events: the box stays, the camera too, and the session is the same again."""
        self.open('still.yaml', '--record', 'a.recording')
        self.keys('t')
        self.drag(1, [(200, 180), (230, 180), (260, 180), (290, 190)])
        self.drag(3, [(240, 160), (240, 140)])
        self.xdo('click', 4)
        self.drawn()
        self.display.press('shift')
        self.xdo('click', 4)
        self.display.release('shift')
        self.keys('q')
        self.drag(1, [(240, 180), (245, 180)])
        self.keys('q')
        self.drag(1, [(240, 180), (240, 185)])
        self.keys('Escape')  # puts the finger away, and closes nothing
        self.drawn()
        self.assertIsNone(self.process.poll())
        out = self.quit()
        self.assertEqual(out['box_position'], [0, 0, 0])
        self.assertTrue(out['camera_auto'])
        self.assertGreater(out['latency_events'], 0)
        self.assertRegex(self.messages, r'touch: radius 5\.75 spacings(.|\n)*touch: strength 1\.15')
        text = self.read('a.recording').decode()
        touches = re.findall(r'^\d+ touch (\w+)(.*)$', text, re.M)
        ways = [way for way, _ in touches]
        self.assertEqual([way for k, way in enumerate(ways) if k == 0 or way != ways[k - 1]],
                         ['stir', 'none', 'pull', 'none', 'pull', 'none', 'push', 'none'])
        stroke = [[float.fromhex(number) for number in rest.split()] for way, rest in touches if way == 'stir']
        self.assertGreater(stroke[-1][0] - stroke[0][0], 0.05)  # to the right
        self.assertTrue(all(-0.6 < x < 0.6 and 0 < y < 0.6 and abs(z) < 0.7 for x, y, z, _, _ in stroke), stroke)
        self.assertAlmostEqual(stroke[0][3], 0.5)  # 5 spacings
        self.assertEqual(self.slosh('replay', 'a.recording', '--quiet', '--threads', '1')[0], 0)  # long stirred, it may boil
        self.write('b.recording', re.sub(r'\d+ touch .*\n', '', text))
        code, said = self.slosh('replay', 'b.recording')
        self.assertEqual(code, 1)
        self.assertIn('different after', said)

    def test_touch_pours(self):
        """By real events: fluid comes while the button is held, and the session is the same
        again, as a picture too."""
        self.open('still.yaml', '--record', 'a.recording')
        self.display.press('shift')
        self.keys('q')
        self.display.release('shift')
        self.drag(1, [(240, 120), (250, 120), (260, 120), (260, 130)])
        self.keys('Escape')
        out = self.quit()
        self.assertIn('touch: left drag pours', self.messages)
        touches = re.findall(r'^\d+ touch (.*)$', self.read('a.recording').decode(), re.M)
        self.assertTrue(len(touches) > 2 and touches[0].startswith('pour ') and touches[0].endswith(' 0'), touches)
        self.assertEqual(touches[-1], 'none')
        self.assertTrue(out['camera_auto'])
        self.assertEqual(self.slosh('replay', 'a.recording', '--quiet', '--threads', '1'), (0, ''))
        self.assertEqual(self.slosh('render', 'a.recording', '-o', 'a.png', '--quiet')[0], 0)

    def test_solids_in_the_hand(self):
        """By real events: a ball is put above the fluid, dragged into it, turned; a box is put and taken out; the session
        is the same again, as a picture too."""
        self.open('still.yaml', '--record', 'a.recording', '--set', 'touch.radius=1.5')
        self.keys('0')  # there is none
        self.at(240, 180)
        self.keys('shift+1')
        self.drawn()
        self.drawn()
        self.display.press('shift')
        self.keys('q')
        self.display.release('shift')
        self.keys('q')  # hold
        for y in range(60, 200, 40):
            self.drag(1, [(240, y), (240, y + 20), (240, y + 40), (240, y + 60)])
        self.drag(3, [(240, 190), (250, 190), (260, 190)])
        self.at(180, 180)
        self.keys('shift+2', 'F12')
        self.keys('1')  # a light one
        self.drawn()
        self.keys('Escape')
        self.quit()
        self.assertRegex(self.messages, 'there is no solid under the mouse(.|\n)*hold')
        text = self.read('a.recording').decode()
        acts = re.findall(r'^\d+ solid (\w+) (\d)(.*)$', text, re.M)
        self.assertEqual([acts[0][:2], acts[-1][:2]], [('put', '0'), ('put', '0')], acts)
        self.assertEqual([len(rest.split()) for act, _, rest in acts if act == 'put'], [4, 4, 5], acts)  # with its density
        moves = [[float.fromhex(number) for number in rest.split()] for act, _, rest in acts if act == 'move']
        self.assertTrue(moves and min(move[1] for move in moves) < -0.05, acts)
        code, said = self.slosh('replay', 'a.recording', '--quiet', '--threads', '1')
        self.assertEqual(code, 0, said)  # a slow window moves the ball in jumps, and rescues of the step are said again
        self.assertEqual(self.slosh('render', 'a.recording', '-o', 'a.png', '--quiet')[0], 0)

    def test_gravity_is_tilted(self):
        """By real events: to the right, then as it was; the session is the same again."""
        self.open('still.yaml', '--record', 'a.recording')
        self.display.press('ctrl')
        self.drag(1, [(200, 180), (220, 180), (240, 180), (260, 180)], 'shift')
        self.drawn()
        self.keys('g')
        self.display.release('ctrl')
        out = self.quit()
        self.assertEqual(out['box_position'], [0, 0, 0])
        text = self.read('a.recording').decode()
        set_to = [[float(number) for number in line.split(',')]
                  for line in re.findall(r'^\d+ set gravity=\[(.*)\]$', text, re.M)]
        self.assertGreater(len(set_to), 1, text)
        self.assertTrue(set_to[0][0] > 0.5 and all(abs(sum(x * x for x in g) ** 0.5 - 9.81) < 0.01 for g in set_to), set_to)
        self.assertEqual(set_to[-1], [0, -9.81, 0])
        self.assertEqual(self.slosh('replay', 'a.recording', '--quiet', '--threads', '1'), (0, ''))

    def test_a_ring_shows_the_finger(self):
        """Also while time stands; pressed it has the colour of what the hand holds."""
        self.open('still.yaml')
        self.keys('space', 't')
        self.at(240, 180)
        self.assertEqual(self.outline(), 0)
        self.display.fake(X.ButtonPress, [1])
        self.wait_for(lambda: self.outline() > 50, self.process)
        self.at(260, 170)
        self.drawn()
        self.assertGreater(self.outline(), 50)
        self.display.fake(X.ButtonRelease, [1])
        self.wait_for(lambda: self.outline() == 0, self.process)
        self.keys('r', 't')  # begins anew with nothing in the fluid; the mouse is the camera's again
        self.quit()

    def outline(self):
        """Pixels of the colour of the outline."""
        picture = self.display.picture(self.window)
        return sum(picture[i + 2] > 230 and 70 < picture[i + 1] < 140 and 180 < picture[i] < 230 for i in range(0, len(picture), 4))

    def test_a_paused_box_shows_where_it_goes(self):
        """By an outline, as long as it is not there."""
        self.open('still.yaml', '--record', 'a.recording')
        self.keys('space')
        self.assertEqual(self.outline(), 0)
        self.drag(1, [(200, 200), (230, 200), (260, 200)], 'shift')
        self.wait_for(lambda: self.outline() > 50, self.process)
        self.keys('b')  # home, where it is
        self.wait_for(lambda: self.outline() == 0, self.process)
        self.drag(1, [(200, 200), (220, 200), (250, 210)], 'ctrl')
        self.wait_for(lambda: self.outline() > 50, self.process)
        self.keys('space')
        self.wait_for(lambda: self.outline() == 0, self.process)
        out = self.quit()
        self.assertLess(out['box_orientation'][3], 0.999)

    def test_box_turns_and_comes_home(self):
        self.open('still.yaml', '--record', 'a.recording')
        self.drag(1, [(200, 200), (220, 200), (240, 210)], 'ctrl')
        self.until(lambda now: now['box_orientation'][3] < 0.99)
        self.keys('ctrl+s')
        self.wait_for(lambda: self.files('recording'), self.process)
        self.keys('BackSpace')
        self.until(lambda now: now['box_orientation'][3] > 0.9999)
        self.quit()
        poses = [line.split()[5:] for line in self.read('a.recording').decode().split('\n') if ' target ' in line]
        turned = min(abs(float.fromhex(pose[3])) for pose in poses)
        self.assertLess(turned, 0.99)

    def test_arrow_keys(self):
        self.open('still.yaml')
        self.display.press('Right')
        self.until(lambda now: now['box_position'][0] > 0.1)
        self.display.release('Right')
        self.display.press('shift')
        self.display.press('Left')
        self.until(lambda now: now['box_orientation'][3] < 0.995)
        self.display.release('Left')
        self.display.release('shift')
        out = self.quit()
        self.assertGreater(out['box_position'][0], 0.1)

    def lose_focus(self):
        connection = self.display.connection
        connection.set_input_focus(X.NONE, X.RevertToNone, X.CurrentTime)
        connection.sync()
        self.shown()

    def test_lost_focus_stops_only_what_is_held(self):
        self.open('still.yaml')
        self.display.press('Right')
        self.until(lambda now: now['box_position'][0] > 0.7)
        self.display.release('Right')
        self.key('b')  # home, which takes longer than this
        self.lose_focus()
        self.focus()
        self.until(lambda now: abs(now['box_position'][0]) < 0.01)
        self.quit()

    def test_lost_focus_lets_go(self):
        self.open('still.yaml')
        self.at(200, 200)
        self.display.press('shift')
        self.display.fake(X.ButtonPress, [1])
        self.at(230, 200)
        self.at(260, 200)
        self.until(lambda now: now['box_position'][0] > 0.05)
        self.lose_focus()
        for x in (300, 340, 380, 420):
            self.at(x, 200)
        self.runs(0.8)
        self.display.fake(X.ButtonRelease, [1])
        self.display.release('shift')
        self.focus()
        out = self.quit()
        first = out['box_position'][0]
        self.assertGreater(first, 0.05)
        self.assertLess(first, 0.6)  # all of the drag would be four times the first part


class Shaders(Window):
    def change(self, old, new):
        with open(self.path('shaders/spheres/spheres_shade.frag'), 'r+', encoding='utf-8') as file:
            text = file.read()
            self.assertIn(old, text)
            file.seek(0)
            file.truncate()
            file.write(text.replace(old, new))

    def test_changed_shaders_are_read_again(self):
        shutil.copytree('shaders', self.path('shaders'))
        self.open('still.yaml', '--shaders', 'shaders')
        self.change('void main()', 'void main(')
        self.wait_said('spheres_shade.frag:')
        self.drawn(5)  # it goes on drawing
        self.change('void main(', 'void main()')
        self.wait_said('the shaders were read again')
        self.drawn()
        self.quit()
        self.assertRegex(self.messages, r'spheres_shade\.frag:\d+:[^\0]*the shaders were read again')


class Panel(Window):
    def open(self, *arguments, size=(760, 560)):
        super().open('still.yaml', *arguments, size=size)
        self.keys('p')
        self.drawn(5)

    def pause(self):
        self.keys('space')
        self.rest()

    def drag(self, *arguments):
        super().drag(*arguments)
        self.drawn(3)  # a press is taken by one picture and answered by the next

    def test_a_button_is_the_panels_own(self):
        self.open()
        self.pause()
        self.drag(1, [(120, 60), (200, 90)])  # between the widgets: nothing
        self.drag(1, [(44, 170), (44, 170)])  # the button: it goes on; a click counts while nothing moves
        out = self.quit()
        self.assertEqual((out['panel'], out['paused'], out['camera_auto']), (True, False, True))

    def test_hidden_it_takes_nothing(self):
        self.open()
        self.keys('F2')
        self.drag(1, [(44, 170), (94, 170)])
        out = self.quit()
        self.assertEqual((out['panel'], out['paused'], out['camera_auto']), (False, False, False))

    def test_a_slider_changes_the_fluid(self):
        self.open('--record', 'a.rec')
        self.pause()
        self.drag(1, [(248, 307), (255, 307), (262, 307)])  # gravity, below the heading Play
        self.keys('space')
        self.drawn(5)
        self.quit()
        self.assertRegex(self.read('a.rec').decode(), r'\d+ set gravity=\[')
        self.assertEqual(self.slosh('replay', 'a.rec', '--quiet')[0], 0)  # it may say that the fluid is squeezed

    def test_high_density(self):
        connection, root = self.display.connection, self.display.root
        root.change_property(Xatom.RESOURCE_MANAGER, Xatom.STRING, 8, b'Xft.dpi:\t192\n')
        connection.sync()
        try:
            self.open()
            self.keys('h', 'Escape')
            out = self.quit()
        finally:
            root.delete_property(Xatom.RESOURCE_MANAGER)
            connection.sync()
        self.assertEqual(out['display_scale'], 2)
        self.assertEqual(out['size'], [1520, 1120])  # as large on such a display
        self.assertTrue(out['panel'])


class Ends(Window):
    def test_close_button(self):
        self.open('still.yaml')
        self.display.press_close_button(self.window)
        self.end()

    def test_sigterm(self):
        self.open('still.yaml', '--record', 'a.recording')
        self.process.send_signal(signal.SIGTERM)
        self.end()
        self.assertEqual(self.slosh('replay', 'a.recording', '--quiet'), (0, ''))

    def test_a_long_step_is_not_waited_for(self):
        """The first one takes minutes, longer than the end is waited for here."""
        self.start('still.yaml', '--particles', '200000', '--set', 'solver.method=pbf', '--set', 'solver.corrections=10000',
                   '--set', 'solver.compression=0')
        self.wait_for(lambda: self.display.colors(self.window) >= FLUID_COLORS, self.process)
        self.figures()
        self.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.end()['steps'], 0)

    def test_smallest_size_and_back(self):
        self.open('still.yaml')
        self.xdo('windowsize', self.window, 1, 1)
        self.until(lambda now: now['size'] == [1, 1])
        self.xdo('windowsize', self.window, 300, 200)
        self.until(lambda now: now['size'] == [300, 200])
        self.keys('F12')
        out = self.quit()
        self.assertEqual(out['size'], [300, 200])
        self.assertEqual(png_size(self.read(self.files('png')[0])), (300, 200))

    def test_a_simulation_that_blows_up_does_not_end_the_program(self):
        self.open('scene.yaml', '--set', 'solver.step.dt=0.3', '--set', 'solver.step.substeps=1')
        self.wait_said('blew up')
        self.rest()
        self.quit()


class Without(CommandTest):
    def test_no_display(self):
        environment = {name: value for name, value in os.environ.items() if name != 'DISPLAY'}
        done = subprocess.run([command.PROGRAM, 'play', 'scene.yaml'], cwd=self.folder, env=environment,
                              capture_output=True, text=True, timeout=command.PATIENCE, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r'no display.*slosh render SCENE -o OUT\.mp4')

    def test_bad_scene(self):
        self.write('bad.yaml', 'box: 3\n')
        code, said = self.slosh('bad.yaml')
        self.assertEqual(code, 2)
        self.assertRegex(said, r'bad\.yaml:1:\d+: ')
        self.assertEqual(self.entries(), ['bad.yaml'])

    def test_record_where_nothing_can_be_written(self):
        code, said = self.slosh('play', 'scene.yaml', '--record', 'no/such/x')
        self.assertEqual(code, 1)
        self.assertIn('no/such/x', said)


if __name__ == '__main__':
    command.main('Keys', 'Past Ends Shaders', 'Mouse Panel Without')
