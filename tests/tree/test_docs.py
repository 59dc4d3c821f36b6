"""READMEs are one page each; links, paths and test programs that READMEs and docs name are there."""
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINES_MAX = 120  # of a README
PICTURE_MAX = 300_000  # bytes
ROOMS = ('app', 'render', 'sim')  # their READMEs name every room
NUMBERS_MAX = 2  # of a page of the manual, in 100 words of prose: figures are in the lab book
SENTENCE_MAX = 17  # words, mean of a page of the manual
HEAD = 32  # lines of a page of the manual that have its picture and its first commands
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


def prose(text):
    """The page without made parts, code, tables, headings, quotes and pictures; a code span or a link is one word."""
    for what in (r'<!-- made: .*?<!-- end -->', r'^ *```.*?^ *```$', r'<!--.*?-->', r'^ *[|#>].*?$', r'!\[[^]]*\]\([^)]*\)'):
        text = re.sub(what, '', text, flags=re.S | re.M)
    return re.sub(r'^ *\d+\. ', '- ', re.sub(r'\[[^]]*\]\([^)]*\)', 'link', re.sub(r'`[^`]+`', 'code', text)), flags=re.M)


def reading(text):
    """Numbers in 100 words, and words of a sentence in the mean; a paragraph and an entry of a list end a sentence."""
    blocks = re.split(r'\n\s*\n|\n *[-*] ', '\n' + prose(text))
    sentences = [re.findall(r'\S*\w\S*', sentence) for block in blocks for sentence in re.split(r'(?<=[.!?])[*)]*\s+', block)]
    sentences = [words for words in sentences if words]
    count = sum(map(len, sentences))
    numbers = sum(len(re.findall(r'\d+(?:[.,]\d+)*', word)) for words in sentences for word in words)
    return 100 * numbers / max(count, 1), count / max(len(sentences), 1)


def headings(text):
    """Anchors of the page, as GitHub makes them."""
    lines = re.findall(r'^#+ (.*)$', re.sub(r'^ *```.*?^ *```$', '', text, flags=re.S | re.M), re.M)
    return {re.sub(r'[^\w -]', '', re.sub(r'\]\([^)]*\)', '', line).lower()).strip().replace(' ', '-') for line in lines}


def lost_anchors(page, text):
    links = re.findall(r'\]\(([^)\s]*)#([^)\s]+)\)', re.sub(r'^ *```.*?^ *```$', '', text, flags=re.S | re.M))
    targets = [((page.parent / path if path else page), anchor) for path, anchor in links if '://' not in path]
    return [f'{target.name}#{anchor}' for target, anchor in targets
            if target.suffix == '.md' and target.exists() and anchor not in headings(target.read_text())]


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

    def test_links_lead_to_headings(self):
        self.assertEqual([f'{page.relative_to(ROOT)}: {lost}' for page in PAGES for lost in lost_anchors(page, page.read_text())], [])
        self.assertEqual(lost_anchors(ROOT / 'README.md', '[a](docs/glossary.md#the-fluid) [b](docs/glossary.md#no)'), ['glossary.md#no'])

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

    def test_manual_has_few_numbers_and_short_sentences(self):
        pages = [page for page in PAGES if ROOT / 'docs/manual' in page.parents]
        self.assertGreater(len(pages), 20)
        wrong = []
        for page in pages:
            name = str(page.relative_to(ROOT / 'docs/manual'))
            numbers, words = reading(page.read_text())
            if numbers > NUMBERS_MAX or words > SENTENCE_MAX:
                wrong.append(f'{name}: {numbers:.2f} numbers in 100 words, {words:.1f} words a sentence')
        self.assertEqual(wrong, [])

    def test_manual_pages_begin_with_a_picture_and_lines_that_run(self):
        def begins(page):
            head = '\n'.join(page.read_text().split('\n')[:HEAD])
            return re.search(r'^!\[', head, re.M) and re.search(r'^```\n(?:(?!```).*\n){5,}?```$', head, re.M)
        self.assertEqual([str(page.relative_to(ROOT)) for page in PAGES if ROOT / 'docs/manual' in page.parents and not begins(page)], [])

    def test_reading_counts_prose_alone(self):
        text = ('# A 1\n\nOne two `3 4` [five 6](7.md). Four 8.5 words 9?\n\n| 10 | 11 |\n\n```\n12\n```\n'
                '1. six\n2. seven eight\n\n<!-- made: x -->\n13\n<!-- end -->\n')
        numbers, words = reading(text)
        self.assertAlmostEqual(numbers, 100 * 2 / 11)
        self.assertAlmostEqual(words, 11 / 4)

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

    def test_comments_name_files_that_are_there(self):
        """Of C and of shaders: a path below the root, or below shaders/ and include/; NAME stands for any name."""
        seen, wrong = 0, []
        for name in FILES:
            if not re.search(r'\.(?:c|h|cpp|glsl|comp|frag|vert|geom)$', name):
                continue
            for comment in re.findall(r'/\*[\s\S]*?\*/|(?<!:)//.*', (ROOT / name).read_text()):
                for path in re.findall(rf'(?<![\w./-])(?:app|docs|include|render|shaders|sim|slosh|tests|tools)/[\w./-]+\.{SOURCE}\b', comment):
                    seen += 1
                    if not re.search(r'[A-Z]{4}', path) and not stands(ROOT / name, path):
                        wrong.append(f'{name}: {path}')
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 100)

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
