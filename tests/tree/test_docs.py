"""READMEs are one page each; links, paths and test programs that READMEs and docs name are there."""
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINES_MAX = 120  # of a README
PICTURE_MAX = 300_000  # bytes
ROOMS = ('app', 'render', 'sim')  # their READMEs name every room
SOURCE = r'(?:c|h|cpp|py|glsl|comp|frag|vert|geom|rules|cmake)'


def tracked():
    listed = subprocess.run(['git', 'ls-files', '-co', '--exclude-standard'], cwd=ROOT, check=True, capture_output=True,
                            text=True).stdout.split('\n')
    return [name for name in listed if name and (ROOT / name).is_file()]


FILES = tracked()
NAMES = {pathlib.PurePosixPath(name).name for name in FILES}
PAGES = [ROOT / name for name in FILES if name.endswith('.md')]


def stands(page, name):
    """From the root, from the page's folder, or from where includes count; a bare name may be anywhere."""
    return any((base / name).exists() for base in (ROOT, page.parent, ROOT / 'shaders', ROOT / 'include')) or name in NAMES


def missing(page, text):
    """What the page names that is not there."""
    spans = re.findall(r'`((?!.*NAME)[^`\n]+)`', re.sub(r'^ *```.*?^ *```$', '', text, flags=re.S | re.M))
    paths = [span for span in spans if re.fullmatch(rf'[\w./-]+\.{SOURCE}', span)]
    folders = [span for span in spans if re.fullmatch(r'[\w./-]+/', span) and not span.startswith('build/')]
    tools = re.findall(r'(?<![\w/])tools/[a-z]\w*(?:\.py)?', text)
    links = [link.split('#')[0] for link in re.findall(r'\]\(([^)\s]+)\)', text) if '://' not in link]
    tests = [f'tests/{folder}/test_{name}.c' for folder, name in re.findall(r'\btest_([a-z]+) ([a-z]\w+)', text)
             if (ROOT / 'tests' / folder).is_dir()]
    return ([name for name in [*paths, *folders] if not stands(page, name)] +
            [name for name in [*tools, *tests] if not (ROOT / name).exists()] +
            [link for link in links if link and not (page.parent / link).exists()])


class Docs(unittest.TestCase):
    maxDiff = None

    def test_readmes_are_one_page(self):
        readmes = [page for page in PAGES if page.name == 'README.md']
        self.assertGreater(len(readmes), 8)
        self.assertEqual([str(page) for page in readmes if len(page.read_text().splitlines()) > LINES_MAX], [])

    def test_what_pages_name_is_there(self):
        self.assertEqual([f'{page.relative_to(ROOT)}: {name}' for page in PAGES for name in missing(page, page.read_text())], [])
        self.assertEqual(missing(ROOT / 'README.md', '`sim/no.c` `nowhere/` tools/nothing [a](no.md) `test_sim nosuch`'),
                         ['sim/no.c', 'nowhere/', 'tools/nothing', 'tests/sim/test_nosuch.c', 'no.md'])

    def test_pictures_are_small_and_have_their_command(self):
        """The name stands in a command of some page: with $x for what a loop puts there."""
        fenced = re.findall(r'^ *```(\w*)\n(.*?)^ *```$', '\n'.join(page.read_text() for page in PAGES), re.S | re.M)
        words = re.findall(r'[\w./$-]+', ' '.join(block for language, block in fenced if not language))
        patterns = [re.sub(r'\\\$\w+', '[^/]+', re.escape(pathlib.PurePosixPath(word).name.removesuffix('.png'))) for word in words]
        pictures = {(page.parent / link).resolve() for page in PAGES for link in re.findall(r'!\[[^]]*\]\(([^)]+)\)', page.read_text())}
        self.assertGreater(len(pictures), 20)
        self.assertEqual([str(path) for path in pictures if path.stat().st_size > PICTURE_MAX], [])
        self.assertEqual([str(path) for path in pictures
                          if not any(pattern[:3] == path.stem[:3] and re.fullmatch(pattern, path.stem) for pattern in patterns)], [])

    def test_sources_name_pages_that_are_there(self):
        seen, wrong = 0, []
        for name in FILES:
            if not re.search(rf'\.(?:{SOURCE}|yaml)$', name) or name.startswith('tests/tree/'):
                continue
            for page in re.findall(r'(?:[\w-]+/)+[\w-]+\.md', (ROOT / name).read_text()):
                seen += 1
                if not (ROOT / page).exists():
                    wrong.append(f'{name}: {page}')
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 3)

    def test_every_room_has_its_line(self):
        for floor in ROOMS:
            text = (ROOT / floor / 'README.md').read_text()
            rooms = {name.split('/')[1] for name in FILES if re.match(rf'{floor}/[^/]+/.*\.c$', name)}
            self.assertGreater(len(rooms), 4)
            self.assertEqual([room for room in sorted(rooms) if f'`{room}/`' not in text], [], floor)

    def test_every_page_is_led_to(self):
        """Each page of docs/ has a link from another page."""
        linked = {(page.parent / link.split('#')[0]).resolve() for page in PAGES
                  for link in re.findall(r'\]\(([^)\s]+)\)', page.read_text())}
        self.assertEqual([str(page) for page in PAGES if ROOT / 'docs' in page.parents and page not in linked], [])


if __name__ == '__main__':
    unittest.main()
