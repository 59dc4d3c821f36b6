#include "app/lab/chart_labels.h"

#include <math.h>
#include <string.h>

static const double POINT = 5;     /* half the side of a point's box, px */
static const double LINE_STEP = 6; /* between the boxes along a line, px */
static const double WIDE = 0.7;    /* of a letter, over the font size: DejaVu Sans has 0.6 in the mean */

bool boxes_overlap(const Box *a, const Box *b)
{
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

double label_width(const char *text, double font)
{
    return WIDE * font * (double)strlen(text);
}

void label_field_point(LabelField *field, double x, double y)
{
    if (field->taken_count < LABEL_TAKEN_MAX)
        field->taken[field->taken_count++] = (Box){x - POINT, y - POINT, x + POINT, y + POINT};
}

void label_field_line(LabelField *field, double x0, double y0, double x1, double y1)
{
    const int steps = (int)ceil(hypot(x1 - x0, y1 - y0) / LINE_STEP);
    for (int i = 0; i <= steps && field->line_count < LABEL_LINES_MAX; i++) {
        const double part = steps > 0 ? (double)i / steps : 0, x = x0 + part * (x1 - x0),
                     y = y0 + part * (y1 - y0);
        field->line[field->line_count++] = (Box){x - 1, y - 1, x + 1, y + 1};
    }
}

static bool is_free(const LabelField *field, const Box *place, bool lines)
{
    const Box *frame = &field->frame;
    if (place->left < frame->left || place->right > frame->right || place->top < frame->top ||
        place->bottom > frame->bottom)
        return false;
    for (int i = 0; i < field->taken_count; i++)
        if (boxes_overlap(place, &field->taken[i]))
            return false;
    for (int i = 0; i < field->line_count && lines; i++)
        if (boxes_overlap(place, &field->line[i]))
            return false;
    return true;
}

/* Tries places on the ring of radius `far` around the point, to the right first. The label's edge or
   corner next to the point touches the ring. */
static bool place_around(const LabelField *field, double x, double y, double far, bool lines, double width,
                         double height, Box *place)
{
    enum { DIRECTIONS = 16 };
    for (int d = 0; d < DIRECTIONS; d++) {
        const int turn = d % 2 ? (d + 1) / 2 : -(d / 2);
        const double angle = 2 * 3.14159265358979 * turn / DIRECTIONS, dx = cos(angle), dy = sin(angle);
        const double left = x + far * dx + 0.5 * width * (dx - 1),
                     top = y + far * dy + 0.5 * height * (dy - 1);
        *place = (Box){left, top, left + width, top + height};
        if (is_free(field, place, lines))
            return true;
    }
    return false;
}

bool label_place(LabelField *field, double x, double y, double width, double height, Box *place)
{
    enum { NEAREST = 8, STEP = 7, FARTHEST = 120 }; /* from the point, px */
    for (int lines = 1; lines >= 0; lines--)
        for (int far = NEAREST; far < FARTHEST; far += STEP)
            if (place_around(field, x, y, far, lines, width, height, place)) {
                if (field->taken_count < LABEL_TAKEN_MAX)
                    field->taken[field->taken_count++] = *place;
                return true;
            }
    return false;
}
