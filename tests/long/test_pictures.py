"""Pictures that take long."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from command import CommandTest


class Volume(CommandTest):
    @unittest.skipIf('LSAN_OPTIONS' in os.environ, 'fields of 0.9 GB, and several times that under a sanitizer')
    def test_256_cells_each_way(self):
        """Half of them near walls: more groups of a shader than one row may have."""
        code, said = self.slosh('render', 'scene.yaml', '-o', 'a.png', '--time', '0', '--view', 'volume', '--set',
                                'view.volume.cells=256', '--size', '160x120', '--quiet')
        self.assertEqual(code, 0, said)


if __name__ == '__main__':
    command.main()
