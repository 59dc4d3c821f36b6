"""What the tests of the command line share: the program, a small scene, a folder of its own for each test."""
import atexit
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

# 500 particles, rocked a little; a frame is 0.004 s.
SCENE = """\
title: A small tank
box: {size: [1, 1, 1]}
particles: {spacing: 0.1}
fluids:
  - name: water
    density: 1000
    fill:
      - block: {min: [-0.5, 0, -0.5], max: [0, 0.5, 0.5]}
  - name: oil
    density: 900
    fill:
      - block: {min: [0, 0, -0.5], max: [0.5, 0.5, 0.5]}
solver:
  sound_speed: 15
  step: {dt: 0.004, substeps: 2}
motion:
  - rock: {axis: [0, 0, 1], angle: 10, frequency: 1}
"""

PROGRAM = None

PATIENCE = 1000  # s, for all that is waited for: no time that a busy machine needs; ctest ends what hangs soon after


def ids(tests):
    """The names of the tests of a suite."""
    return set().union(*map(ids, tests)) if isinstance(tests, unittest.TestSuite) else {tests.id()}


def main(*groups):
    """Runs the tests of the calling file; its first argument is the path of slosh, and what follows names tests. Where none
    is named, groups of classes or tests run side by side, each in a process of its own; each test must be in one."""
    global PROGRAM
    if groups and len(sys.argv) == 2:
        loader, module = unittest.TestLoader(), sys.modules['__main__']
        forgotten = ids(loader.loadTestsFromModule(module)) - ids(loader.loadTestsFromNames(' '.join(groups).split(), module))
        if forgotten:
            sys.exit(f'in no group of command.main: {" ".join(sorted(forgotten))}')
        runs = [subprocess.Popen([sys.executable, *sys.argv, *group.split()]) for group in groups]
        sys.exit(max([run.wait() != 0 for run in runs]))
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main(module='__main__')


def obey_interrupts():
    """In the child: also where this test runs in the background of a script, that ignores them."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def limit_files(size):
    """For the child: no file may have more bytes, as if the disk were full then."""
    def limit():
        obey_interrupts()
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return limit


def without_text(png):
    """Its bytes but for the chunks of text, in which a picture of a scene carries it."""
    kept, at = png[:8], 8
    while at < len(png):
        end = at + 12 + int.from_bytes(png[at:at + 4], 'big')
        kept += b'' if png[at + 4:at + 8] in (b'tEXt', b'iTXt') else png[at:end]
        at = end
    return kept


class CommandTest(unittest.TestCase):
    made = {}  # what `once` keeps, until the end of all tests: by scenes and arguments, its path

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix='slosh-test-')
        self.addCleanup(shutil.rmtree, self.folder)
        self.write('scene.yaml', SCENE)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), 'wb' if isinstance(content, bytes) else 'w') as file:
            file.write(content)

    def read(self, name):
        with open(self.path(name), 'rb') as file:
            return file.read()

    def entries(self):
        """What the program left in the folder."""
        return sorted(set(os.listdir(self.folder)) - {'scene.yaml'})

    def slosh(self, *arguments, before=obey_interrupts, env=None, gl_errors=False):
        """Runs the program to its end: (exit code, standard error). OpenGL has nothing to complain of, or may. Where the leak sanitizer
        dies itself, in its look behind the end, the program runs again: what it would have returned is not known."""
        for _ in range(3):
            done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True,
                                  timeout=PATIENCE, preexec_fn=before, env=env, check=False)
            if 'LeakSanitizer has encountered a fatal error' not in done.stderr:
                break
        if not gl_errors:
            self.assertNotIn('GL error', done.stderr)
        return done.returncode, done.stderr

    def once(self, name, *arguments):
        """The program writes the file `name`, for the first test with those arguments and scenes; others get a copy of it."""
        key = name, arguments, *(self.read(scene) for scene in sorted(os.listdir(self.folder)) if scene.endswith('.yaml'))
        if key in self.made:
            shutil.copyfile(self.made[key], self.path(name))
            return
        code, said = self.slosh(*arguments)
        self.assertEqual(code, 0, said)
        if not self.made:
            self.made[None] = tempfile.mkdtemp(prefix='slosh-test-')
            atexit.register(shutil.rmtree, self.made[None])
        self.made[key] = shutil.copyfile(self.path(name), os.path.join(self.made[None], str(len(self.made))))

    def start(self, *arguments):
        """Starts the program in a process group of its own, as a terminal does."""
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True, preexec_fn=obey_interrupts)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def has(self, name, size=1):
        """Whether a file is there, with so many bytes: for `wait_for` and `stopped`."""
        return lambda: os.path.exists(self.path(name)) and os.path.getsize(self.path(name)) >= size

    def has_lines(self, name, count):
        return lambda: os.path.exists(self.path(name)) and self.read(name).count(b'\n') >= count

    def stopped(self, number, reached, *arguments):
        """The exit code of the program that gets the signal when that is reached; where it came to its end before, it begins
        again, with the same files."""
        before = {name: self.read(name) for name in self.entries()}
        for _ in range(20):
            process = self.start(*arguments)
            while process.poll() is None and not reached():
                time.sleep(0.002)
            process.send_signal(number)
            if process.wait() != 0:
                return process.wait()
            for name in self.entries():
                os.remove(self.path(name))
            for name, content in before.items():
                self.write(name, content)
        return self.fail('the program came to its end each time before it was stopped')

    def wait_for(self, condition, process):
        """Until it holds, which it must before the program ends. Returns what the condition gave."""
        end = time.monotonic() + PATIENCE
        while not (found := condition()):
            self.assertIsNone(process.poll(), 'the program ended too early')
            self.assertLess(time.monotonic(), end, 'waited in vain')
            time.sleep(0.01)
        return found


class TinyDiskTest(CommandTest):
    """A file system that is really full; needs a kernel that lets users mount one of their own."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path('disk'))
        if self.on_disk('64k', 'true').returncode != 0:
            self.skipTest('no mount of a small file system: unshare -rm is not permitted here')

    def on_disk(self, size, script):
        script = f'mount -t tmpfs -o size={size} none disk && {script}'
        return subprocess.run(['unshare', '-rm', 'sh', '-c', script], cwd=self.folder, capture_output=True,
                              text=True, check=False, preexec_fn=obey_interrupts)

    def full(self, size, arguments):
        """The program's exit code must be 1; what is then on the disk is moved to the test's folder."""
        done = self.on_disk(size, f'"{PROGRAM}" {arguments}; code=$?; cp -r disk/. .; exit $code')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('No space left on device', done.stderr)
        self.assertEqual(os.listdir(self.path('disk')), [])
        return [name for name in self.entries() if name != 'disk']


def video_frames(path):
    """The number of frames that a player finds; fails when it finds anything wrong."""
    text = subprocess.run(['ffprobe', '-v', 'error', '-count_frames', '-select_streams', 'v', '-show_entries',
                           'stream=nb_read_frames', '-of', 'csv=p=0', path], capture_output=True, text=True,
                          check=True)
    assert text.stderr == '', text.stderr
    return int(text.stdout)


def whole_steps(path):
    """The times of the steps of a snapshot file, which must all be whole."""
    import h5py
    times = []
    with h5py.File(path, 'r') as file:
        names = [f'Step#{k}' for k in range(sum(name.startswith('Step#') for name in file))]
        for name in names:
            assert file[name].attrs['complete'] == 1
            lengths = {file[name][field][:].shape for field in file[name]}
            assert len(file[name]) == len(file['Step#0']) >= 11 and len(lengths) == 1, lengths
            times.append(float(file[name].attrs['TimeValue']))
    return times
