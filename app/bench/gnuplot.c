#include "app/bench/gnuplot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>

static bool has_ending(const char *path, const char *ending)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

bool gnuplot_check_name(const char *path, Error *error)
{
    return has_ending(path, ".svg") || has_ending(path, ".png") ||
           error_set(error, "'%s' is no name for a chart; name a FILE.svg or a FILE.png", path);
}

bool gnuplot_table_name(const char *path, char table[1024], Error *error)
{
    if (!gnuplot_check_name(path, error))
        return false;
    if (strlen(path) >= 1024)
        return error_set(error, "the name of the chart has more than %d bytes; name a shorter one", 1023);
    snprintf(table, 1024, "%s", path);
    memcpy(strrchr(table, '.'), ".csv", sizeof ".csv");
    return true;
}

void gnuplot_quote(FILE *gnuplot, const char *text)
{
    fputc('\'', gnuplot);
    for (; *text; text++)
        fputs(*text == '\'' ? "''" : (char[]){*text, '\0'}, gnuplot);
    fputc('\'', gnuplot);
}

static bool not_installed(const char *path, Error *error)
{
    return error_set(error, "%s: gnuplot, which draws charts, is not installed; install gnuplot-nox", path);
}

bool gnuplot_check(const char *path, Error *error)
{
    return system("command -v gnuplot >/dev/null 2>&1") == 0 || not_installed(path, error);
}

bool gnuplot_begin(Gnuplot *chart, const char *path, int width, int height, Error *error)
{
    if (!gnuplot_check_name(path, error) || !output_begin(&chart->output, path, error))
        return false;
    chart->gnuplot = popen("gnuplot", "w");
    if (!chart->gnuplot) {
        output_discard(&chart->output);
        return error_set(error, "%s: gnuplot cannot be started; install gnuplot-nox", path);
    }
    fprintf(chart->gnuplot, "set terminal %s size %d,%d font 'DejaVu Sans,11' background '#ffffff'\n",
            has_ending(path, ".svg") ? "svg" : "pngcairo", width, height);
    fputs("set encoding utf8\nset output ", chart->gnuplot);
    gnuplot_quote(chart->gnuplot, chart->output.temp);
    fputs("\nset border 3 lc '#5a6672'\nset tics nomirror textcolor '#2a3440'\n"
          "set grid lc '#d8dee4' lt 1\nset key outside right top noenhanced\n"
          "set linetype 1 lc '#2a6f97'\nset linetype 2 lc '#e07a3f'\nset linetype 3 lc '#4f9d69'\n"
          "set linetype 4 lc '#b0457b'\nset linetype 5 lc '#c9a227'\nset linetype 6 lc '#5b5ea6'\n"
          "set linetype 7 lc '#7a4f2a'\nset linetype 8 lc '#35a7a0'\nset linetype 9 lc '#c0392b'\n"
          "set linetype 10 lc '#8795a3'\nset linetype cycle 10\nset title noenhanced\n",
          chart->gnuplot);
    return true;
}

/* gnuplot reports no full disk: returns true if the file has the ending bytes of its format. */
static bool is_whole(const Gnuplot *chart)
{
    static const char svg[] = "</svg>", png[] = "IEND\xae\x42\x60\x82";
    const char *end = has_ending(chart->output.path, ".svg") ? svg : png;
    char tail[16] = "";
    FILE *file = fopen(chart->output.temp, "rb");
    if (!file)
        return false;
    const bool read =
        fseek(file, -(long)(sizeof tail - 1), SEEK_END) == 0 && fread(tail, 1, sizeof tail - 1, file) > 0;
    fclose(file);
    for (size_t i = 0; read && i + strlen(end) < sizeof tail; i++)
        if (memcmp(tail + i, end, strlen(end)) == 0)
            return true;
    return false;
}

bool gnuplot_end(Gnuplot *chart, Error *error)
{
    enum { NOT_FOUND = 127 }; /* the shell's exit code of a missing command */
    fputs("set output\n", chart->gnuplot);
    const int code = pclose(chart->gnuplot);
    const char *path = chart->output.path;
    chart->gnuplot = NULL;
    if (code == 0 && is_whole(chart))
        return output_commit(&chart->output, error);
    output_discard(&chart->output);
    if (WIFEXITED(code) && WEXITSTATUS(code) == NOT_FOUND)
        return not_installed(path, error);
    if (code == 0)
        return error_set(error, "%s: gnuplot could not write it whole; is the disk full?", path);
    return error_set(error, "%s: gnuplot could not draw it (status %d)", path, code);
}

static const double POINT = 5;     /* half the side of a point's box, px */
static const double LINE_STEP = 6; /* between the boxes along a line, px */
static const double WIDE = 0.7;    /* of a letter, over the font size: DejaVu Sans has 0.6 in the mean */

bool label_boxes_overlap(const LabelBox *a, const LabelBox *b)
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
        field->taken[field->taken_count++] = (LabelBox){x - POINT, y - POINT, x + POINT, y + POINT};
}

void label_field_line(LabelField *field, double x0, double y0, double x1, double y1)
{
    const int steps = (int)ceil(hypot(x1 - x0, y1 - y0) / LINE_STEP);
    for (int i = 0; i <= steps && field->line_count < LABEL_LINES_MAX; i++) {
        const double part = steps > 0 ? (double)i / steps : 0, x = x0 + part * (x1 - x0),
                     y = y0 + part * (y1 - y0);
        field->line[field->line_count++] = (LabelBox){x - 1, y - 1, x + 1, y + 1};
    }
}

static bool is_free(const LabelField *field, const LabelBox *place, bool lines)
{
    const LabelBox *frame = &field->frame;
    if (place->left < frame->left || place->right > frame->right || place->top < frame->top ||
        place->bottom > frame->bottom)
        return false;
    for (int i = 0; i < field->taken_count; i++)
        if (label_boxes_overlap(place, &field->taken[i]))
            return false;
    for (int i = 0; i < field->line_count && lines; i++)
        if (label_boxes_overlap(place, &field->line[i]))
            return false;
    return true;
}

/* Tries places on the ring of radius `far` around the point, to the right first. The label's edge or
   corner next to the point touches the ring. */
static bool place_around(const LabelField *field, double x, double y, double far, bool lines, double width,
                         double height, LabelBox *place)
{
    enum { DIRECTIONS = 16 };
    for (int d = 0; d < DIRECTIONS; d++) {
        const int turn = d % 2 ? (d + 1) / 2 : -(d / 2);
        const double angle = 2 * 3.14159265358979 * turn / DIRECTIONS, dx = cos(angle), dy = sin(angle);
        const double left = x + far * dx + 0.5 * width * (dx - 1),
                     top = y + far * dy + 0.5 * height * (dy - 1);
        *place = (LabelBox){left, top, left + width, top + height};
        if (is_free(field, place, lines))
            return true;
    }
    return false;
}

bool label_place(LabelField *field, double x, double y, double width, double height, LabelBox *place)
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
