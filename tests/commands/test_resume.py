"""slosh run --resume: whatever ended a run, the rest of it comes out with the same bits."""
import contextlib
import os
import shutil
import signal

import h5py
import numpy

import command
from command import CommandTest, SCENE, whole_steps

FLOW = """\
box: {size: [1, 1, 1]}
particles: {spacing: 0.06, most: 300}
fluids:
  - viscosity: 1
    emit:
      - disk: {centre: [0, 0.7, 0], direction: [0.1, -1, 0], radius: 0.15}
        speed: 3
drains:
  - block: {min: [-0.5, 0, -0.5], max: [0.5, 0.1, 0.5]}
solids:
  - sphere: {centre: [0, 0.3, 0], radius: 0.15}
    slip: none
    motion: [{shake: {axis: [1, 0, 0], amplitude: 0.1, frequency: 4}}]
motion:
  - rock: {axis: [0, 0, 1], angle: 10, frequency: 3}
solver: {sound_speed: 20, step: {dt: 0.004, substeps: 4}}
"""
TIME, EVERY = '0.2', '0.004'


class ResumeTest(CommandTest):
    def go(self, *more, code=0, name='a.h5part'):
        done, said = self.slosh('run', 'scene.yaml', '-o', name, '--time', TIME, '--every', EVERY, '--quiet', *more)
        self.assertEqual(done, code, said)
        return said

    def same(self, a, b, but=0):
        """Every number of every step, of particles and attributes; but the last ones of the restart's."""
        with h5py.File(self.path(a)) as one, h5py.File(self.path(b)) as other:
            self.assertEqual(sorted(one), sorted(other))
            for step in one:
                for name, value in one[step].attrs.items():
                    there = other[step].attrs[name]
                    if name == 'restart' and but:
                        value, there = value[:-but], there[:-but]
                    self.assertEqual(value.tobytes(), there.tobytes(), (step, name))
                order = [group[step]['id'][:].argsort() for group in (one, other)]
                for name in one[step]:
                    if name not in ('density', 'pressure', 'compression'):
                        self.assertEqual(one[step][name][:][order[0]].tobytes(),
                                         other[step][name][:][order[1]].tobytes(), (step, name))

    def whole(self, *more):
        self.once('whole.h5part', 'run', 'scene.yaml', '-o', 'whole.h5part', '--time', TIME, '--every', EVERY, '--quiet', *more)
        return len(whole_steps(self.path('whole.h5part')))

    def stopped_run(self, number, reached, *more):
        return self.stopped(number, reached, 'run', 'scene.yaml', '-o', 'a.h5part', '--time', TIME, '--every', EVERY, '--quiet', *more)


class Resume(ResumeTest):
    def test_a_preset_is_what_it_fills_in(self):
        """Files from before there were presets name none."""
        self.go('--time', '0.1')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            settings = file.attrs['settings'].decode()
            self.assertIn('solver.preset = play\n', settings)
            file.attrs['settings'] = numpy.bytes_(settings.replace('solver.preset = play\n', ''))
        self.go('--resume')
        self.assertIn("this is '", self.go('--resume', '--set', 'solver.preset=accurate', code=2))

    def test_a_table_of_forces_goes_on(self):
        """To the same bytes, each row once; one of another scene is left as it is."""
        self.write('scene.yaml', FLOW)
        self.go('--forces', 'whole.csv', name='whole.h5part')
        self.go('--time', '0.1', '--forces', 'a.csv')
        self.go('--resume', '--forces', 'a.csv')
        whole = self.read('whole.csv').decode()
        rows = whole.splitlines()
        self.assertEqual(len(rows[0].split(',')), 2 + 2 * 6)
        self.assertEqual(len(rows), 1 + 50)
        self.assertEqual(whole, self.read('a.csv').decode())
        self.write('b.csv', 'time,seconds\n')
        self.go('--time', '0.1', name='b.h5part')
        said = self.go('--resume', '--forces', 'b.csv', code=1, name='b.h5part')
        self.assertIn("b.csv: is no table of this scene's forces", said)
        self.assertEqual('time,seconds\n', self.read('b.csv').decode())

    def test_a_table_of_forces_of_a_killed_run(self):
        """It has its rows, the last one may be half one; with the rest it comes to the same bytes."""
        self.write('scene.yaml', FLOW)
        self.go('--forces', 'whole.csv', name='whole.h5part')
        whole = self.read('whole.csv').decode()
        for rows in (1, 30):
            for name in ('a.h5part', 'a.csv'):
                if os.path.exists(self.path(name)):
                    os.remove(self.path(name))
            self.assertEqual(self.stopped_run(signal.SIGKILL, self.has_lines('a.csv', 1 + rows), '--forces', 'a.csv'), -signal.SIGKILL)
            left = self.read('a.csv').decode()
            self.assertTrue(whole.startswith(left))
            with h5py.File(self.path('a.h5part')) as file:
                last = file[f"Step#{len(whole_steps(self.path('a.h5part'))) - 1}"].attrs['TimeValue']
            self.assertGreaterEqual(float(left.splitlines()[-1].split(',')[0]), last * (1 - 1e-9))
            with open(self.path('a.csv'), 'a') as file:
                file.write('0.19,0.0')  # a row that did not come to its end
            self.go('--resume', '--forces', 'a.csv')
            self.assertEqual(whole, self.read('a.csv').decode())

    def test_tables_of_the_start_may_be_gone(self):
        """They, or what stands in them, are of no use any more: a run goes on from its own first state."""
        text = SCENE.replace('0.5, 0.5]}\nsolver', '0.5, 0.5]}\n        below: heights.csv\nsolver')
        self.assertIn('heights.csv', text)
        self.write('scene.yaml', text)
        self.write('heights.csv', 'x (m),height (m)\n-0.5,0.4\n0.5,0.5\n')
        self.whole()
        self.go('--time', '0.1')
        self.write('heights.csv', 'x (m),height (m)\n-0.5,0.1\n0.5,0.1\n')
        self.go('--resume', '--time', '0.16')
        os.remove(self.path('heights.csv'))
        self.go('--resume')
        self.same('whole.h5part', 'a.h5part')
        said = self.go(code=2, name='b.h5part')
        self.assertIn('heights.csv: No such file or directory: ', said)

    def test_a_number_of_particles_comes_of_the_tables(self):
        """The same spacing as at the start; tables that have changed are told by the one that they give."""
        text = SCENE.replace('0.5, 0.5]}\nsolver', '0.5, 0.5]}\n        below: heights.csv\nsolver')
        some = ('--particles', '400')
        self.write('scene.yaml', text)
        self.write('heights.csv', 'x (m),height (m)\n-0.5,0.2\n0.5,0.3\n')
        self.whole(*some)
        self.go('--time', '0.1', *some)
        self.go('--resume', *some)
        self.same('whole.h5part', 'a.h5part')
        os.remove(self.path('heights.csv'))
        self.assertIn('heights.csv: No such file or directory: ', self.go('--resume', *some, code=2))

    def test_a_table_that_is_gone_is_told(self):
        """Rows from there on, and a line that says so."""
        self.go('--time', '0.1')
        said = self.go('--resume', '--forces', 'a.csv')
        self.assertIn('a.csv: there is no such table to go on with; it begins at t = 0.1 s', said)
        rows = self.read('a.csv').decode().splitlines()
        self.assertGreater(float(rows[1].split(',')[0]), 0.1)

    def test_one_table_of_forces_has_one_writer(self):
        """From its first moment: a second run is refused, the table of the first stays whole."""
        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', EVERY, '--quiet',
                             '--forces', 'a.csv')
        self.wait_for(lambda: os.path.exists(self.path('a.csv')), process)
        said = self.go('--forces', 'a.csv', name='b.h5part', code=1)
        self.assertIn('a.csv: is being written by another slosh; wait for its end, or name another file', said)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        times = [float(row.split(',')[0]) for row in self.read('a.csv').decode().splitlines()[1:]]
        self.assertEqual(times, sorted(set(times)))
        self.go('--forces', 'a.csv', name='b.h5part')

    def test_forces_that_are_not_to_be_had(self):
        said = self.go('--forces', 'a.csv', '--backend', 'fragment', code=2)
        self.assertIn('backend fragment sums no forces; use backend cpu or compute', said)
        self.go('--forces', 'none/a.csv', code=1)
        self.go('--forces', 'a.h5part', code=2)
        self.assertEqual(os.listdir(self.path('.')), ['scene.yaml'])

    def test_killed(self):
        """Early and late, and once more in what went on; other moments: tests/long/test_kills.py."""
        self.whole()
        for threads, size in (('1', 1), ('2', 600000)):
            self.assertEqual(self.stopped_run(signal.SIGKILL, self.has('a.h5part', size), '--resume', '--threads', threads), -signal.SIGKILL)
            self.assertGreater(len(whole_steps(self.path('a.h5part'))), 0)
            shutil.copy(self.path('a.h5part'), self.path('b.h5part'))
            self.go('--resume', name='b.h5part')
            self.same('whole.h5part', 'b.h5part')

    def test_interrupted(self):
        self.whole()
        self.assertEqual(self.stopped_run(signal.SIGINT, self.has('a.h5part')), 130)
        self.go('--resume')
        self.same('whole.h5part', 'a.h5part')

    def test_one_writer_at_a_time(self):
        """A second one is refused at once, by whatever name and command; readers are not, h5py with its own locks neither."""
        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', EVERY, '--quiet')
        self.wait_for(lambda: os.path.exists(self.path('a.h5part')), process)
        os.symlink('a.h5part', self.path('b.h5part'))
        os.link(self.path('a.h5part'), self.path('c.h5part'))
        text = ''.join(f'| {line}\n' for line in SCENE.splitlines())
        self.write('a.rec', f'slosh recording 1\nprogram 0.1\nscene scene.yaml\ntext\n{text}commands\nend 9 {"0" * 16}\n')
        more = ('--time', '100000', '--quiet')
        for command_ in (('run', 'scene.yaml', '-o', 'a.h5part', '--resume', *more),
                         ('run', 'scene.yaml', '-o', 'a.h5part', *more),
                         ('run', 'scene.yaml', '-o', 'b.h5part', *more),
                         ('run', 'scene.yaml', '-o', 'c.h5part', '--resume', *more),
                         ('replay', 'a.rec', '-o', 'a.h5part', '--quiet')):
            code, said = self.slosh(*command_)
            self.assertEqual(code, 1, said)
            self.assertIn(command_[3] + ': is being written by another slosh; wait for its end, or name another file\n',
                          said)
        self.assertEqual(sorted(self.entries()), ['a.h5part', 'a.rec', 'b.h5part', 'c.h5part'])
        for _ in range(200):  # in between two of its writes
            with contextlib.suppress(OSError, KeyError, RuntimeError), h5py.File(self.path('a.h5part'), 'r') as file:
                self.assertGreater(len(file), 0)
                break
        else:
            self.fail('cannot be read while it is being written')
        process.kill()
        process.wait()
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 0)
        self.go('--resume', '--time', '0.001')

    def test_longer_and_anew(self):
        self.whole()
        self.go('--resume')  # without a file: from the start
        self.same('whole.h5part', 'a.h5part')
        before = self.read('a.h5part')
        self.go('--resume')  # finished
        for time in ('0.1', TIME):
            done = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', time, '--every', EVERY, '--resume')
            self.assertEqual(done, (0, f'a.h5part: has 51 snapshots to 0.2 s, and --time {time} s asks for no more: '
                                       'nothing is added\n'))
        self.assertEqual(self.read('a.h5part'), before)
        code, said = self.slosh('run', 'scene.yaml', '-o', 'b.h5part', '--time', '0.1', '--every', EVERY, '--quiet')
        self.assertEqual(code, 0, said)
        code, said = self.slosh('run', 'scene.yaml', '-o', 'b.h5part', '--time', TIME, '--every', EVERY, '--resume',
                                '--json', 'out.json')
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r'b\.h5part: goes on from 0\.1 s, behind 26 snapshots\n')
        self.same('whole.h5part', 'b.h5part')

    def test_wcsph_carries_its_density(self):
        wcsph = ('--method', 'wcsph', '--set', 'solver.delta_sph=0.1')
        self.go(*wcsph, name='whole.h5part')
        self.go('--time', '0.1', *wcsph, name='b.h5part')
        self.go('--resume', *wcsph, name='b.h5part')
        self.same('whole.h5part', 'b.h5part')
        with h5py.File(self.path('whole.h5part')) as one, h5py.File(self.path('b.h5part')) as other:
            last = f'Step#{len(one) - 1}'
            values = [sorted(zip(f[last]['id'][:], f[last]['compression'][:])) for f in (one, other)]
            self.assertEqual(*values)
            self.assertGreater(len(set(c for _, c in values[0])), 10)

    def test_places_in_a_wide_box(self):
        """What rounding leaves of them is in the file; a file of before has none, and goes on too."""
        wide = ('run', 'dam_break_2d', '--set', 'box.size=[4, 0.9]', '--particles', '300', '--every', '0.02', '--quiet')
        self.assertEqual(self.slosh(*wide, '-o', 'whole.h5part', '--time', '0.06')[0], 0)
        self.assertEqual(self.slosh(*wide, '-o', 'b.h5part', '--time', '0.02')[0], 0)
        shutil.copy(self.path('b.h5part'), self.path('before.h5part'))
        self.assertEqual(self.slosh(*wide, '-o', 'b.h5part', '--time', '0.06', '--resume')[0], 0)
        self.same('whole.h5part', 'b.h5part')
        with h5py.File(self.path('before.h5part'), 'r+') as file:
            for step in file.values():
                for k in range(3):
                    del step[f'remainder_{k}']
        self.assertEqual(self.slosh(*wide, '-o', 'before.h5part', '--time', '0.06', '--resume')[0], 0)
        with h5py.File(self.path('before.h5part')) as file:
            self.assertTrue((file['Step#3']['remainder_0'][:] != 0).any())

    def test_what_comes_and_goes(self):
        """Emitters, a drain, a moving solid and a moving box; the first state is empty."""
        self.write('scene.yaml', FLOW)
        more = '--time', '0.4', '--every', '0.016'
        whole = self.whole(*more)
        with h5py.File(self.path('whole.h5part')) as file:
            counts = [len(file[f'Step#{i}']['id']) for i in range(whole)]
            born = [file[f'Step#{i}']['born'][()] for i in range(whole)]
            times = [float(file[f'Step#{i}'].attrs['TimeValue']) for i in range(whole)]
        self.assertTrue(all(0 <= b.min() and b.max() <= t + 1e-6 for b, t in zip(born, times) if len(b)))
        self.assertGreater(len(set(born[-1])), 2)
        self.assertEqual(counts[0], 0)
        self.assertGreater(max(counts), counts[-1])
        for stop in ('0', '0.096', '0.304'):
            self.go(*more, '--time', stop, name='b.h5part')
            self.go('--resume', *more, name='b.h5part')
            self.same('whole.h5part', 'b.h5part')
            os.remove(self.path('b.h5part'))

    def test_another_scene_is_refused(self):
        self.go()
        before = self.read('a.h5part')
        said = self.go('--resume', '--set', 'solver.sound_speed=16', code=2)
        self.assertIn("a.h5part: was made with 'solver.sound_speed = 15 m/s', and this is 'solver.sound_speed = 16 m/s'; "
                      'resume with the same scene and settings, or name another file', said)
        self.assertEqual(self.read('a.h5part'), before)
        self.go('--resume', '--set', 'view.color_by=density', '--threads', '1')
        self.go('--resume', '--set', 'fluids[0].color=[1, 0, 0]', '--set', 'title=another')
        self.write('b.h5part', b'no snapshots')
        said = self.go('--resume', code=2, name='b.h5part')
        self.assertIn('b.h5part: is no file of snapshots', said)
        self.assertEqual(self.read('b.h5part'), b'no snapshots')

    def test_all_of_a_long_setting_is_compared(self):
        rows = [[k, round(k + 0.1, 1)] for k in range(16)]
        self.go('--set', f'fluids[0].viscosity={rows}')
        before = self.read('a.h5part')
        other = rows[:-1] + [[15, 15.2]]
        said = self.go('--resume', '--set', f'fluids[0].viscosity={other}', code=2)
        self.assertRegex(said, r"a\.h5part: was made with 'fluids\[0\]\.viscosity = \.\.\..*\[15, 15\.1\]\] Pa s', and this is "
                               r"'fluids\[0\]\.viscosity = \.\.\..*\[15, 15\.2\]\] Pa s'; resume with the same scene")
        self.go('--resume', '--set', f'fluids[0].viscosity={rows[:-1]}', code=2)
        self.go('--resume', '--set', 'fluids[0].viscosity=1', code=2)
        self.assertEqual(self.read('a.h5part'), before)
        self.go('--resume', '--set', f'fluids[0].viscosity={rows}')

    def test_steps_with_a_gap_are_refused(self):
        """Said when the file is opened, not when a name is there already, after who knows how many hours."""
        self.go('--time', '0.04')
        for change, said in ((lambda file: file.pop('Step#3'), "Step#3 is missing or not whole, but there are 7 behind it, "
                                                               "such as 'Step#10'"),
                             (lambda file: file.move('Step#10', 'Step#12'), "Step#10 is missing or not whole, but there is "
                                                                            "'Step#12'"),
                             (lambda file: file.move('Step#10', 'Step#010'), "there is 'Step#010'"),
                             (lambda file: file['Step#5'].attrs.pop('complete'), 'Step#5 is missing or not whole')):
            shutil.copy(self.path('a.h5part'), self.path('b.h5part'))
            with h5py.File(self.path('b.h5part'), 'r+') as file:
                change(file)
            before = self.read('b.h5part')
            answer = self.go('--resume', name='b.h5part', code=2)
            self.assertIn('b.h5part: ', answer)
            self.assertIn(said, answer)
            self.assertIn('; give the steps names without a gap, remove those behind it, or name another file\n', answer)
            self.assertEqual(self.read('b.h5part'), before)
            code, answer = self.slosh('export', 'b.h5part', '-o', 'b.vtp', '--quiet')
            self.assertEqual(code, 0, answer)
            self.assertIn('b.h5part: warning: ', answer)
            self.assertIn(said, answer)
            self.assertRegex(answer, r'; only the \d+ before it can be exported\n')

    MARK = 43  # doubles of EnergyMark (sim/state.h)
    BODIES = 16 * 25  # of the solids that float (sim/state.h)
    LAST = MARK + 11 + BODIES  # with what stands behind it, the last of the restart's numbers

    def test_a_file_whose_energy_was_watched_in_another_way(self):
        """Four of the mark's numbers are in it: they are left out, and the watch begins anew."""
        steps = self.whole()
        shutil.copy(self.path('whole.h5part'), self.path('a.h5part'))
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for k in range(steps // 2, steps):
                del file[f'Step#{k}']
            last = file[f'Step#{steps // 2 - 1}']
            whole = last.attrs['restart']
            numbers = whole[:4 - self.LAST]
            del last.attrs['restart']
            last.attrs['restart'] = numbers
        self.go('--resume')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            last = file[f'Step#{steps // 2 - 1}']
            last.attrs['restart'] = whole
        self.same('whole.h5part', 'a.h5part', self.LAST)

    def test_other_particles_are_refused(self):
        self.go()
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            last = file[f'Step#{len(file) - 1}']
            last['id'][0] = last['id'][1]
        self.assertIn('the saved state is damaged', self.go('--resume', code=2))
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file[f'Step#{len(file) - 1}'].attrs['restart']
        self.assertIn('was made by a slosh that could not resume', self.go('--resume', code=2))


if __name__ == '__main__':
    command.main()
