"""Emitters and drains are opened and shut by the mouse, in the panel."""
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import STILL, Window

FLOW = STILL.replace('0.5]}}]}', '0.5]}}], emit: [{disk: {centre: [0, 0.9, 0], direction: [0, -1, 0], radius: 0.2}, speed: 1}]}') \
    + 'drains: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.05, 0.5]}, shut: true}]\n'
PLAY, EMITTER, DRAIN = (60, 286), (169, 328), (169, 350)  # a heading, and switches once it is closed


class Gates(Window):
    def click(self, place):
        self.drag(1, [place, place])
        self.drawn(3)

    def test_switches(self):
        """The session does it again; a saved scene begins with what is shut."""
        self.write('still.yaml', FLOW)
        self.open('still.yaml', '--record', 'a.rec', size=(760, 600))
        self.keys('p')
        self.drawn(5)
        self.click(PLAY)
        for switch in EMITTER, DRAIN, EMITTER, EMITTER:
            self.click(switch)
        self.keys('ctrl+shift+s')
        self.wait_said('still-2.yaml')
        self.quit()
        shut = re.findall(r'^\d+ shut(.*)$', self.read('a.rec').decode(), re.M)
        self.assertEqual(shut, [' fluids[0].emit[0] drains[0]', ' fluids[0].emit[0]', '', ' fluids[0].emit[0]'])
        self.assertEqual(self.slosh('replay', 'a.rec', '--quiet'), (0, ''))
        saved = self.read('still-2.yaml').decode()
        self.assertRegex(saved, 'emit: .*shut: true')
        self.assertRegex(saved, 'drains: .*shut: false')


if __name__ == '__main__':
    command.main()
