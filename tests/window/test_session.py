"""A recorded session in the window: given, or dropped by another program."""
import os
import re
import select
import sys
import time

from Xlib import X
from Xlib.protocol import event

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import Window


class Dragged:
    """Files in the hand of another program over the window, by the XDND protocol."""
    def __init__(self, display, window, paths):
        self.connection, self.target = display.connection, window
        self.uris = ''.join(f'file://{path}\r\n' for path in paths).encode()
        self.source = display.root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        self.source.set_selection_owner(self.atom('XdndSelection'), X.CurrentTime)

    def atom(self, name):
        return self.connection.intern_atom(name)

    def tell(self, name, *data):
        message = event.ClientMessage(window=self.target, client_type=self.atom(name),
                                      data=(32, [self.source.id, *data, *[0] * (4 - len(data))]))
        self.connection.create_resource_object('window', self.target).send_event(message)
        self.connection.sync()

    def give(self, request):
        """The names, to who asks for them."""
        request.requestor.change_property(request.property, request.target, 8, self.uris)
        request.requestor.send_event(event.SelectionNotify(time=request.time, requestor=request.requestor,
                                                           selection=request.selection, target=request.target,
                                                           property=request.property))
        self.connection.sync()

    def answer(self, name):
        """Waits for it."""
        end = time.monotonic() + command.PATIENCE
        while time.monotonic() < end:
            if not self.connection.pending_events() and not select.select([self.connection], [], [], 0.2)[0]:
                continue
            said = self.connection.next_event()
            if said.type == X.SelectionRequest:
                self.give(said)
            elif said.type & 127 == X.ClientMessage and said.client_type == self.atom(name):
                return
        raise AssertionError(f'no {name} comes')

    def drop(self):
        self.tell('XdndEnter', 5 << 24, self.atom('text/uri-list'))
        self.tell('XdndPosition', 0, 100 << 16 | 100, X.CurrentTime, self.atom('XdndActionCopy'))
        self.answer('XdndStatus')
        self.tell('XdndDrop', 0, X.CurrentTime)
        self.answer('XdndFinished')
        self.source.destroy()


class Session(Window):
    def record(self, seconds=0.4):
        """So long, in which the box goes to the left."""
        self.open('still.yaml', '--record', 'a.rec')
        self.display.press('Left')
        self.until(lambda now: now['box_position'][0] < -0.05)
        self.display.release('Left')
        self.runs(seconds)
        return self.quit()

    def test_given(self):
        """Its bits and its end; R does it again, and then the box is in the hand."""
        recorded = self.record()
        self.open('a.rec', '--record', 'b.rec')
        self.wait_said('the recorded session ends here, with the same bits')
        self.keys('comma', 'comma')  # back in it, and on: it stays what it was
        self.rest()
        self.keys('End', 'space', 'r')
        self.wait_said('with the same bits', 2)
        self.keys('space')
        self.display.press('Right')
        self.keys('space')
        self.until(lambda now: now['steps'] > recorded['steps'] and now['box_position'][0] > recorded['box_position'][0])
        self.display.release('Right')
        out = self.quit()
        self.assertEqual(out['session'], 'same')
        self.assertGreater(out['steps'], recorded['steps'])
        self.assertLess(recorded['box_position'][0], 0)
        self.assertGreater(out['box_position'][0], recorded['box_position'][0])
        self.assertEqual(self.slosh('replay', 'b.rec', '--quiet'), (0, ''))
        line = next(line for line in self.read('a.rec').decode().split('\n') if re.match(r'\d+ target', line))
        self.assertIn(line, self.read('b.rec').decode())

    def test_dropped(self):
        """What is done by hand takes over; what was recorded after is left out."""
        self.record(1.5)
        self.open('still.yaml')
        Dragged(self.display, self.window, [self.path('a.rec')]).drop()
        self.wait_said('a recorded session: it is done again')
        self.filled()
        self.keys('equal')  # changes no bit
        self.assertNotIn('taken over', self.said_now())
        self.drag(1, [(240, 180), (280, 180)], 'shift')
        self.wait_said('you have taken over from the recorded session')
        self.runs(0.3)
        out = self.quit()
        self.assertEqual((out['session'], out['scenes_opened']), ('left', 2))
        self.assertNotIn('ends here', self.messages)

    def test_what_it_cannot_show(self):
        self.record()
        code, said = self.slosh('a.rec', '--set', 'gravity=[0, -1, 0]')
        self.assertEqual((code, said), (2, '--set gravity=[0, -1, 0] makes no sense for a.rec: the session has its own; how '
                                        'it is drawn (view.*) may change\n'))
        text = self.read('a.rec').decode()
        at = text.index('\nend ') + 1
        self.write('b.rec', text[:at] + '1000000 set solver.backend=compute\n' + re.sub(r'end \d+', 'end 1000001', text[at:]))
        code, said = self.slosh('b.rec')
        self.assertEqual(code, 2)
        self.assertRegex(said, r'^b\.rec:\d+: the session goes on with another backend here.*\n$')
        self.write('b.rec', text[:at])
        self.open('b.rec')
        self.wait_said('the recorded session was cut off here')
        self.assertEqual(self.quit()['session'], 'cut')


if __name__ == '__main__':
    command.main('Session.test_given', 'Session.test_dropped Session.test_what_it_cannot_show')
