/* The chart of `slosh chart --views`. */
#include "app/gallery/view_row.h"

#include "app/lab/chart.h"
#include "app/lab/chart_labels.h"

#include <math.h>
#include <string.h>

/* px */
enum { WIDTH = 860, HEIGHT = 560, LEFT = 84, TOP = 76, RIGHT = 700, BOTTOM = 500, VIEWS_MAX = 16 };

static const double LABEL_FONT = 8, LABEL_HEIGHT = 11;

/* Logarithms to base 10 of the drawn values: ms, error. */
typedef struct Frame {
    double low[2], high[2];
    LabelField field;
} Frame;

static bool drawn(const ViewRow *row)
{
    return row->ms > 0 && isfinite(row->ms) && row->error > 0 && isfinite(row->error);
}

static void frame_make(const ViewRows *rows, Frame *frame)
{
    *frame = (Frame){.low = {(double)INFINITY, (double)INFINITY},
                     .high = {-(double)INFINITY, -(double)INFINITY},
                     .field = {.frame = {LEFT, TOP, RIGHT, BOTTOM}}};
    for (int i = 0; i < rows->count; i++)
        for (int k = 0; k < 2 && drawn(&rows->row[i]); k++) {
            const double value = log10(k ? rows->row[i].error : rows->row[i].ms);
            frame->low[k] = fmin(frame->low[k], value);
            frame->high[k] = fmax(frame->high[k], value);
        }
    for (int k = 0; k < 2; k++) {
        const double margin = 0.1 + 0.1 * (frame->high[k] - frame->low[k]);
        frame->low[k] -= margin;
        frame->high[k] += margin;
    }
}

static double x_of(const Frame *frame, const ViewRow *row)
{
    return LEFT + (RIGHT - LEFT) * (log10(row->ms) - frame->low[0]) / (frame->high[0] - frame->low[0]);
}

static double y_of(const Frame *frame, const ViewRow *row)
{
    return TOP + (BOTTOM - TOP) * (frame->high[1] - log10(row->error)) / (frame->high[1] - frame->low[1]);
}

/* Numbers at 1, 2 and 5 of each power of ten. */
static void put_axis(const char *name, double low, double high, FILE *gnuplot)
{
    static const double few[] = {1, 2, 5};
    int tics = 0;
    fprintf(gnuplot, "set %srange [%.9g:%.9g]\nset %stics (", name, pow(10, low), pow(10, high), name);
    for (int power = (int)floor(low); power <= (int)ceil(high); power++)
        for (int k = 0; k < 3; k++)
            fprintf(gnuplot, "%s%.9g", tics++ ? ", " : "", few[k] * pow(10, power));
    fputs(")\n", gnuplot);
}

static void put_words(const ViewWords *words, FILE *gnuplot)
{
    const char *const lines[] = {words->title, words->note, words->renderer};
    for (int i = 0; i < 3; i++) {
        fprintf(gnuplot, "set label %d ", 97 + i);
        chart_quote(gnuplot, lines[i]);
        fprintf(gnuplot, " at screen 0.5,%g center noenhanced font ',%d' textcolor '%s'\n",
                1 - (i ? 22.0 + 15 * i : 18.0) / HEIGHT, i ? 8 : 11, i ? "#5a6672" : "#2a3440");
    }
}

/* Labels the front where there is room; a distant label gets a line to its point. */
static void put_labels(const ViewRows *rows, Frame *frame, FILE *gnuplot)
{
    for (int i = 0; i < rows->count; i++)
        if (drawn(&rows->row[i]))
            label_field_point(&frame->field, x_of(frame, &rows->row[i]), y_of(frame, &rows->row[i]));
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = &rows->row[i];
        Box place;
        if (!drawn(row) || !view_on_front(rows, i) ||
            !label_place(&frame->field, x_of(frame, row), y_of(frame, row),
                         label_width(row->settings, LABEL_FONT), LABEL_HEIGHT, &place))
            continue;
        const double x = x_of(frame, row), y = y_of(frame, row);
        const double to_x = fmin(fmax(x, place.left), place.right),
                     to_y = fmin(fmax(y, place.top), place.bottom);
        fprintf(gnuplot, "set label %d ", 100 + i);
        chart_quote(gnuplot, row->settings);
        fprintf(gnuplot, " at screen %.5f,%.5f center noenhanced font ',%g'\n",
                0.5 * (place.left + place.right) / WIDTH, 1 - 0.5 * (place.top + place.bottom) / HEIGHT,
                LABEL_FONT);
        if (hypot(to_x - x, to_y - y) > 2 * LABEL_HEIGHT)
            fprintf(gnuplot,
                    "set arrow %d from screen %.5f,%.5f to screen %.5f,%.5f nohead lw 0.5 lc '#8795a3'\n",
                    100 + i, x / WIDTH, 1 - y / HEIGHT, to_x / WIDTH, 1 - to_y / HEIGHT);
    }
}

/* Collects the views in the order of their rows; returns their count. */
static int views_of(const ViewRows *rows, const char *views[VIEWS_MAX])
{
    int count = 0;
    for (int i = 0; i < rows->count; i++) {
        int v = 0;
        while (v < count && strcmp(views[v], rows->row[i].view) != 0)
            v++;
        if (v == count && count < VIEWS_MAX && drawn(&rows->row[i]))
            views[count++] = rows->row[i].view;
    }
    return count;
}

/* Two blocks per view: all pictures, and the front in the order of time. */
static void put_data(const ViewRows *rows, const char *view, int number, FILE *gnuplot)
{
    const ViewRow *front[VIEW_ROWS_MAX];
    int count = 0;
    fprintf(gnuplot, "$view%d << EOD\n", number);
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = &rows->row[i];
        if (!drawn(row) || strcmp(row->view, view) != 0)
            continue;
        fprintf(gnuplot, "%.9g %.9g\n", row->ms, row->error);
        if (!view_on_front(rows, i))
            continue;
        int at = count++;
        for (; at > 0 && front[at - 1]->ms > row->ms; at--)
            front[at] = front[at - 1];
        front[at] = row;
    }
    fprintf(gnuplot, "EOD\n$front%d << EOD\n", number);
    for (int i = 0; i < count; i++)
        fprintf(gnuplot, "%.9g %.9g\n", front[i]->ms, front[i]->error);
    fputs("EOD\n", gnuplot);
}

static void plot(const ViewRows *rows, FILE *gnuplot)
{
    static Frame frame;
    const char *views[VIEWS_MAX];
    const int count = views_of(rows, views);
    if (count == 0) {
        fputs("unset logscale\nset label 1 'no error more than 0' at graph 0.1,0.5\nplot [0:1] 0 notitle\n",
              gnuplot);
        return;
    }
    frame_make(rows, &frame);
    put_axis("x", frame.low[0], frame.high[0], gnuplot);
    put_axis("y", frame.low[1], frame.high[1], gnuplot);
    put_labels(rows, &frame, gnuplot);
    for (int v = 0; v < count; v++)
        put_data(rows, views[v], v, gnuplot);
    fputs("plot ", gnuplot);
    for (int v = 0; v < count; v++) {
        fprintf(
            gnuplot,
            "%s$view%d using 1:2 with points pt 7 ps 0.9 lt %d title '%s', $front%d using 1:2 with lines lw "
            "1.5 dt 2 lt %d title 'its best'",
            v ? ", " : "", v, v + 1, views[v], v, v + 1);
    }
    fputc('\n', gnuplot);
}

bool view_rows_draw(const ViewRows *rows, const ViewWords *words, const char *path, Error *error)
{
    Chart chart = {.gnuplot = NULL};
    if (!chart_begin(&chart, path, WIDTH, HEIGHT, error))
        return false;
    FILE *gnuplot = chart.gnuplot;
    fprintf(
        gnuplot,
        "set logscale xy\nset format xy '%%g'\nset xlabel 'time a picture, ms'\nset ylabel 'error, rms of linear "
        "light over white'\nset lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen "
        "%.5f\nset bmargin at screen %.5f\nset key at screen %.5f,%.5f left top Left reverse noenhanced\n",
        (double)LEFT / WIDTH, (double)RIGHT / WIDTH, 1 - (double)TOP / HEIGHT, 1 - (double)BOTTOM / HEIGHT,
        (RIGHT + 12.0) / WIDTH, 1 - (double)TOP / HEIGHT);
    put_words(words, gnuplot);
    plot(rows, gnuplot);
    return chart_end(&chart, error);
}
