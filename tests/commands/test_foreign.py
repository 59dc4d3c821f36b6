"""Particles of other programs: each form of each format gives the same particles, read by slosh export and render;
assumptions are said; wrong files are refused in one line."""
import base64
import json
import os
import struct
import subprocess
import zlib

import h5py
import numpy

import command
from command import CommandTest

SIDE, SPACING = 7, 0.05
grid = numpy.stack(numpy.meshgrid(*[numpy.arange(SIDE)] * 3, indexing='ij'), -1).reshape(-1, 3)
PLACE = (SPACING * grid + [3, 4, 5]).astype('f4')
VELOCITY = (PLACE[:, [2, 0, 1]] * [1, -2, 3]).astype('f4')
DENSITY = (1000 + 5 * PLACE[:, 1]).astype('f4')
ID = numpy.arange(len(PLACE), dtype='i8')[::-1] + 100
COLUMNS = {'Points': PLACE, 'Velocity': VELOCITY, 'rho': DENSITY, 'id': ID}
TYPES = {'float32': 'Float32', 'int64': 'Int64'}


def words(values):
    return ' '.join('%.9g' % value for value in values.ravel()).encode()


class Vtk:
    """A .vtp or .vtu as other writers make them."""
    def __init__(self, kind, form, wide=False, big=False):
        self.kind, self.form, self.size, self.end, self.appended = kind, form, 'Q' if wide else 'I', '>' if big else '<', b''
        self.attributes = ('header_type="UInt64" ' if wide else '') + f'byte_order="{"Big" if big else "Little"}Endian"' + (
            ' compressor="vtkZLibDataCompressor"' if 'zlib' in form else '')

    def parts(self, raw):
        """Head and data."""
        if 'zlib' not in self.form:
            return struct.pack(self.end + self.size, len(raw)), raw
        blocks = [raw[i:i + 1000] for i in range(0, len(raw), 1000)]
        packed = [zlib.compress(block) for block in blocks]
        last = len(blocks[-1]) % 1000
        return (struct.pack(f'{self.end}{3 + len(packed)}{self.size}', len(packed), 1000, last, *map(len, packed)), b''.join(packed))

    def array(self, name, values):
        width = 1 if values.ndim == 1 else values.shape[1]
        tag = f'<DataArray type="{TYPES[values.dtype.name]}" Name="{name}" NumberOfComponents="{width}" '.encode()
        if self.form == 'ascii':
            return tag + b'format="ascii">' + words(values) + b'</DataArray>'
        head, data = self.parts(values.astype(values.dtype.newbyteorder(self.end)).tobytes())
        text = base64.b64encode(head) + base64.b64encode(data) if 'zlib' in self.form else base64.b64encode(head + data)
        if 'appended' not in self.form:
            return tag + b'format="binary">\n' + text + b'\n<InformationKey name="R" location="L"><Value index="0">1</Value></InformationKey></DataArray>'
        self.appended += (text if 'base64' in self.form else head + data)
        return tag + b'format="appended" offset="%d"/>' % (len(self.appended) - len(text if 'base64' in self.form else head + data))

    def bytes(self, time=0.5, pieces=1):
        body = b''
        for part in numpy.array_split(numpy.arange(len(PLACE)), pieces):
            data = b''.join(self.array(name, values[part]) for name, values in COLUMNS.items() if name != 'Points')
            body += (b'<Piece NumberOfPoints="%d"><PointData>%s</PointData><CellData></CellData><Points>%s</Points></Piece>' %
                     (len(part), data, self.array('Points', PLACE[part])))
        out = (f'<?xml version="1.0"?>\n<VTKFile type="{self.kind}" version="1.0" {self.attributes}>\n<{self.kind}><FieldData>'
               f'<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{time}</DataArray></FieldData>').encode()
        out += body + f'</{self.kind}>'.encode()
        if self.appended:
            out += f'<AppendedData encoding="{"base64" if "base64" in self.form else "raw"}">\n_'.encode() + self.appended + b'\n</AppendedData>'
        return out + b'</VTKFile>\n'


def legacy(binary):
    def numbers(values):
        return (values.astype(values.dtype.newbyteorder('>')).tobytes() if binary else words(values)) + b'\n'
    count = len(PLACE)
    cells = numpy.stack([numpy.ones(count), numpy.arange(count)], 1).astype('i4')
    return (b'# vtk DataFile Version 3.0\n\n' + (b'BINARY' if binary else b'ASCII') + b'\nDATASET POLYDATA\nFIELD FieldData 1\n'
            b'TIME 1 1 double\n' + numbers(numpy.array([0.5])) + b'POINTS %d float\n' % count + numbers(PLACE) +
            b'VERTICES %d %d\n' % (count, 2 * count) + numbers(cells) + b'POINT_DATA %d\nSCALARS rho float 1\nLOOKUP_TABLE default\n' %
            count + numbers(DENSITY) + b'VECTORS Velocity float\n' + numbers(VELOCITY) + b'FIELD FieldData 1\nid 1 %d int\n' % count +
            numbers(ID.astype('i4')))


def table(head, between=',', point='.'):
    rows = [between.join(('%.9g' % value).replace('.', point) for value in row)
            for row in numpy.column_stack([PLACE, VELOCITY, DENSITY, ID])]
    return '\n'.join([head, *rows, '']).encode()


def ply(form):
    kind = numpy.dtype([(name, 'f4') for name in ('x', 'y', 'z', 'vx', 'vy', 'vz', 'rho')] + [('id', 'u4')])
    rows = numpy.array([(*p, *v, r, i) for p, v, r, i in zip(PLACE, VELOCITY, DENSITY, ID)], kind)
    head = f'ply\nformat {form} 1.0\ncomment time 0.5 s\nelement vertex {len(rows)}\n' + ''.join(
        f'property {"uint" if name == "id" else "float"} {name}\n' for name in kind.names) + 'end_header\n'
    if form == 'ascii':
        return head.encode() + b'\n'.join(words(numpy.array(list(row), float)) for row in rows)
    return head.encode() + rows.astype(kind.newbyteorder('>' if 'big' in form else '<')).tobytes()


class Foreign(CommandTest):
    def ok(self, *arguments):
        code, said = self.slosh(*arguments)
        self.assertEqual(code, 0, said)
        return said

    def pixels(self, name):
        raw = subprocess.run(['ffmpeg', '-v', 'error', '-i', name, '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'],
                             cwd=self.folder, capture_output=True, check=True).stdout
        return numpy.frombuffer(raw, 'u1').astype(int)

    def particles(self, name, *options, code=0):
        """What slosh export makes of the file; and what it says."""
        got, said = self.slosh('export', name, '-o', 'out.ply', '--quiet', *options)
        self.assertEqual(got, code, (name, said))
        if code:
            return None, said
        with open(self.path('out.ply'), 'rb') as file:
            content = file.read()
        head, rows = content.split(b'end_header\n', 1)
        kinds = {'float': 'f4', 'int': 'i4', 'uint': 'u4', 'uchar': 'u1'}
        lines = [line.split() for line in head.decode().splitlines() if line.startswith('property')]
        return numpy.frombuffer(rows, [(line[2], kinds[line[1]]) for line in lines]), said

    def check(self, name):
        rows, said = self.particles(name)
        place = numpy.stack([rows[axis] for axis in 'xyz'], 1)
        middle = PLACE.mean(0) - [0, (SIDE - 1) * SPACING / 2 + SPACING / 2, 0]
        spacing = float(said.split('spacing ')[1].split()[0])
        self.assertAlmostEqual(spacing, SPACING, delta=0.03 * SPACING)
        numpy.testing.assert_allclose(place, PLACE - middle, atol=0.02 * SPACING)
        numpy.testing.assert_allclose(numpy.stack([rows['v' + axis] for axis in 'xyz'], 1), VELOCITY, rtol=1e-6, err_msg=name)
        numpy.testing.assert_allclose(rows['density'], DENSITY, rtol=1e-6)
        numpy.testing.assert_array_equal(rows['id'], ID)
        self.assertIn('density at rest', said)

    def h5part(self, name='o.h5part', steps=3):
        with h5py.File(self.path(name), 'w') as file:
            for k in range(steps):
                step = file.create_group(f'Step#{k}')
                step.attrs['time'] = 0.25 * k
                for a, axis in enumerate('xyz'):
                    step[axis], step['v' + axis] = PLACE[:, a].astype('f8'), VELOCITY[:, a]
                step['rho'], step['id'], step['Temperature'] = DENSITY, ID, DENSITY

    def test_forms_of_vtk(self):
        for k, (kind, form, *more) in enumerate([
                ('PolyData', 'ascii'), ('PolyData', 'binary', True), ('UnstructuredGrid', 'binary zlib'), ('PolyData', 'appended raw'),
                ('UnstructuredGrid', 'appended raw zlib', True), ('PolyData', 'appended base64', False, True), ('PolyData', 'appended base64 zlib')]):
            name = f'a{k}.{"vtp" if kind == "PolyData" else "vtu"}'
            self.write(name, Vtk(kind, form, *more).bytes(pieces=1 + k % 3))
            self.check(name)
        for binary in (False, True):
            self.write('b.vtk', legacy(binary))
            self.check('b.vtk')

    def test_tables_and_ply(self):
        self.write('a.csv', table('x,y,z,vx,vy,vz,rho,id'))
        self.write('b.csv', b'# made by hand\n' + table('Pos.x [m];Pos.y [m];Pos.z [m];Vel.x [m/s];Vel.y [m/s];Vel.z [m/s];Rhop [kg/m^3];Idp', ';', ','))
        self.write('c.csv', b'\xef\xbb\xbf' + table('"Points:0","Points:1","Points:2","U:0","U:1","U:2","Density","ParticleIDs"').replace(b'\n', b'\r\n'))
        for form in ('ascii', 'binary_little_endian', 'binary_big_endian'):
            self.write(f'{form}.ply', ply(form))
        for name in ('a.csv', 'b.csv', 'c.csv', 'ascii.ply', 'binary_little_endian.ply', 'binary_big_endian.ply'):
            self.check(name)

    def test_hdf5(self):
        self.h5part()
        self.check('o.h5part')
        with h5py.File(self.path('snapshot.hdf5'), 'w') as file:
            file.create_group('Header').attrs['Time'] = 0.5
            gas = file.create_group('PartType0')
            gas['Coordinates'], gas['Velocities'], gas['Density'], gas['ParticleIDs'] = PLACE.astype('f8'), VELOCITY, DENSITY, ID
            gas['Masses'], gas['SmoothingLength'] = DENSITY * SPACING ** 3, numpy.full(len(PLACE), 0.06)
        self.check('snapshot.hdf5')
        said = self.particles('snapshot.hdf5')[1]
        self.assertIn('spacing 0.05 m, from mass and density; another: --set particles.spacing=', said)
        self.assertIn('support radius 2.4 spacings, twice the smoothing length', said)

    def test_series_and_times(self):
        for k in (2, 9, 10):
            self.write(f'part_{k}.vtp', Vtk('PolyData', 'binary').bytes(time=k / 10))
            self.write(f't_{k}.csv', table('x,y,z,vx,vy,vz,rho,id'))
        self.write('all.pvd', b'<VTKFile type="Collection"><Collection>' + b''.join(
            b'<DataSet timestep="%g" part="0" file="part_%d.vtp"/>' % (k / 4, k) for k in (2, 9, 10)) + b'</Collection></VTKFile>')
        self.h5part()
        for name, last in (('part_*.vtp', 1), ('all.pvd', 2.5), ('o.h5part', 0.5), ('t_*.csv', 2 / 30)):
            code, said = self.slosh('export', name, '-o', 'out.pvd')
            self.assertEqual(code, 0, said)
            self.assertIn(f'out.pvd: 3 snapshots up to t = {last:.4g} s', said)
            self.assertEqual('has no times that rise; a step each 1/30 s' in said, 'csv' in name)
        self.assertIn("part_2.vtp: is one of 3 numbered files; name them as 'part_*.vtp' to see all", self.particles('part_2.vtp')[1])

    def test_the_same_picture(self):
        """A run, and exports of it: the same picture to single steps of a colour, with what the exports do not say."""
        self.write('still.yaml', 'box: {size: [0.4, 0.3, 0.2]}\nparticles: {spacing: 0.02}\nview: {kind: spheres, color_by: pressure, '
                   'range: [0, 3000]}\nfluids: [{fill: [{block: {min: [-0.2, 0, -0.1], max: [0, 0.2, 0.1]}}]}]\n')
        self.ok('run', 'still.yaml', '-o', 'a.h5part', '--time', '0.1', '--every', '0.1', '--quiet')
        pictures = []
        for out in ('a.vtp', 'a.ply', None):
            said = self.ok('export', 'a.h5part', '-o', out, '--quiet') if out else ''
            own = ['--set', 'particles.spacing=0.02', '--set', 'box.size=[0.4,0.3,0.2]', '--set', 'fluids[0].density=1000',
                   '--set', 'view.kind=spheres', '--set', 'view.color_by=pressure', '--set', 'view.range=[0,3000]'] if out else []
            said = self.ok('render', out or 'a.h5part', '-o', 'a.png', '--size', '160x120', '--quiet', *own)
            if out:
                self.assertNotIn('spacing', said.replace('spacings', ''))
            pictures.append(self.pixels('a.png'))
        for picture in pictures[:2]:
            self.assertLessEqual(abs(picture - pictures[2]).max(), 2)

    def test_other_columns(self):
        """Numbers of any name are scalars: the picture of the same numbers as pressure; by name in each file of a series."""
        values = 100 * PLACE[:, 0] + PLACE[:, 2]
        pictures = []
        for head, color in ('x,y,z,press,skin', 'pressure'), ('x,y,z,heat,skin', 'column_1'), ('x,y,z,skin,heat', 'column_2'):
            rows = [[*place, *([value, 7] if head.endswith('skin') else [7, value])] for place, value in zip(PLACE, values)]
            for k in range(2):  # the second file has its columns in another order
                order = [0, 1, 2, 4, 3] if k else range(5)
                names = [head.split(',')[i] for i in order]
                self.write(f'a{k}.csv', ','.join(names) + '\n' + ''.join(','.join('%.9g' % row[i] for i in order) + '\n' for row in rows))
            said = self.ok('render', 'a*.csv', '-o', 'a.png', '--size', '160x120', '--quiet', '--set', f'view.color_by={color}', '--set',
                           'view.legend=false', '--set', 'view.kind=spheres')
            pictures.append(self.pixels('a.png'))
            self.assertIn("further scalars: 'skin' is column_1\n" if color == 'pressure' else f"'heat' is {color}", said)
        self.assertGreater(numpy.ptp(pictures[0].reshape(-1, 3) @ [1, -1, 0]), 100)
        numpy.testing.assert_array_equal(pictures[0], pictures[1])
        numpy.testing.assert_array_equal(pictures[0], pictures[2])
        code, said = self.slosh('render', 'a*.csv', '-o', 'a.png', '--set', 'view.color_by=column_3')
        self.assertEqual(code, 2)
        self.assertIn('has no column_3 to colour by', said)
        code, said = self.slosh('render', 'dam_break', '-o', 'a.png', '--set', 'view.color_by=column_1')
        self.assertEqual(code, 2)
        self.assertIn('column_1 is of files of other programs', said)

    def test_what_is_set(self):
        """Up along z; a plane; a setting of the solver is refused."""
        self.write('a.csv', table('x,y,z,vx,vy,vz,rho,id'))
        self.ok('render', 'a.csv', '-o', 'a.png', '--size', '64x48', '--quiet', '--set', 'gravity=[0,0,-9.81]', '--set', 'view.kind=slice',
                '--set', 'view.color_by=speed')
        draw = ['render', 'a.csv', '-o', 'a.png', '--size', '64x48', '--quiet', '--set']
        self.assertIn('support radius 2.1 spacings, as slosh\'s own by default: particles.support must be 1.5 to 4',
                      self.ok(*draw, 'particles.support=9'))
        self.assertNotIn('support radius', self.ok(*draw, 'particles.support=3'))
        code, said = self.slosh('render', 'a.csv', '-o', 'a.png', '--set', 'solver.method=pbf')
        self.assertEqual(code, 2)
        self.assertIn('makes no sense for a.csv: nothing is simulated', said)
        code, said = self.slosh('render', 'a.csv', '-o', 'a.png', '--set', 'gravity=[0,down,0]')
        self.assertEqual((code, said), (2, 'a.csv: --set gravity=[0,down,0] is no such number; write one such as --set gravity=[1,1,1]\n'))
        lines = self.read('a.csv').decode().splitlines()
        self.write('flat.csv', '\n'.join(['x,z'] + [','.join(line.split(',')[:3:2]) for line in lines[1:8 * SIDE]]) + '\n')
        said = self.particles('flat.csv')[1]
        self.assertIn('flat.csv: z is up, as all particles lie in a plane with it', said)

    def test_info(self):
        """Two fluids, places alone: what is in the file, and another colour than that of the speed."""
        fluid = (PLACE[:, 0] > PLACE[:, 0].mean()) * 3
        self.write('two.csv', 'x,y,z,rho,phase\n' + ''.join(
            '%g,%g,%g,%g,%d\n' % (*place, 900 if kind else 1000, kind) for place, kind in zip(PLACE, fluid)))
        self.ok('info', 'two.csv', '--json', 'a.json', '--quiet')
        found = json.loads(self.read('a.json'))
        self.assertEqual([found[key] for key in ('file', 'foreign', 'steps', 'particles', 'fluids', 'scalars')],
                         ['two.csv', True, 1, len(PLACE), 4, ['density', 'compression', 'fluid', 'id']])
        self.assertAlmostEqual(found['spacing'], SPACING, delta=0.02 * SPACING)
        self.assertTrue(any('density at rest 1000, 1000, 1000, 900 kg/m3' in line for line in found['notes']), found['notes'])
        self.assertIn('has no speed to colour by', self.ok('render', 'two.csv', '-o', 'a.png', '--size', '64x48', '--quiet'))
        code, said = self.slosh('info', 'two.csv', '--save', 'a.yaml')
        self.assertEqual((code, said), (2, '--save makes no sense for two.csv: the file is no scene\n'))

    def test_refused(self):
        """One line each."""
        whole = Vtk('PolyData', 'binary').bytes()
        raw = Vtk('PolyData', 'appended raw').bytes()
        for name, content, words_ in [
                ('cut.vtp', whole[:len(whole) // 2], 'is no whole XML'), ('cut.vtu', raw[:len(raw) // 2], 'is cut, or has another length'),
                ('huge.vtp', whole.replace(b'NumberOfPoints="343"', b'NumberOfPoints="1000000000"'), 'claims more points than its bytes can hold'),
                ('image.vtp', whole.replace(b'type="PolyData"', b'type="ImageData"'), 'has no points of particles'),
                ('lz.vtp', whole.replace(b'byte_order', b'compressor="vtkLZ4DataCompressor" byte_order'), 'by another means than zlib'),
                ('huge.vtk', legacy(True).replace(b'POINTS 343', b'POINTS 1000000000'), 'ends before its points do'),
                ('grid.vtk', legacy(True).replace(b'POLYDATA', b'STRUCTURED_POINTS'), 'has no points of particles'),
                ('empty.csv', b'', 'is empty'), ('binary.csv', bytes(100), 'is no text'),
                ('word.csv', b'x,y,z\n0,0,0\n1,one,0\n', "word.csv:3: 'one' is no number, in the column 'y'; write one such as 0.25"),
                ('short.csv', b'x,y,z\n0,0\n', 'short.csv:2: has fewer cells'), ('none.csv', b'a,b\n1,2\n', 'has no places of particles'),
                ('head.csv', b'x,y,z\n', 'has no particle with a place'), ('nan.csv', b'x,y,z\nnan,0,0\n', 'has no particle with a place'),
                ('one.csv', b'x,y,z\n0,0,0\n', 'its spacing cannot be found from its 1 particle; say --set particles.spacing=0.01'),
                ('cut.ply', ply('binary_little_endian')[:900], 'the file ends before its points do'),
                ('none.pvd', b'<VTKFile><Collection></Collection></VTKFile>', 'lists no files'),
                ('lost.pvd', b'<VTKFile><Collection><DataSet timestep="0" file="lost.vtp"/></Collection></VTKFile>', 'lost.vtp: cannot be read')]:
            self.write(name, content)
            said = self.particles(name, code=2)[1]
            self.assertIn(words_, said)
            self.assertEqual(said.count('\n'), 1, said)
        with h5py.File(self.path('huge.h5part'), 'w') as file:
            for axis in 'xyz':
                file.create_dataset('Step#0/' + axis, (10**9,), 'f4', chunks=(1000,))
        said = self.particles('huge.h5part', code=2)[1]
        self.assertEqual(said, "huge.h5part: 'x' claims 1000000000 particles that are not in it\n")
        os.mkdir(self.path('folder.vtp'))
        self.assertIn('folder.vtp: is a folder; name a file in it', self.particles('folder.vtp', code=2)[1])
        self.assertIn('no_*.csv: no file matches', self.particles('no_*.csv', code=2)[1])
        code, said = self.slosh('render', 'cut.vtp', '-o', 'a.png')
        self.assertEqual(code, 2)
        self.assertEqual(said.count('\n'), 1, said)


if __name__ == '__main__':
    command.main()
