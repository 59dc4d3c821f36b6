"""Where a chart's texts stand: none leaves the frame, none is written over another."""
import re
import xml.etree.ElementTree as tree

SVG = '{http://www.w3.org/2000/svg}'
NARROW, WIDE = set("ijlftr.,:;'|!()[] -"), set('mwMW%@')
ASCENT, DESCENT = 0.75, 0.2  # over the font's size


def width(text):
    """Over the font's size, about as DejaVu Sans has it."""
    return sum(0.35 if c in NARROW else 0.95 if c in WIDE else 0.61 for c in text)


def labels(svg):
    """(text, left, top, right, bottom) of each, px."""
    found = []
    for group in tree.fromstring(svg).iter(SVG + 'g'):
        text = ''.join(''.join(child.itertext()) for child in group.findall(SVG + 'text')).strip()
        if not text:
            continue
        place = re.match(r'translate\(([-\d.]+),([-\d.]+)\)(?: rotate\(([-\d.]+)\))?', group.get('transform'))
        x, y, turn = (float(number or 0) for number in place.groups())
        size = float(group.get('font-size'))
        long = width(text) * size
        begin = {'start': 0, 'middle': -long / 2, 'end': -long}[group.get('text-anchor')]
        if turn == 0:
            box = x + begin, y - ASCENT * size, x + begin + long, y + DESCENT * size
        elif turn in (-90, 270):
            box = x - ASCENT * size, y - begin - long, x + DESCENT * size, y - begin
        else:
            raise AssertionError(f'"{text}" is turned by {turn} degrees')
        found.append((text, *box))
    return found


def faults(svg):
    """What is wrong with a chart's texts, a line each."""
    frame = re.search(r'viewBox=.0 0 (\d+) (\d+)', svg)
    right, bottom = (float(side) for side in frame.groups())
    found = labels(svg)
    out = [f'"{a[0]}" leaves the frame' for a in found if a[1] < 0 or a[2] < 0 or a[3] > right or a[4] > bottom]
    for i, a in enumerate(found):
        out += [f'"{a[0]}" is written over "{b[0]}"' for b in found[:i]
                if a[1] < b[3] and b[1] < a[3] and a[2] < b[4] and b[2] < a[4]]
    return out
