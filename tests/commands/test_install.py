"""The installed program: all that belongs to it is under the prefix, wherever that lies, and nothing beside the sources is needed."""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import command
from command import CommandTest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

INSTALLED = ['bin/slosh', 'share/man/man1/slosh.1.gz', 'share/bash-completion/completions/slosh',
             'share/zsh/vendor-completions/_slosh', 'share/metainfo/slosh.metainfo.xml', 'lib/udev/rules.d/70-slosh.rules', 'share/applications/slosh.desktop',
             'share/icons/hicolor/256x256/apps/slosh.png', 'share/mime/packages/slosh.xml',
             'share/doc/slosh/copyright', 'share/doc/slosh/docs/labbook/validation.json', 'share/slosh/scenes/dam_break.yaml',
             'share/slosh/scenes/cases/couette.yaml',
             'share/slosh/scenes/reference/paper003-spheres.csv']


def install(component, to, prefix='/usr'):
    """What is installed lies under the folder `to` with that prefix, and then elsewhere: (exit code, what was said)."""
    done = subprocess.run(['cmake', '--install', os.path.dirname(command.PROGRAM), '--prefix', prefix, '--component', component],
                          env={**os.environ, 'DESTDIR': to}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


class InstalledTest(CommandTest):
    """Installed once for all tests, to DESTDIR, and moved then."""

    @classmethod
    def setUpClass(cls):
        cls.top = tempfile.mkdtemp(prefix='slosh-test-')
        cls.addClassCleanup(shutil.rmtree, cls.top)
        code, said = install('program', f'{cls.top}/there')
        assert code == 0, said
        cls.prefix = f'{cls.top}/moved'
        os.rename(f'{cls.top}/there/usr', cls.prefix)
        hides = subprocess.run(['unshare', '-rm', 'mount', '-t', 'tmpfs', 'none', ROOT], stderr=subprocess.DEVNULL, check=False)
        cls.hides = hides.returncode == 0  # a kernel that lets users mount

    def run_installed(self, *arguments, **env):
        """Where the sources are gone: (exit code, standard output, standard error)."""
        program = [f'{self.prefix}/bin/slosh', *arguments]
        if self.hides:
            program = ['unshare', '-rm', 'sh', '-c', f'mount -t tmpfs none "{ROOT}" && exec "$@"', 'sh', *program]
        for _ in range(3):  # command.py says why
            done = subprocess.run(program, cwd=self.folder, env={**os.environ, 'XDG_CONFIG_HOME': self.path('config'), **env},
                                  capture_output=True, text=True, timeout=command.PATIENCE, check=False)
            if 'LeakSanitizer has encountered a fatal error' not in done.stderr:
                break
        return done.returncode, done.stdout, done.stderr

    def said(self, *arguments, **env):
        code, out, said = self.run_installed(*arguments, **env)
        self.assertEqual(code, 0, said)
        return out


class Installed(InstalledTest):
    def test_what_is_installed(self):
        self.assertEqual([name for name in INSTALLED if not os.path.isfile(f'{self.prefix}/{name}')], [])
        names = {name.removesuffix('.yaml') for name in os.listdir(f'{ROOT}/scenes') if name.endswith('.yaml')}
        listed = re.split(r'[,\s]+', self.said('help').split('comes with slosh:\n')[1].strip())
        self.assertEqual(set(listed), names)

    def test_what_the_package_asks_for(self):
        """What the program runs or opens by name is also what tools/setup installs."""
        with open(f'{ROOT}/tools/package/deb.cmake') as package, open(f'{ROOT}/tools/packages.txt') as packages:
            asked = re.search(r'PROGRAM_PACKAGE_DEPENDS\s+"([^"]+)"', package.read())[1]
            there = packages.read().split('\n[tests]')[0].split()
        self.assertIn('ffmpeg', asked)
        self.assertEqual([name for name in asked.split(', ') if name.split(' | ')[0] not in there], [])

    def test_it_draws_and_measures(self):
        self.said('render', 'dam_break', '-o', 'a.png', '--time', '0', '--size', '16x16', '--quiet')
        self.said('run', 'cases/couette', '-o', 'a.h5part', '--time', '0', '--quiet')
        self.said('bench', '--table', 'paper003-spheres', '--backend', 'cpu', '--view', 'spheres', '--size', '16x16', '--threads', '1',
                  '--frames', '1')  # its figures lie in scenes/reference

    def test_scenes_of_ones_own(self):
        os.makedirs(self.path('config/slosh/scenes'))
        for name in ('config/slosh/scenes/among.yaml', 'config/slosh/beside.yaml', 'here.yaml', 'config/slosh/here.yaml'):
            self.write(name, command.SCENE.replace('A small tank', name))
        for name, path in [('among', 'config/slosh/scenes/among.yaml'), ('beside', 'config/slosh/beside.yaml'),
                           ('here', 'config/slosh/here.yaml'), ('here.yaml', 'here.yaml')]:
            self.assertIn(path, self.said('info', name))
        os.remove(self.path('config/slosh/here.yaml'))
        self.assertIn('here.yaml', self.said('info', 'here'))
        code, _, said = self.run_installed('info', 'amon')
        self.assertEqual((code, said), (2, f'amon: no such file, neither here nor in {self.prefix}/share/slosh/scenes nor in '
                                           f'{self.path("config/slosh")}; did you mean \'among\'?\n'))

    def test_a_program_alone(self):
        """It looks where its user may have scenes, and no more beside the sources."""
        os.link(f'{self.prefix}/bin/slosh', self.path('alone'))
        done = subprocess.run([self.path('alone'), 'info', 'drop'], cwd=self.folder, capture_output=True, text=True, check=False,
                              env={**os.environ, 'XDG_CONFIG_HOME': '/nowhere'})
        self.assertEqual((done.returncode, done.stderr),
                         (2, 'drop: no such file, neither here nor in /nowhere/slosh; name a scene file\n'))

    def test_what_allows_a_device(self):
        self.write('plugged', '046d c626 usb /dev/stand-in1 denied 00\n')
        module = shutil.copy(f'{os.path.dirname(command.PROGRAM)}/tests/hidapi_stand_in.so', self.folder)
        out = self.said('devices', LD_PRELOAD=module, SLOSH_TEST_HID=self.path('plugged'))
        self.assertIn(f'`sudo cp \'{self.prefix}/lib/udev/rules.d/70-slosh.rules\' /etc/udev/rules.d && sudo udevadm', out)

    def test_the_desktop_knows_its_files(self):
        """What the entries of the menu open are types that are there, named as the program writes them."""
        types = {node.get('type'): [glob.get('pattern') for glob in node if glob.tag.endswith('glob')] for node in
                 xml.etree.ElementTree.parse(f'{self.prefix}/share/mime/packages/slosh.xml').getroot()}
        self.assertIn('*.h5part', types['application/x-slosh-snapshots'])
        with open(f'{self.prefix}/share/applications/slosh.desktop') as file:
            entry = dict(re.findall(r'^(\w+)=(.*)$', file.read(), re.M))
        self.assertIn(entry['Exec'].split()[1], self.said('help'))
        self.assertEqual([name for name in entry['MimeType'].strip(';').split(';') if name not in types], [])


class Listed(InstalledTest):
    """The manual page and the completion of the shells have each option that help lists, and what it may be."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.commands = re.findall(r'^  slosh (\w+)', cls.printed(), re.M)
        cls.help = {name: dict(re.findall(r'^  (--?[a-z-]+) +(.*)$', cls.printed(name), re.M)) for name in cls.commands
                    if name != 'help'}
        assert '--size' in cls.help['render']

    @classmethod
    def printed(cls, *topic):
        return subprocess.run([f'{cls.prefix}/bin/slosh', 'help', *topic], capture_output=True, text=True, check=True).stdout

    def complete_bash(self, *words):
        """What bash offers for the last word."""
        script = 'source "$0"; COMP_WORDS=(slosh "$@"); COMP_CWORD=$#; _slosh; printf "%s\\n" "${COMPREPLY[@]}"'
        return self.offered('bash', '-c', script, f'{self.prefix}/share/bash-completion/completions/slosh', *words)

    def complete_zsh(self, *words):
        """What zsh offers, with a list of words in place of its own that shows them."""
        script = """zmodload zsh/parameter
        compadd() { while [[ $1 != -- ]] shift; shift; print -l -- ${(M)@:#$PREFIX*}; [[ -n ${(M)@:#$PREFIX*} ]] }
        _files() {}
        file=$0 words=(slosh "$@") CURRENT=$(($# + 1)) PREFIX=${@[-1]}
        set --
        source $file"""
        return self.offered('zsh', '-f', '-c', script, f'{self.prefix}/share/zsh/vendor-completions/_slosh', *words)

    def offered(self, *words):
        done = subprocess.run(words, capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, '')
        return set(done.stdout.split())

    def test_the_manual_page(self):
        with gzip.open(f'{self.prefix}/share/man/man1/slosh.1.gz', 'rt') as file:
            page = re.sub(r'\\&|\\f[BIR]', '', file.read()).replace('\\-', '-')
        found = {}
        for part in page.split('\n.SH COMMANDS\n')[1].split('\n.SH ')[0].split('.SS slosh ')[1:]:
            found[part.split()[0]] = dict(re.findall(r'^\.TP\n(--?[a-z-]+).*\n(.*)$', part, re.M))
        self.assertEqual(set(found), set(self.commands))
        for name, options in self.help.items():
            self.assertEqual(set(found[name]), set(options), name)
            for option, words in options.items():
                self.assertIn(found[name][option], words)

    def test_the_manual_page_is_sound(self):
        if not shutil.which('groff'):
            self.skipTest('groff is not installed')
        done = subprocess.run(['groff', '-man', '-Tutf8', '-ww', '-rLL=2000n'], input=self.printed('man'), capture_output=True,
                              text=True, check=True)
        self.assertEqual(done.stderr, '')

    def test_completion(self):
        for complete in (self.complete_bash, self.complete_zsh):
            with self.subTest(shell=complete.__name__):
                self.assertGreaterEqual(complete(''), {*self.commands, 'dam_break', '--version'})
                for name, options in self.help.items():
                    self.assertEqual(complete(name, '-'), set(options), name)
                self.assertEqual(complete('dam_break', '-'), set(self.help['play']))
                self.assertEqual(complete('render', 'dam_b'), {'dam_break', 'dam_break_2d'})
                self.assertEqual(complete('run', 'drop', '--backend', ''), {'cpu', 'compute', 'fragment'})
                self.assertEqual(complete('bench', '--clock', 'f'), {'finish'})
                self.assertEqual(complete('run', 'drop', '--set', 'solver.step.d'), {'solver.step.dt='})
                self.assertEqual(complete('render', 'drop', '-o', ''), set())  # the shell then offers files
                self.assertEqual(complete('help', 'k'), {'keys'})
        self.assertEqual(self.complete_bash('run', 'drop', '--set', 'solver.step.dt', '=', ''), set())

    def test_what_software_centres_show(self):
        """Of what is checked only the identifier is let through: the authors have no domain to name it by."""
        done = subprocess.run(['appstreamcli', 'validate', '--no-net', '--pedantic', '--override=cid-desktopapp-is-not-rdns=info',
                               f'{self.prefix}/share/metainfo/slosh.metainfo.xml'], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Library(CommandTest):
    """The library without the program's sources: examples in C, C++ and Python against the installed tree, which has moved."""

    @classmethod
    def setUpClass(cls):
        cls.top = tempfile.mkdtemp(prefix='slosh-test-')
        cls.addClassCleanup(shutil.rmtree, cls.top)
        for component in ('program', 'runtime', 'library', 'python'):
            code, said = install(component, f'{cls.top}/there')
            assert code == 0, said
        cls.prefix = f'{cls.top}/moved'
        os.rename(f'{cls.top}/there/usr', cls.prefix)
        cls.example = f'{cls.prefix}/share/doc/libslosh-dev/examples'
        symbols = cls.output('nm', '-D', f'{cls.prefix}/lib/libslosh.so.1')
        if re.search(' (__)?[at]san', symbols):
            raise unittest.SkipTest('the library has a sanitizer in it, which its user would need too')

    @staticmethod
    def output(*words, **env):
        done = subprocess.run(words, env={**os.environ, **env}, capture_output=True, text=True, check=False, timeout=command.PATIENCE)
        assert done.returncode == 0, f'{words}: {done.stdout}{done.stderr}'
        return done.stdout

    def compile(self, compiler, source, name, *arguments):
        flags = self.output('pkg-config', '--cflags', '--libs', 'slosh', PKG_CONFIG_PATH=f'{self.prefix}/lib/pkgconfig').split()
        self.output(compiler, '-Wall', '-Wextra', '-Wpedantic', '-Werror', *arguments, source, '-o', self.path(name), *flags)

    def said(self, *words, **env):
        return self.output(*words, OMP_WAIT_POLICY='passive', LD_LIBRARY_PATH=f'{self.prefix}/lib', **env)

    def check_front(self, program):
        """The front runs, no faster than twice sqrt(g H) allows, and reaches the wall 1.6 m off."""
        rows = re.findall(r'^(\S+) s: (\S+) m$', self.said(program), re.M)
        times, fronts = [float(t) for t, _ in rows], [float(x) for _, x in rows]
        self.assertEqual(times, [0.1, 0.2, 0.3, 0.4, 0.5])
        self.assertEqual(fronts, sorted(fronts))
        self.assertTrue(all(0.4 < x < 0.4 + 2 * (9.81 * 0.8) ** 0.5 * t + 0.05 for t, x in zip(times, fronts)), fronts)
        self.assertGreater(fronts[-1], 1.3)

    def check_cup(self, program):
        """The water is shaken higher than it stood, 0.1 m, and stays in the cup."""
        top = float(re.fullmatch(r'the water came up to (\S+) m\n', self.said(program))[1])
        self.assertTrue(0.11 < top < 0.3, top)

    def test_by_pkg_config(self):
        self.compile('cc', f'{self.example}/front.c', 'front', '-std=c11')
        self.check_front(self.path('front'))
        self.compile('c++', f'{self.example}/cup.cpp', 'cup', '-std=c++11')
        self.check_cup(self.path('cup'))

    def test_by_cmake(self):
        self.output('cmake', '-G', 'Ninja', '-S', self.example, '-B', self.path('build'), f'-DCMAKE_PREFIX_PATH={self.prefix}')
        self.output('cmake', '--build', self.path('build'))
        self.check_front(self.path('build/front'))
        self.check_cup(self.path('build/cup'))

    def test_headers_stand_alone(self):
        """Each as the first, in C and in C++."""
        names = sorted(os.listdir(f'{self.prefix}/include/slosh'))
        self.assertEqual(names, ['mesh.h', 'picture.h', 'scene.h', 'state.h', 'world.h'])
        for name in [*names, None]:
            self.write(f'{names.index(name) if name else "all"}.c', ''.join(f'#include <slosh/{n}>\n' for n in ([name] if name else names)))
        files = [self.path(f'{k}.c') for k in range(len(names))]
        self.compile('cc', self.path('all.c'), 'all', '-std=c11', '-fsyntax-only', *files)
        self.compile('c++', self.path('all.c'), 'all', '-std=c++11', '-x', 'c++', '-fsyntax-only', *files)

    def test_no_other_names(self):
        """What the library exports stands in its headers, and the other way round."""
        folder = f'{self.prefix}/include/slosh'
        text = self.output('cat', *(f'{folder}/{name}' for name in os.listdir(folder)))
        declared = set(re.findall(r'\bSLOSH_API[^;(]*?\b(slosh_\w+)\(', text))
        symbols = self.output('nm', '-D', '--defined-only', '--format=just-symbols', f'{self.prefix}/lib/libslosh.so.1').split()
        self.assertIn('slosh_world_create', declared)
        self.assertEqual({name.split('@')[0] for name in symbols} - {'SLOSH_1'}, declared)
        header = self.output('readelf', '-d', f'{self.prefix}/lib/libslosh.so.1')
        self.assertIn('soname: [libslosh.so.1]', header)
        self.assertNotRegex(header, 'glfw|hidapi')  # a window and devices are the program's

    def test_the_api_stays(self):
        """Nothing that a program of an earlier day calls has gone or changed: each declaration of libslosh.so.1 to the letter.
        New ones are added to the list."""
        def declarations(text):
            text = re.sub(r'/\*.*?\*/', '', text, flags=re.S)
            found = re.findall(r'(?m)^SLOSH_API\s([^;]*;)', text) + re.findall(r'(?m)^((?:enum|typedef struct slosh_\w+) \{[^}]*\}[^;]*;)', text)
            return {re.sub(r'\s+', ' ', declaration).strip() for declaration in found}

        folder = f'{self.prefix}/include/slosh'
        there = set().union(*(declarations(pathlib.Path(folder, name).read_text()) for name in os.listdir(folder)))
        with open(f'{ROOT}/tests/library/api-1.txt') as file:
            listed = file.read().splitlines()
        self.assertGreater(len(listed), 60)
        self.assertEqual([line for line in listed if line not in there], [], 'has gone or changed')
        self.assertEqual(sorted(there - set(listed)), [], 'is new: add it to tests/library/api-1.txt')

    def test_the_module(self):
        """Python finds the installed library, and the library the installed scenes."""
        words = 'import slosh; print("dam_break" in slosh.scenes(), slosh.World("drop_2d", {"particles": 200}, tell=str).count > 100)'
        out = self.output('/usr/bin/python3', '-B', '-c', words, PYTHONPATH=f'{self.prefix}/lib/python3/dist-packages', OMP_WAIT_POLICY='passive')
        self.assertEqual(out, 'True True\n')


if __name__ == '__main__':
    command.main()
