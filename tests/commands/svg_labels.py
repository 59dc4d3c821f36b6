"""Where a chart's texts stand: none leaves the frame, none is written over another."""
import functools
import re
import struct
import xml.etree.ElementTree as tree

SVG = '{http://www.w3.org/2000/svg}'
FONT = '/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf'
ASCENT, DESCENT = 0.75, 0.2  # over the font's size


@functools.cache
def advances():
    """By letter, over the font's size: the font's own tables cmap (format 4) and hmtx."""
    with open(FONT, 'rb') as file:
        font = file.read()
    at = {font[k:k + 4]: struct.unpack('>I', font[k + 8:k + 12])[0]
          for k in range(12, 12 + 16 * struct.unpack('>H', font[4:6])[0], 16)}
    unit, = struct.unpack('>H', font[at[b'head'] + 18:at[b'head'] + 20])
    metrics, = struct.unpack('>H', font[at[b'hhea'] + 34:at[b'hhea'] + 36])
    for k in range(struct.unpack('>H', font[at[b'cmap'] + 2:at[b'cmap'] + 4])[0]):
        start = at[b'cmap'] + struct.unpack('>I', font[at[b'cmap'] + 8 + 8 * k:at[b'cmap'] + 12 + 8 * k])[0]
        if struct.unpack('>H', font[start:start + 2]) == (4,):
            break
    segments = struct.unpack('>H', font[start + 6:start + 8])[0] // 2
    ends, starts, deltas, offsets = (struct.unpack(f'>{segments}H', font[start + 14 + (2 * segments * k) + (2 if k else 0):][:2 * segments])
                                     for k in range(4))
    found = {}
    for segment in range(segments):
        for letter in range(starts[segment], min(ends[segment], 0xfffe) + 1):
            glyph = letter + deltas[segment]
            if offsets[segment]:
                place = start + 16 + 6 * segments + 2 * segment + offsets[segment] + 2 * (letter - starts[segment])
                glyph, = struct.unpack('>H', font[place:place + 2])
            place = at[b'hmtx'] + 4 * min(glyph % 65536, metrics - 1)
            found[chr(letter)] = struct.unpack('>H', font[place:place + 2])[0] / unit
    return found


def width(text):
    """Over the font's size."""
    return sum(advances()[c] for c in text)


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
