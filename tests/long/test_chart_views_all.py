"""slosh chart --views of all views."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_chart_views import ChartViewsTest


class ChartViewsAll(ChartViewsTest):
    def test_each_view_by_time_and_error(self):
        errors = self.check_views({'spheres', 'splat', 'volume', 'slice', 'pbsr'},
                                  [('splat', 'antialias=false'), ('splat', 'all coarsest'), ('volume', 'cells=24'), ('volume', 'all coarsest')],
                                  # ten methods and settings with so few cells
                                  '--set', 'view.splat.ior=1.4', '--set', 'view.volume.cells=48')
        # other ways to the same picture
        self.assertAlmostEqual(errors['splat', 'cull=false'], errors['splat', 'as it is'], places=4)
        self.assertAlmostEqual(errors['volume', 'method=slabs'], errors['volume', 'as it is'], places=3)


if __name__ == '__main__':
    command.main()
