"""slosh bench --ablate: what valgrind counts is what is timed."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_ablate import SCENE, AblateTest


class Count(AblateTest):
    def test_what_is_counted_is_what_is_timed(self):
        self.write('tank.yaml', SCENE.replace(', slip: none', '').replace('delta_sph: 0.1, ', ''))  # one term is enough
        counted = {}
        for words in ((), ('--particles', '30')):
            done = self.run_it('tank.yaml', '--time', '0.02', '--threads', '1', '--quiet', *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            counted[words] = self.rows()[0]['instructions_step']
        self.assertLess(counted['--particles', '30'], 0.5 * counted[()])  # 120 without


if __name__ == '__main__':
    command.main()
