"""C and shaders share no number that has no name: bindings and locations of uniforms stand in headers that both include."""
import collections
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHADERS = ROOT / 'shaders'

NUMBER_IN_GLSL = re.compile(r'\bbinding\s*=\s*\d|\blocation\s*=\s*\d+\s*\)\s*uniform')
UNIFORM = r'glUniform\w+\(|glProgramUniform\w+\([^;(,]*,\s*'
BINDING = r'glBindTextureUnit\(|glBindTextures\(|glBindImageTexture\(|glBindBuffer\w+\(\w+_BUFFER,\s*'
NUMBER_IN_C = re.compile(rf'(?:{UNIFORM}|{BINDING})\d+,')
NAME = re.compile(r'^#define (\w+_(?:BLOCK|STORAGE|BUFFER|UNIT|IMAGE|AT))\s+(\d+)', re.M)


def texts(folder, endings):
    return {path: path.read_text() for path in sorted(folder.rglob('*'))
            if path.suffix in endings}


class Shaders(unittest.TestCase):
    def setUp(self):
        self.headers = texts(SHADERS, ('.h',))
        self.stages = texts(SHADERS, ('.glsl', '.vert', '.geom', '.frag', '.comp'))
        self.assertGreater(len(self.stages), 60)

    def test_no_number_in_shaders(self):
        self.assertEqual([f'{path}: {found[0]}' for path, text in self.stages.items()
                          for found in NUMBER_IN_GLSL.finditer(text)], [])

    def test_no_number_in_c(self):
        self.assertTrue(NUMBER_IN_C.search('glProgramUniform1f(view->program[0], 1, 2.5F);'))
        self.assertTrue(NUMBER_IN_C.search('glBindBufferBase(GL_UNIFORM_BUFFER, 2, block);'))
        self.assertFalse(NUMBER_IN_C.search('glProgramUniform1f(program, EPS_AT, 2.5F); f(program, 1, 2);'))
        self.assertEqual([f'{path}: {found[0]}' for floor in ('render', 'sim')
                          for path, text in texts(ROOT / floor, ('.c', '.h')).items()
                          for found in NUMBER_IN_C.finditer(text)], [])

    def test_each_name_is_read(self):
        everything = (path.read_text() for path in SHADERS.rglob('*.*') if path.suffix != '.md')
        read = collections.Counter(re.findall(r'\w+', ' '.join(everything)))
        names = [name for text in self.headers.values() for name, _ in NAME.findall(text)]
        self.assertGreater(len(names), 50)
        self.assertEqual([name for name in names if read[name] < 2], [])

    def test_what_is_only_written_is_not_read(self):
        """NVIDIA's compiler holds to it: `a[i] = b[i] = x` reads b."""
        def reads(text):
            text = re.sub(r'//[^\n]*|^#.*', '', text, flags=re.M)
            for name in re.findall(r'\bwriteonly\s+buffer\s+\w+\s*\{\s*\w+\s+(\w+)\[', text):
                for found in re.finditer(rf'\b{name}\[', text):
                    end, depth = found.end(), 1
                    while depth:
                        depth += {'[': 1, ']': -1}.get(text[end], 0)
                        end += 1
                    before = re.split(r'[;{})],?|\belse\b', text[:found.start()])[-1]
                    if text[found.start() - 1:found.start()] == '{' or 'buffer' in before or text[end:end + 1] == ';':
                        continue
                    assigned = re.match(r'(\.\w+)*\s*=(?!=)', text[end:])
                    if before.strip() or not assigned:
                        yield text[found.start():end]

        declared = 'layout(std430) writeonly buffer Moves { vec4 move[]; };\n'
        self.assertEqual(list(reads(declared + 'if (a) move[i] = x; else move[j[1]].w = 1.0;')), [])
        self.assertEqual(list(reads(declared + 'x = move[i] = 1.0; move[j] += 1.0;')), ['move[i]', 'move[j]'])
        self.assertEqual([f'{path}: {found}' for path, text in self.stages.items() for found in reads(text)], [])

    def test_a_location_is_one_uniform(self):
        common = NAME.findall((SHADERS / 'shared/bindings.h').read_text())
        for path in sorted(SHADERS.glob('*/*_bindings.h')):
            number = collections.defaultdict(set)
            for name, value in common + NAME.findall(path.read_text()):
                if name.endswith('_AT'):
                    number[value].add(name)
            self.assertEqual({value: names for value, names in number.items() if len(names) > 1}, {}, path.name)


if __name__ == '__main__':
    unittest.main()
