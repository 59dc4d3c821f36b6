"""The packages of cpack: what is in which, what each asks for, lintian's word, and that each installs and removes cleanly."""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../commands'))
import command  # noqa: E402

NAMES = ['libslosh-dev', 'libslosh1', 'python3-slosh', 'slosh']
# What a package outside of Debian does without: the changelog is the history of the repository, and the authors have no address.
NOT_ASKED = 'no-changelog,malformed-contact'


def output(*words, **others):
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **others)
    assert done.returncode == 0, f'{words}: {done.stdout}'
    return done.stdout


@unittest.skipUnless(shutil.which('dpkg-shlibdeps') and shutil.which('file'), 'dpkg-dev or file is not installed')
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='slosh-test-')
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        build = os.path.dirname(command.PROGRAM)
        output('cpack', '-G', 'DEB', '--config', f'{build}/CPackConfig.cmake', '-B', cls.folder, cwd=build)
        cls.files = {os.path.basename(path).split('_')[0]: path for path in sorted(glob.glob(f'{cls.folder}/*.deb'))}

    def field(self, name, field):
        return output('dpkg-deb', '-f', self.files[name], field).strip()

    def test_what_is_in_which(self):
        self.assertEqual(sorted(self.files), NAMES)
        found = {name: output('dpkg-deb', '-c', path) for name, path in self.files.items()}
        for name, path in [('slosh', './usr/bin/slosh'), ('slosh', './usr/share/slosh/scenes/dam_break.yaml'), ('libslosh1', 'libslosh.so.1.0'),
                           ('libslosh-dev', './usr/include/slosh/world.h'), ('libslosh-dev', 'libslosh.so '), ('libslosh-dev', 'slosh.pc'),
                           ('python3-slosh', './usr/lib/python3/dist-packages/slosh/__init__.py')]:
            self.assertIn(path, found[name])
            self.assertEqual([other for other in NAMES if other != name and path in found[other]], [], path)

    def test_what_each_asks_for(self):
        for name, needs in [('slosh', ['libc6', 'libglfw3', 'ffmpeg']), ('libslosh1', ['libc6', 'libgomp1', 'libfyaml0']),
                            ('libslosh-dev', ['libslosh1 (=']), ('python3-slosh', ['libslosh1', 'python3-numpy'])]:
            for need in needs:
                self.assertIn(need, self.field(name, 'Depends'), name)
        self.assertNotIn('glfw', self.field('libslosh1', 'Depends'))  # no window
        self.assertEqual(self.field('python3-slosh', 'Architecture'), 'all')

    def test_lintian(self):
        if not shutil.which('lintian'):
            self.skipTest('lintian is not installed')
        done = subprocess.run(['lintian', '--allow-root', '--fail-on', 'error', '--suppress-tags', NOT_ASKED, *self.files.values()],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual([line for line in done.stdout.split('\n') if line.startswith('E:')], [])

    @unittest.skipUnless(os.geteuid() == 0, 'dpkg needs root')
    def test_each_installs_and_removes(self):
        """Into a folder as root of the system; what the packages ask for is the machine's matter."""
        root = f'{self.folder}/root'
        os.makedirs(f'{root}/var/lib/dpkg/info')
        os.makedirs(f'{root}/var/lib/dpkg/updates')
        for name in ('status', 'available'):
            pathlib.Path(root, 'var/lib/dpkg', name).touch()
        dpkg = ['dpkg', f'--root={root}', '--force-script-chrootless', '--force-depends', f'--log={self.folder}/log']
        output(*dpkg, '-i', *self.files.values())
        self.assertTrue(os.path.exists(f'{root}/usr/lib/libslosh.so'))  # the link leads to the other package's file
        output(*dpkg, '--purge', *self.files)
        left = [os.path.join(folder, name) for folder, _, files in os.walk(root) for name in files if '/var/lib/dpkg' not in folder]
        self.assertEqual(left, [])
        self.assertEqual(re.findall(r'^Package: .*', pathlib.Path(root, 'var/lib/dpkg/status').read_text(), re.M), [])


if __name__ == '__main__':
    command.main()
