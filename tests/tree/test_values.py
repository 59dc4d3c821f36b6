"""A scene is a value: whatever it points to is constant, so that scenes and worlds that share it cannot change it for each
other."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MADE_ONCE = {'FieldTable', 'MeshShape'}  # by app/scene/import, for as long as the program runs


def structs():
    """{name: members} of the structs in headers, without comments."""
    found = {}
    for floor in ('sim', 'render', 'app', 'library'):
        for path in (ROOT / floor).rglob('*.h'):
            text = re.sub(r'/\*.*?\*/', '', path.read_text(), flags=re.S)
            for name, body in re.findall(r'typedef struct (\w+) \{(.*?)\n\} \1;', text, re.S):
                found[name] = [member.strip() for member in body.split(';') if member.strip()]
    return found


def reached(name, known, seen):
    """Names of the structs that lie in `name`, or to which it points."""
    if name in known and name not in seen | MADE_ONCE:
        seen.add(name)
        for member in known[name]:
            for word in re.findall(r'\w+', member):
                reached(word, known, seen)
    return seen


class Values(unittest.TestCase):
    maxDiff = None

    def test_what_a_scene_points_to_is_constant(self):
        known = structs()
        parts = reached('Scene', known, set())
        self.assertLessEqual({'WorldDef', 'FluidDef', 'SolidDef', 'Fill', 'Motion', 'ProbeDef', 'ViewDef', 'CameraKey'}, parts)
        wrong = [f'{part}: {member}' for part in sorted(parts) for member in known[part]
                 if '*' in member and not member.startswith('const ')]
        self.assertEqual(wrong, [])


unittest.main()
