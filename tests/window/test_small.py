"""A window that is too small for the panel beside the fluid has a button that opens it."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import Window

BUTTON = (40, 28)


class Small(Window):
    def click(self, at):
        self.drag(1, [at, at])

    def test_the_button_opens_the_panel(self):
        self.open('still.yaml', size=(420, 320))
        self.click(BUTTON)
        out = self.quit()
        self.assertEqual((out['panel'], out['camera_auto']), (True, True))

    def test_who_hides_the_panel_sees_no_button(self):
        self.open('still.yaml', size=(800, 400))
        self.keys('p')
        self.drag(1, [BUTTON, (BUTTON[0] + 30, BUTTON[1])])
        out = self.quit()
        self.assertEqual((out['panel'], out['camera_auto']), (False, False))


if __name__ == '__main__':
    command.main('Small.test_the_button_opens_the_panel', 'Small.test_who_hides_the_panel_sees_no_button')
