#include "app/bench/plot.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>

static bool has_ending(const char *path, const char *ending)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

bool plot_check_name(const char *path, Error *error)
{
    return has_ending(path, ".svg") || has_ending(path, ".png") ||
           error_set(error, "'%s' is no name for a chart; name a FILE.svg or a FILE.png", path);
}

bool plot_table_name(const char *path, char table[1024], Error *error)
{
    if (!plot_check_name(path, error))
        return false;
    if (strlen(path) >= 1024)
        return error_set(error, "the name of the chart has more than %d bytes; name a shorter one", 1023);
    snprintf(table, 1024, "%s", path);
    memcpy(strrchr(table, '.'), ".csv", sizeof ".csv");
    return true;
}

static void quote(FILE *gnuplot, const char *text)
{
    fputc('\'', gnuplot);
    for (; *text; text++)
        fputs(*text == '\'' ? "''" : (char[]){*text, '\0'}, gnuplot);
    fputc('\'', gnuplot);
}

static void release(Plot *plot)
{
    if (plot->series)
        fclose(plot->series);
    free(plot->entries);
    free(plot->field);
    plot->series = plot->gnuplot = NULL;
}

static bool not_installed(const char *path, Error *error)
{
    return error_set(error, "%s: gnuplot, which draws charts, is not installed; install gnuplot-nox", path);
}

bool plot_check(const char *path, Error *error)
{
    return system("command -v gnuplot >/dev/null 2>&1") == 0 || not_installed(path, error);
}

bool plot_begin(Plot *plot, const char *path, int width, int height, Error *error)
{
    if (!plot_check_name(path, error) || !output_begin(&plot->output, path, error))
        return false;
    plot->field = calloc(1, sizeof *plot->field);
    plot->series = open_memstream(&plot->entries, &plot->entries_size);
    plot->gnuplot = plot->field && plot->series ? popen("gnuplot", "w") : NULL;
    if (!plot->gnuplot) {
        release(plot);
        output_discard(&plot->output);
        return error_set(error, "%s: gnuplot cannot be started; install gnuplot-nox", path);
    }
    plot->width = width;
    plot->height = height;
    /* a point is a pixel of an SVG, unless scaled */
    fprintf(plot->gnuplot, "set terminal %s size %d,%d font 'DejaVu Sans,9' background '#ffffff'\n",
            has_ending(path, ".svg") ? "svg fontscale 1.33333" : "pngcairo", width, height);
    fputs("set encoding utf8\nset output ", plot->gnuplot);
    quote(plot->gnuplot, plot->output.temp);
    fputs("\nset border 3 lc '#5a6672'\nset tics nomirror noenhanced textcolor '#2a3440'\n"
          "set grid lc '#d8dee4' lt 1\nset key outside right top Left reverse noenhanced\n"
          "set linetype 1 lc '#2a6f97'\nset linetype 2 lc '#e07a3f'\nset linetype 3 lc '#4f9d69'\n"
          "set linetype 4 lc '#b0457b'\nset linetype 5 lc '#c9a227'\nset linetype 6 lc '#5b5ea6'\n"
          "set linetype 7 lc '#7a4f2a'\nset linetype 8 lc '#35a7a0'\nset linetype 9 lc '#c0392b'\n"
          "set linetype 10 lc '#8795a3'\nset linetype cycle 10\nset title noenhanced\n",
          plot->gnuplot);
    return true;
}

/* gnuplot reports no full disk: returns true if the file has the ending bytes of its format. */
static bool is_whole(const Plot *plot)
{
    static const char svg[] = "</svg>", png[] = "IEND\xae\x42\x60\x82";
    const char *end = has_ending(plot->output.path, ".svg") ? svg : png;
    char tail[16] = "";
    FILE *file = fopen(plot->output.temp, "rb");
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

bool plot_end(Plot *plot, Error *error)
{
    enum { NOT_FOUND = 127 }; /* the shell's exit code of a missing command */
    fputs("unset multiplot\nset output\n", plot_commands(plot));
    const int code = pclose(plot->gnuplot);
    const char *path = plot->output.path;
    release(plot);
    if (code == 0 && is_whole(plot))
        return output_commit(&plot->output, error);
    output_discard(&plot->output);
    if (WIFEXITED(code) && WEXITSTATUS(code) == NOT_FOUND)
        return not_installed(path, error);
    if (code == 0)
        return error_set(error, "%s: gnuplot could not write it whole; is the disk full?", path);
    return error_set(error, "%s: gnuplot could not draw it (status %d)", path, code);
}

/* ---- texts and panels ---- */

void plot_set(Plot *plot, const char *name, const char *text, const char *options)
{
    FILE *gnuplot = plot_commands(plot);
    fprintf(gnuplot, "set %s ", name);
    quote(gnuplot, text);
    fprintf(gnuplot, "%s\n", options);
}

void plot_text(Plot *plot, double x, double y, const char *align, double font, const char *colour,
               const char *text)
{
    char options[160];
    snprintf(options, sizeof options, " at screen %.5f,%.5f %s noenhanced font ',%g' textcolor '%s'",
             x / plot->width, 1 - y / plot->height, align, font, colour);
    plot_set(plot, "label", text, options);
}

/* Takes as many words as fit off the text; returns the rest. A single word always fits. */
static const char *take_line(const char *text, double font, double width, char line[], size_t size)
{
    size_t taken = 0;
    for (const char *end = text; end && *text; end = *end ? end : NULL) {
        end += strspn(end, " ");
        end += strcspn(end, " ");
        snprintf(line, size, "%.*s", (int)(end - text), text);
        if (taken > 0 && label_width(line, font) > width)
            break;
        taken = (size_t)(end - text);
    }
    snprintf(line, size, "%.*s", (int)taken, text);
    return text + taken + strspn(text + taken, " ");
}

/* Writes the titles, or without a plot only measures. */
static double put_titles(Plot *plot, const char *const lines[], int count, int width)
{
    enum { TITLE_FONT = 11, FONT = 8, TITLE_HEIGHT = 20, HEIGHT = 15, TOP = 8, MARGIN = 12 };
    double end = TOP;
    for (int i = 0; i < count; i++)
        for (const char *rest = lines[i]; rest && *rest;) {
            char line[512];
            const double high = i ? HEIGHT : TITLE_HEIGHT;
            rest = take_line(rest, i ? FONT : TITLE_FONT, width - 2 * MARGIN, line, sizeof line);
            if (plot)
                plot_text(plot, 0.5 * width, end + 0.5 * high, "center", i ? FONT : TITLE_FONT,
                          i ? "#5a6672" : "#2a3440", line);
            end += high;
        }
    return end;
}

double plot_legend_width(const char *widest)
{
    enum { SAMPLE = 46, MARGIN = 8 };
    return SAMPLE + label_width(widest, PLOT_LEGEND_FONT) + MARGIN;
}

double plot_titles_end(const char *const lines[], int count, int width)
{
    return put_titles(NULL, lines, count, width);
}

double plot_titles(Plot *plot, const char *const lines[], int count)
{
    return put_titles(plot, lines, count, plot->width);
}

void plot_panel(Plot *plot, LabelBox panel, double legend_left, double legend_top)
{
    const double w = plot->width, h = plot->height;
    plot->panel = panel;
    *plot->field = (LabelField){.frame = panel};
    fprintf(plot_commands(plot),
            "%sset lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen %.5f\n"
            "set bmargin at screen %.5f\nset key at screen %.5f,%.5f left top Left reverse noenhanced "
            "maxcols 1 samplen 3 font ',%d'\n",
            plot->panels ? "" : "set multiplot\n", panel.left / w, panel.right / w, 1 - panel.top / h,
            1 - panel.bottom / h, legend_left / w, 1 - legend_top / h, PLOT_LEGEND_FONT);
    plot->panels = true;
}

bool plot_begin_page(Plot *plot, const char *path, const char *const titles[], int count,
                     const PlotPage *page, Error *error)
{
    enum { LEFT = 84, ABOVE = 14, LEGEND = 12, TICS = 14, LINE = 17 };
    const double top = plot_titles_end(titles, count, page->width) + ABOVE, bottom = top + page->height,
                 right = page->width - LEGEND - page->legend;
    if (!plot_begin(plot, path, page->width, (int)bottom + TICS + LINE * page->lines, error))
        return false;
    plot_titles(plot, titles, count);
    plot_panel(plot, (LabelBox){LEFT, top, right, bottom}, right + LEGEND, top);
    return true;
}

/* Writes tics at round numbers, as many as the length has room for; those of gnuplot over many decades. */
static void put_tics(const char *which, const PlotAxis *axis, FILE *gnuplot)
{
    static const double few[] = {1, 2, 5}, many[] = {1, 1.5, 2, 3, 4, 5, 7};
    const double length = axis->high - axis->low;
    const bool close = length < 1;
    const double *steps = close ? many : few;
    const int step_count = close ? 7 : 3;
    int tics = 0;
    fprintf(gnuplot, "set %stics %s", which, length > 2.5 ? "autofreq\n" : "(");
    if (length > 2.5)
        return;
    for (int power = (int)floor(axis->low); power <= (int)ceil(axis->high); power++)
        for (int k = 0; k < step_count; k++)
            fprintf(gnuplot, "%s%.9g", tics++ ? ", " : "", steps[k] * pow(10, power));
    fputs(")\n", gnuplot);
}

void plot_axis(Plot *plot, const char *which, double low, double high, bool logarithmic)
{
    FILE *gnuplot = plot_commands(plot);
    PlotAxis *axis = &plot->axis[which[0] == 'y'];
    *axis = (PlotAxis){logarithmic, logarithmic ? log10(low) : low, logarithmic ? log10(high) : high};
    fprintf(gnuplot, "set %srange [%.9g:%.9g]\n", which, low, high);
    if (!logarithmic)
        return;
    fprintf(gnuplot, "set logscale %s\nset format %s '%%g'\n%s", which, which,
            which[0] == 'x' ? "set mxtics 10\n" : "");
    put_tics(which, axis, gnuplot);
}

void plot_tics_at(Plot *plot, const char *which, const double values[], int count)
{
    FILE *gnuplot = plot_commands(plot);
    fprintf(gnuplot, "unset m%stics\nset %stics (", which, which);
    for (int i = 0; i < count; i++)
        fprintf(gnuplot, "%s'%.3g' %.9g", i ? ", " : "", values[i], values[i]);
    fputs(")\n", gnuplot);
}

/* ---- series ---- */

/* Adds an entry to the plot of the panel. */
static void add_entry(Plot *plot, const char *entry, const char *title)
{
    fprintf(plot->series, "%s%s", plot->entered ? ", " : "plot ", entry);
    fputs(title ? " title " : " notitle", plot->series);
    if (title)
        quote(plot->series, title);
    plot->entered = true;
}

FILE *plot_commands(Plot *plot)
{
    if (plot->open)
        fputs("EOD\n", plot->gnuplot);
    if (plot->open && plot->points > 0)
        add_entry(plot, plot->entry, *plot->title ? plot->title : NULL);
    plot->open = false;
    return plot->gnuplot;
}

void plot_series(Plot *plot, const char *title, const char *style, ...)
{
    va_list arguments;
    fprintf(plot_commands(plot), "$b%d << EOD\n", ++plot->blocks);
    const int used = snprintf(plot->entry, sizeof plot->entry, "$b%d using 1:2 ", plot->blocks);
    va_start(arguments, style);
    vsnprintf(plot->entry + used, sizeof plot->entry - (size_t)used, style, arguments);
    va_end(arguments);
    snprintf(plot->title, sizeof plot->title, "%s", title ? title : "");
    plot->points = 0;
    plot->open = true;
}

static double part_of(const PlotAxis *axis, double value)
{
    return ((axis->logarithmic ? log10(value) : value) - axis->low) / (axis->high - axis->low);
}

static double x_of(const Plot *plot, double x)
{
    return plot->panel.left + part_of(&plot->axis[0], x) * (plot->panel.right - plot->panel.left);
}

static double y_of(const Plot *plot, double y)
{
    return plot->panel.bottom + part_of(&plot->axis[1], y) * (plot->panel.top - plot->panel.bottom);
}

void plot_point(Plot *plot, double x, double y)
{
    const bool known = isfinite(x) && isfinite(y);
    if (known)
        fprintf(plot->gnuplot, "%.9g %.9g\n", x, y);
    else
        fputc('\n', plot->gnuplot);
    plot->points += known;
    if (known && plot->panels)
        label_field_point(plot->field, x_of(plot, x), y_of(plot, y));
}

void plot_drop(Plot *plot)
{
    plot->points = 0;
}

void plot_function(Plot *plot, const char *title, const char *style, ...)
{
    char entry[512];
    va_list arguments;
    va_start(arguments, style);
    vsnprintf(entry, sizeof entry, style, arguments);
    va_end(arguments);
    plot_commands(plot);
    add_entry(plot, entry, title);
}

void plot_bars(Plot *plot, const char *const titles[], const int colours[], size_t count)
{
    enum { LEAST = 4 }; /* a panel has room for as many bars: a single bar is no wall */
    const double middle = 0.5 * ((double)count - 1), half = 0.5 * fmax((double)count, LEAST) + 0.1;
    plot_axis(plot, "x", middle - half, middle + half, false);
    fprintf(plot_commands(plot),
            "set style data histograms\nset style histogram rowstacked\nset style fill solid noborder\n"
            "set boxwidth 0.7\nset yrange [0:*]\n$b%d << EOD\n",
            ++plot->blocks);
    for (plot->columns = 0; titles[plot->columns]; plot->columns++) {
        char entry[64];
        const int c = plot->columns;
        snprintf(entry, sizeof entry, "$b%d using %d%s lt %d", plot->blocks, c + 2, c ? "" : ":xtic(1)",
                 colours ? colours[c] : c + 1);
        add_entry(plot, entry, titles[c]);
    }
    plot->points = 0;
    plot->open = true;
}

void plot_bar(Plot *plot, const double values[], const char *name)
{
    fprintf(plot->gnuplot, "\"%s\"", name);
    for (int c = 0; c < plot->columns; c++)
        fprintf(plot->gnuplot, " %.6g", values[c]);
    fputc('\n', plot->gnuplot);
}

double plot_bar_width(const char *name)
{
    enum { LEAST = 72, GAP = 12 };
    double widest = LEAST;
    for (const char *line = name; line;) {
        char text[256];
        const char *end = strstr(line, "\\n");
        snprintf(text, sizeof text, "%.*s", end ? (int)(end - line) : (int)strlen(line), line);
        widest = fmax(widest, label_width(text, PLOT_FONT) + GAP);
        line = end ? end + 2 : NULL;
    }
    return widest;
}

void plot_draw(Plot *plot, const char *nothing)
{
    FILE *gnuplot = plot_commands(plot);
    fflush(plot->series);
    if (!plot->entered && nothing)
        fprintf(gnuplot, "unset logscale\nset label '%s' at graph 0.1,0.5\n", nothing);
    if (plot->entered)
        fwrite(plot->entries, 1, plot->entries_size, gnuplot);
    else
        fputs("plot [0:1] 0 notitle", gnuplot);
    fputs("\nunset label\nunset arrow\nunset object\nunset logscale\n", gnuplot);
    rewind(plot->series);
    plot->entered = false;
}

/* ---- labels of points ---- */

static const double POINT = 5;     /* half the side of a point's box, px */
static const double LINE_STEP = 6; /* between the boxes along a line, px */
static const double PX = 4.0 / 3;  /* of a point */

/* Advance widths of DejaVu Sans from the blank on, in 1/2048 of its size. */
static const short advances[] = {
    651,  821,  942,  1716, 1303, 1946, 1597, 563,  799,  799,  1024, 1716, 651,  739,  651,  690,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 690,  690,  1716, 1716, 1716, 1087,
    2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587, 1540, 604,  604,  1343, 1141, 1767, 1532, 1612,
    1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403, 799,  690,  799,  1716, 1024,
    1024, 1255, 1300, 1126, 1300, 1260, 721,  1300, 1298, 569,  569,  1186, 569,  1995, 1298, 1253,
    1300, 1300, 842,  1067, 803,  1298, 1212, 1675, 1212, 1212, 1075, 1303, 690,  1303, 1716};
enum { FIRST_LETTER = ' ', LETTERS = sizeof advances / sizeof *advances, WIDEST = 2048 };

static bool label_boxes_overlap(const LabelBox *a, const LabelBox *b)
{
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

double label_width(const char *text, double font)
{
    double width = 0;
    for (const unsigned char *c = (const unsigned char *)text; *c; c++)
        if ((*c & 0xc0) != 0x80) /* the first byte of a letter */
            width += *c - FIRST_LETTER < LETTERS ? advances[*c - FIRST_LETTER] : WIDEST;
    return PX * font * width / 2048;
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

bool label_place(LabelField *field, double x, double y, double width, double height, double farthest,
                 LabelBox *place)
{
    enum { NEAREST = 8, STEP = 7 }; /* from the point, px */
    for (int lines = 1; lines >= 0; lines--)
        for (int far = NEAREST; far < farthest; far += STEP)
            if (place_around(field, x, y, far, lines, width, height, place)) {
                if (field->taken_count < LABEL_TAKEN_MAX)
                    field->taken[field->taken_count++] = *place;
                return true;
            }
    return false;
}

void plot_keep_off(Plot *plot, double x0, double y0, double x1, double y1)
{
    label_field_line(plot->field, x_of(plot, x0), y_of(plot, y0), x_of(plot, x1), y_of(plot, y1));
}

bool plot_label(Plot *plot, double x, double y, const char *text, double farthest)
{
    static const double FONT = 8, HEIGHT = 12, GAP = 4; /* a blank between names side by side */
    const double px = x_of(plot, x), py = y_of(plot, y), w = plot->width, h = plot->height;
    LabelBox place;
    if (!label_place(plot->field, px, py, label_width(text, FONT) + GAP, HEIGHT, farthest, &place))
        return false;
    plot_text(plot, 0.5 * (place.left + place.right), 0.5 * (place.top + place.bottom), "center", FONT,
              "#000000", text);
    const double to_x = fmin(fmax(px, place.left), place.right),
                 to_y = fmin(fmax(py, place.top), place.bottom);
    if (hypot(to_x - px, to_y - py) > HEIGHT)
        fprintf(plot->gnuplot,
                "set arrow from screen %.5f,%.5f to screen %.5f,%.5f nohead lw 0.5 lc '#8795a3'\n", px / w,
                1 - py / h, to_x / w, 1 - to_y / h);
    return true;
}
