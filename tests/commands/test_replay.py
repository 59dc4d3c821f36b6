"""slosh replay: the same bits again, or what is different."""
import json
import os
import re
import signal
import subprocess

import command
from command import SCENE, CommandTest, limit_files, video_frames, whole_steps

COMMANDS = ['0 target 0x1.999999999999ap-4 0 0 0 0 0 1',
            '20 set gravity=[0, -3, 0]',
            '21 carry 0.1 0 0 0 0 0.2 1',
            '40 set fluids[1].viscosity=30',
            '40 target 0 0.1 0 0.1 0 0 1']


def recording(commands, end, scene=SCENE, program='0.1', head=()):
    text = ''.join(f'| {line}\n' for line in scene.splitlines())
    lines = ['slosh recording 1', f'program {program}', 'scene scene.yaml', *head]
    return '\n'.join(lines) + '\ntext\n' + text + '\n'.join(['commands', *commands, *end, ''])


class Replay(CommandTest):
    def version(self):
        return subprocess.run([command.PROGRAM, '--version'], capture_output=True, text=True,
                              check=True).stdout.split()[1]

    def recording(self, commands, end, **more):
        self.write('a.rec', recording(commands, end, **{'program': self.version(), **more}))

    def hash(self, *arguments):
        """What the program computes, whatever was recorded."""
        self.slosh('replay', 'a.rec', '--quiet', '--json', 'a.json', *arguments)
        return json.loads(self.read('a.json'))['hash']

    def record(self, commands=COMMANDS, steps=100, **more):
        """Writes a recording that ends as the program computes it."""
        self.recording(commands, [f'end {steps} {"0" * 16}'], **more)
        value = self.hash()
        self.recording(commands, [f'end {steps} {value}'], **more)
        return value

    def test_same(self):
        value = self.record()
        for threads in ('1', '2'):
            code, said = self.slosh('replay', 'a.rec', '--threads', threads, '--json', 'a.json')
            self.assertEqual(code, 0, said)
            self.assertIn(f'the same bits: 100 steps, hash {value}\n', said)
            self.assertIn('replay: 100 %', said)
            found = json.loads(self.read('a.json'))
            self.assertEqual((found['same'], found['hash'], found['recorded_hash'], found['threads']),
                             (True, value, value, int(threads)))
            self.assertEqual((found['steps'], found['commands'], found['particles']), (100, 5, 500))
        self.assertEqual(self.slosh('replay', 'a.rec', '--quiet'), (0, ''))

    def film(self, *arguments):
        code, said = self.slosh('render', 'a.rec', '--size', '64x48', '--json', 'a.json', *arguments)
        return code, said, json.loads(self.read('a.json'))

    def test_a_session_is_filmed(self):
        """By any view, and with the bits of the session; a frame is 0.004 s, two steps."""
        value = self.record()
        code, said, found = self.film('-o', 'a.mp4', '--fps', '100', '--view', 'splat', '--set', 'view.color_by=density')
        self.assertEqual(code, 0, said)
        self.assertIn(f'the same bits: 100 steps, hash {value}\n', said)
        self.assertIn('render: 100 %', said)
        self.assertIn(' left\n', said)  # an estimate
        self.assertEqual((found['same'], found['hash'], found['steps'], found['pictures']), (True, value, 100, 21))
        self.assertEqual(video_frames(self.path('a.mp4')), 21)
        for more, late in (['--steps'], 0.002), ([], 0):  # pictures 7.5 steps apart, in either mode of steps
            code, said, found = self.film('-o', 'a', '--time', '0.1', '--fps', str(1 / 0.015), *more)
            self.assertAlmostEqual(found['picture_late_seconds'], late / 2 if late else 0, msg=said)
        code, said, found = self.film('-o', 'a.png')  # the end
        self.assertEqual((code, found['same'], found['pictures']), (0, True, 1), said)
        code, said, found = self.film('-o', 'a', '--time', '0.1', '--fps', '100')
        self.assertEqual((code, found['same'], found['pictures'], len(os.listdir(self.path('a')))), (0, False, 10, 10), said)
        self.assertIn('the session goes on to step 100; its end was not compared\n', said)

    def test_the_film_of_a_session_shows_what_was_done(self):
        """Its last picture is that of the state which replay leaves."""
        self.record()
        self.slosh('replay', 'a.rec', '-o', 'a.h5part', '--every', '0.2', '--quiet')
        for name in 'a.rec', 'a.h5part':
            self.assertEqual(self.slosh('render', name, '-o', name[2:] + '.png', '--size', '64x48', '--quiet')[0], 0)
        self.assertEqual(self.read('rec.png'), self.read('h5part.png'))

    def test_the_film_follows_views(self):
        """Keys of views are live: from its step on a picture is that of a scene which has it from the start."""
        look = ("view: {kind: pbsr, legend: false, pbsr: {repeat: 4, layers: [{of: sphere, level: 0.2, color: [1, 0, 0]}]}}\n")
        pictures = {}
        for name, keys, commands in (
                ('none', '', []), ('moved', '', ['20 set view.pbsr.layers[0].position=[0.3, 0, 0]', '30 set view.pbsr.layers[0].angle=40']),
                ('early', ', position: [0.3, 0, 0], angle: 40', []), ('spheres', '', ['20 set view.kind=spheres', '30 set view.color_by=density'])):
            self.record(commands, 40, scene=SCENE + look.replace('level', f'opacity: 0.9{keys}, level'.strip(', ')))
            code, said = self.slosh('render', 'a.rec', '-o', f'{name}.png', '--size', '64x48', '--quiet', '--set', 'view.carries_scene=false')
            self.assertEqual((code, len(said.splitlines())), (0, 1), said)  # the renderer
            pictures[name] = self.read(f'{name}.png')
            self.slosh('render', 'a.rec', '-o', name, '--size', '64x48', '--quiet', '--fps', '50')
        self.assertEqual(pictures['moved'], pictures['early'])
        self.assertEqual(len(set(pictures.values())), 3)
        first, last = (self.read(f'spheres/frame_0000{k}.png') for k in (0, 3))
        self.assertEqual(first == self.read('none/frame_00000.png'), True)
        self.assertNotEqual(last, self.read('none/frame_00003.png'))

    def test_a_film_that_is_another_one(self):
        value = self.record()
        self.recording(COMMANDS[1:], [f'end 100 {value}'])
        code, said, found = self.film('-o', 'a.mp4', '--quiet')
        self.assertEqual((code, found['same']), (1, False))
        self.assertIn('different after 100 steps', said)
        self.assertGreater(video_frames(self.path('a.mp4')), 5)
        for option, words in (('--particles', '100'), ('--backend', 'compute'), ('--set', 'gravity=[0, 0, 0]'), ('--device', 'file:x')):
            code, said = self.slosh('render', 'a.rec', '-o', 'b.mp4', option, words)
            self.assertEqual(code, 2)
            self.assertRegex(said, f'^{option}.* makes no sense for a.rec: .*\n$')

    def test_what_only_the_recording_has(self):
        self.recording(['5 size 1.2 1 1'], ['end 10 0000000000000000'])
        said = self.slosh('replay', 'a.rec', '-o', 'a.h5part', '--quiet')[1]
        self.assertIn("a.h5part: warning: only the recording has the box's new size\n", said)

    def test_different(self):
        value = self.record()
        for k in range(len(COMMANDS)):
            changed = [line for i, line in enumerate(COMMANDS) if i != k]
            self.recording(changed, [f'end 100 {value}'])
            code, said = self.slosh('replay', 'a.rec', '--quiet')
            self.assertEqual(code, 1)
            self.assertRegex(said, f'^different after 100 steps: hash [0-9a-f]{{16}}, and {value} was recorded\n$')

    def test_is_what_run_simulates(self):
        """Without commands the snapshots are those of `run`, number for number, if a frame is one step:
        `run` looks at whole frames."""
        import h5py
        self.record(commands=[], steps=50, head=['particles 300', 'set solver.sound_speed=12',
                                                        'set solver.step={dt: 0.002, substeps: 1}'])
        code, said = self.slosh('replay', 'a.rec', '-o', 'a.h5part', '--every', '0.02')
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r'a\.h5part: \d snapshots\n')
        code, said = self.slosh('run', 'scene.yaml', '-o', 'b.h5part', '--every', '0.02', '--particles', '300',
                                '--set', 'solver.sound_speed=12', '--set', 'solver.step={dt: 0.002, substeps: 1}',
                                '--set', 'solver.threads=1', '--time', '1')
        self.assertEqual(code, 0, said)
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 4)
        with h5py.File(self.path('a.h5part')) as a, h5py.File(self.path('b.h5part')) as b:
            for step in a:
                self.assertEqual(a[step].attrs['TimeValue'], b[step].attrs['TimeValue'])
                for field in a[step]:
                    self.assertEqual(a[step][field][:].tobytes(), b[step][field][:].tobytes())

    def test_other_version(self):
        self.record(program='0.0.9')
        code, said = self.slosh('replay', 'a.rec', '--quiet')
        self.assertEqual(code, 0)
        self.assertRegex(said, r'^a\.rec: recorded by slosh 0\.0\.9; this is .*, whose bits may differ\n$')

    def test_cut(self):
        self.recording(COMMANDS, [])
        code, said = self.slosh('replay', 'a.rec', '--quiet')
        self.assertEqual(code, 1)
        self.assertRegex(said, r"^a\.rec:\d+: the recording was cut here, its last line 'end STEPS HASH' is missing; "
                               r'40 steps were replayed, hash [0-9a-f]{16}, and nothing is proven\n$')

    def bad(self, message, *arguments):
        code, said = self.slosh('replay', 'a.rec', '--quiet', '-o', 'a.h5part', *arguments)
        self.assertEqual(code, 2, said)
        self.assertIn(message, said)
        written = 'a.h5part' in self.entries()
        self.assertEqual(written, 'before that' in said)
        if written:
            os.remove(self.path('a.h5part'))

    def test_bad_files(self):
        self.bad('a.rec: cannot be opened (No such file or directory); ')
        self.write('a.rec', bytes(range(256)) * 100)
        self.bad("a.rec:1: this is no recording; the first line of one is 'slosh recording 1'")
        first = 5 + len(SCENE.splitlines()) + 1
        end = ['end 100 0000000000000000']
        self.recording(['0 set gravity=3'], end)
        self.bad(f'a.rec:{first}: --set gravity=3: gravity must be three numbers')
        self.recording(['0 set box.size=[1, 1, 1]'], end)
        self.bad(f'a.rec:{first}: --set box.size=[1, 1, 1]: box.size cannot change while the simulation runs; ')
        self.recording([], end, scene='box: {size: [1, 1]}')
        self.bad('a.rec: its scene: scene.yaml:1:')
        self.recording([], end)
        self.bad('a.rec: its scene: --threads many: ', '--threads', 'many')

    def test_command_line(self):
        self.assertEqual(self.slosh('replay'),
                         (2, 'slosh replay: the recording is missing; write slosh replay FILE [OPTIONS]\n'))
        self.assertIn("one argument too many: 'b'; it takes 1 recording\n", self.slosh('replay', 'a', 'b')[1])
        self.assertIn("unknown option '--particles'", self.slosh('replay', 'a', '--particles', '3')[1])
        self.record()
        code, said = self.slosh('replay', 'a.rec', '-o', 'a.png')
        self.assertEqual((code, said), (2, "'a.png' is no name for snapshots; name a FILE.h5part\n"))

    def test_blow_up(self):
        blow_up = ['0 set solver.step.dt=0.5']
        at_once = ['set solver.step.retries=0']
        self.recording(blow_up, ['end 4000 0000000000000000'], head=at_once)
        code, said = self.slosh('replay', 'a.rec', '--quiet')
        self.assertEqual(code, 1)
        time = re.match('the simulation blew up at t = ([0-9.]+) s: ', said)[1]
        # a session that ended so is done again, and the failure with it
        value = self.record(blow_up, round(float(time) / 0.25), head=at_once)
        code, said = self.slosh('replay', 'a.rec')
        self.assertEqual(code, 0, said)
        self.assertIn(f'the simulation blew up at t = {time} s: ', said)
        self.assertIn(f'hash {value}\n', said)

    def test_interrupt(self):
        self.recording([], ['end 100000000 0000000000000000'])
        process = self.start('replay', 'a.rec', '-o', 'a.h5part')
        self.wait_for(lambda: 'a.h5part' in self.entries(), process)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=command.PATIENCE)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertRegex(said, r'stopped at step \d+ of 100000000; nothing was compared\n')
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 0)

    def test_full_disk(self):
        self.record()
        code, said = self.slosh('replay', 'a.rec', '-o', 'a.h5part', '--every', '0.004', '--quiet', before=limit_files(400000))
        self.assertEqual(code, 1)
        self.assertIn('File too large', said)
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 2)


if __name__ == '__main__':
    command.main()
