#include "sim/world/cell_rows.h"

/* The cell at `place` along one axis, for a place outside the box: across a periodic side. */
static int across(const Constants *s, int k, int place, float *shift)
{
    const int cells = s->cells.size[k] - 2;
    *shift = 0;
    if (!s->periodic.axis[k] || (place > 0 && place <= cells))
        return place;
    *shift = place < 1 ? s->periodic.size[k] : -s->periodic.size[k];
    return place < 1 ? place + cells : place - cells;
}

/* `count` cells from `first` on along x. */
static CellRow row_from(const Constants *constants, const uint32_t *start, int first, int count,
                        const int at[3], const float shift[3])
{
    const int *size = constants->cells.size;
    const size_t cell = ((size_t)at[2] * (size_t)size[1] + (size_t)at[1]) * (size_t)size[0] + (size_t)first;
    return (CellRow){
        .begin = start[cell], .end = start[cell + (size_t)count], .shift = {shift[0], shift[1], shift[2]}};
}

int cell_rows(const Constants *s, const uint32_t *start, uint32_t cell, CellRow rows[CELL_ROWS])
{
    const int *size = s->cells.size, x = (int)(cell % (uint32_t)size[0]);
    const int y = (int)(cell / (uint32_t)size[0]) % size[1], z = (int)(cell / (uint32_t)size[0]) / size[1];
    const bool low = s->periodic.axis[0] && x == 1, high = s->periodic.axis[0] && x == size[0] - 2;
    int count = 0;
    for (int row = s->first_row; row < s->last_row; row++) {
        float shift[3] = {0};
        const int at[3] = {x, across(s, 1, y + row % 3 - 1, &shift[1]),
                           across(s, 2, z + row / 3 - 1, &shift[2])};
        rows[count++] = row_from(s, start, low ? x : x - 1, low || high ? 2 : 3, at, shift);
        if (low || high) {
            const int far = across(s, 0, low ? x - 1 : x + 1, &shift[0]);
            rows[count++] = row_from(s, start, far, 1, at, shift);
        }
    }
    return count;
}

bool cell_row_again(const Constants *s, const CellRow *row)
{
    for (int k = 0; k < 3; k++)
        if (row->shift[k] != 0 && s->cells.size[k] - 2 == 2)
            return true;
    return false;
}
