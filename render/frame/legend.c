#include "render/frame/frame.h"

#include "render/frame/effect.h"
#include "render/frame/view.h"
#include "render/ui/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TICKS_MOST = 7, SCALAR_WIDTH_EM = 8, SCALAR_HEIGHT_EM = 15, CURVE_ROWS = 2 };

static const float ROW_EM = 1.4F; /* of the lines below the panel */

/* Of a picture's width: in a small picture, the legend covers a part of the box rather than leave no room for
   the box. The middle of the picture must stay free, from where camera_make looks for the largest box. */
static const double MOST_ROOM = 0.45;

/* Positions in units of the letter height: the legend grows with the picture. */
typedef struct LegendLayout {
    float em;
    float left, top, right, bottom; /* the panel's sides */
    uint32_t ink, faint, panel;
} LegendLayout;

static bool looks_like_water(const FluidDef *fluid)
{
    const float *color = fluid->color;
    return strstr(fluid->name, "water") || strstr(fluid->name, "Water") ||
           (color[2] > 2 * color[0] && color[2] > color[1]);
}

/* The fluid's name, with the viscosity if the fluid looks like water but flows very differently. A
   viscosity that changes with time is not shown: the legend would change its width, and the camera its
   position. */
static void fluid_words(const FluidDef *fluid, char words[NAME_SIZE + 32])
{
    static const double WATER = 1.0e-3, FAR = 10; /* Pa s, at 20 degrees */
    const double mu = fluid->viscosity;
    const bool shown = looks_like_water(fluid) && fluid->viscosity_table.rows == 0 && mu > 0 &&
                       (mu >= FAR * WATER || mu <= WATER / FAR);
    snprintf(words, NAME_SIZE + 32, "%s", fluid->name);
    if (shown)
        snprintf(words + strlen(words), 32, ", %.3g Pa s", mu);
}

float legend_text_pixels(int height)
{
    float pixels = floorf((float)height / 40);
    return pixels < 11 ? 11 : pixels;
}

/* Estimate, in letter heights. */
static double fluids_width_em(const WorldDef *world)
{
    double letters = 0;
    for (int i = 0; i < world->fluid_count; i++) {
        char words[NAME_SIZE + 32];
        fluid_words(&world->fluids[i], words);
        letters = fmax(letters, (double)strlen(words));
    }
    return 3.3 + 0.6 * letters;
}

static double fluids_height_em(const WorldDef *world)
{
    return 1.6 * world->fluid_count + 0.9;
}

double legend_width_pixels(const ViewDef *def, const WorldDef *world, int height)
{
    const bool fluids = view_color_by(def) == SCALAR_FLUID;
    if (!def->legend || (fluids && world->fluid_count == 0))
        return 0;
    return ((fluids ? fluids_width_em(world) : SCALAR_WIDTH_EM) + 1) * legend_text_pixels(height);
}

static double room_width_em(const WorldDef *world)
{
    return fmax(fluids_width_em(world), SCALAR_WIDTH_EM);
}

CoveredParts legend_room(const ViewDef *def, const WorldDef *world, int width, int height)
{
    const double em = legend_text_pixels(height), around = 1; /* to the picture's edges */
    const int curves = (def->opacity.by != 0) + (def->size.by != 0);
    if (!def->legend)
        return (CoveredParts){0};
    const double right = (room_width_em(world) + around) * em / width;
    const double top = (fmax(fluids_height_em(world), SCALAR_HEIGHT_EM) + around) * em / height;
    return (CoveredParts){.right = fmin(right, MOST_ROOM),
                          .top = top + curves * CURVE_ROWS * ROW_EM * em / height};
}

int legend_ticks(double min, double max, int most, double ticks[], int *decimals)
{
    static const double round_steps[] = {1, 2, 5, 10};
    double rough = (max - min) / (most - 1), power = pow(10, floor(log10(rough))), step = 10 * power;
    for (int i = 3; i >= 0; i--)
        if (round_steps[i] * power >= rough * (1 - 1e-9))
            step = round_steps[i] * power;
    int count = 0;
    *decimals = (int)fmax(0, -floor(log10(step) + 1e-9));
    for (double k = ceil(min / step - 1e-6); k * step <= max + 1e-6 * step && count < most; k++)
        ticks[count++] = k * step + 0.0; /* no negative zero */
    return count;
}

void legend_unit(const char *unit, char out[32])
{
    size_t length = strlen(unit), used = 0;
    for (size_t i = 0; i < length && used + 3 < 32; i++) {
        bool power = i > 0 && (unit[i] == '2' || unit[i] == '3');
        if (power)
            out[used++] = (char)0xC2;
        out[used++] = unit[i] == '2' && power ? (char)0xB2 : unit[i] == '3' && power ? (char)0xB3 : unit[i];
    }
    out[used] = 0;
}

static bool legend_text_is_dark(const ViewDef *def)
{
    const double *back = def->background;
    return 0.2126 * back[0] + 0.7152 * back[1] + 0.0722 * back[2] > 0.18;
}

uint32_t legend_text_color(const ViewDef *def)
{
    return legend_text_is_dark(def) ? 0x1c222aff : 0xf2f4f6ff;
}

static LegendLayout make_layout(const Text *text, const Frame *frame, float width_em, float height_em)
{
    const uint32_t ink = legend_text_color(frame->def);
    float em = text_height(text), right = (float)frame->width - em;
    return (LegendLayout){.em = em,
                          .left = right - width_em * em,
                          .right = right,
                          .top = em,
                          .bottom = em + height_em * em,
                          .ink = ink,
                          .faint = (ink & 0xffffff00) | 0xb8,
                          .panel = legend_text_is_dark(frame->def) ? 0xffffffa0 : 0x10141880};
}

static uint32_t map_color(const uint8_t *rgb, int i)
{
    return (uint32_t)rgb[3 * i] << 24 | (uint32_t)rgb[3 * i + 1] << 16 | (uint32_t)rgb[3 * i + 2] << 8 | 255;
}

/* A colour bar, with a pointed end where values exceed the range. */
static void draw_bar(Text *text, const ViewDef *def, const bool beyond[2], float x0, float y0, float x1,
                     float y1)
{
    enum { PIECES = 51 }; /* 255 = 5 * 51 */
    uint8_t rgb[3 * COLORMAP_SIZE];
    if (!colormap_fill_bent(view_colormap(def), &def->color_curve, rgb))
        return;
    for (int i = 0; i < PIECES; i++) {
        float low = y1 + (y0 - y1) * (float)i / PIECES, high = y1 + (y0 - y1) * (float)(i + 1) / PIECES;
        text_gradient(text, x0, high, x1, low, map_color(rgb, 5 * i), map_color(rgb, 5 * (i + 1)));
    }
    const float tip = 0.6F * (x1 - x0), x[3] = {x0, x1, 0.5F * (x0 + x1)};
    if (beyond[0])
        text_triangle(text, x, (const float[3]){y1, y1, y1 + tip}, map_color(rgb, 0));
    if (beyond[1])
        text_triangle(text, x, (const float[3]){y0, y0, y0 - tip}, map_color(rgb, 255));
}

static void draw_ticks(Text *text, const LegendLayout *layout, const double range[2], float x, float y0,
                       float y1)
{
    double ticks[TICKS_MOST];
    int decimals, count = legend_ticks(range[0], range[1], TICKS_MOST, ticks, &decimals);
    for (int i = 0; i < count; i++) {
        char label[32];
        double share = (ticks[i] - range[0]) / (range[1] - range[0]);
        float y = y1 + (y0 - y1) * (float)share;
        if (fabs(ticks[i]) >= 1e6 || decimals > 5)
            snprintf(label, sizeof label, "%.3g", ticks[i]);
        else
            snprintf(label, sizeof label, "%.*f", decimals, ticks[i]);
        text_rectangle(text, x, y - 0.5F, x + 0.3F * layout->em, y + 0.5F, 0, layout->ink);
        text_draw(text, x + 0.55F * layout->em, y - 0.5F * layout->em, 1, layout->ink, TEXT_LEFT, label);
    }
}

/* Number of bytes of a line that fit into `width`: breaks at spaces, takes at least one word. */
static size_t line_bytes(Text *text, const char *line, float width)
{
    char part[512];
    size_t bytes = strcspn(line, " ");
    while (line[bytes]) {
        const size_t end = bytes + 1 + strcspn(line + bytes + 1, " ");
        snprintf(part, sizeof part, "%.*s", (int)end, line);
        if (end >= sizeof part || text_width(text, 1, part) > width)
            break;
        bytes = end;
    }
    return bytes;
}

/* Draws words from `top` down, in letter heights, in lines as wide as the room of the legend. Returns their
   end. */
static float draw_rows(Text *text, const Frame *frame, float top, const char *words)
{
    enum { LINE_MOST = 512 };
    const LegendLayout layout = make_layout(text, frame, 0, top);
    const float width = fminf((float)room_width_em(frame->world) * layout.em, layout.right - layout.em);
    const char *rest = words;
    while (*rest) {
        char line[LINE_MOST];
        const size_t bytes = line_bytes(text, rest, width);
        snprintf(line, sizeof line, "%.*s", (int)bytes, rest);
        text_draw(text, layout.right, (1 + top) * layout.em, 1, layout.ink, TEXT_RIGHT, line);
        top += ROW_EM;
        rest += bytes + strspn(rest + bytes, " ");
    }
    return top;
}

static void number_words(double number, char out[16])
{
    snprintf(out, 16, fabs(number) >= 1e3 && fabs(number) < 1e6 ? "%.0f" : "%.3g", number);
}

/* "opacity: pressure" and "0 to 2000 Pa" below the panel. */
static float draw_curve(Text *text, const Frame *frame, float top, const char *what, const ScalarCurve *curve,
                        const double range[2])
{
    char unit[32], label[96], numbers[2][16];
    legend_unit(scalar_unit(scalar_of_curve(curve)), unit);
    snprintf(label, sizeof label, "%s: %s", what, scalar_name(scalar_of_curve(curve)));
    top = draw_rows(text, frame, top, label);
    number_words(range[0], numbers[0]);
    number_words(range[1], numbers[1]);
    snprintf(label, sizeof label, "%s to %s%s%s", numbers[0], numbers[1], *unit ? " " : "", unit);
    return draw_rows(text, frame, top, label);
}

/* Legend lines of opacity and size, if the view draws these curves. `bottom`: lower side of the panels
   above, in letter heights. */
static void draw_curves(Text *text, const Frame *frame, float bottom)
{
    const ViewDef *def = frame->def;
    float top = bottom + 0.5F;
    if (frame->curves.drawn & VIEW_OPACITY && def->opacity.by != 0)
        top = draw_curve(text, frame, top, "opacity", &def->opacity, frame->curves.opacity);
    if (frame->curves.drawn & VIEW_SIZE && def->size.by != 0)
        draw_curve(text, frame, top, "size", &def->size, frame->curves.size);
}

/* Returns the height in letter heights, as does draw_fluids. */
static float draw_scalar(Text *text, const Frame *frame)
{
    char unit[32], title[80];
    legend_unit(frame->colors.unit, unit);
    snprintf(title, sizeof title, "%s%s%s", frame->colors.name, *unit ? ", " : "", unit);
    const float widest = text_width(text, 1, title) / text_height(text) + 1.6F; /* room for long names */
    LegendLayout layout = make_layout(text, frame, fmaxf(SCALAR_WIDTH_EM, widest), SCALAR_HEIGHT_EM);
    float em = layout.em, x = layout.left + 0.8F * em, y0 = layout.top + 3.0F * em,
          y1 = layout.bottom - 1.0F * em;
    text_rectangle(text, layout.left, layout.top, layout.right, layout.bottom, 0.5F * em, layout.panel);
    text_draw(text, x, layout.top + 0.8F * em, 1, layout.ink, TEXT_LEFT, title);
    draw_bar(text, frame->def, frame->colors.beyond, x, y0, x + 1.2F * em, y1);
    draw_ticks(text, &layout, frame->colors.range, x + 1.2F * em, y0, y1);
    return SCALAR_HEIGHT_EM;
}

static float encode(float linear)
{
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * powf(linear, 1 / 2.4F) - 0.055F;
}

static uint32_t fluid_rgba(const float linear[3])
{
    uint32_t rgba = 0;
    for (int k = 0; k < 3; k++)
        rgba = rgba << 8 | (uint32_t)(255 * encode(fminf(fmaxf(linear[k], 0), 1)) + 0.5F);
    return rgba << 8 | 255;
}

static float draw_fluids(Text *text, const Frame *frame)
{
    const WorldDef *world = frame->world;
    float widest = 0;
    char words[FLUIDS_MAX][NAME_SIZE + 32];
    for (int i = 0; i < world->fluid_count; i++) {
        fluid_words(&world->fluids[i], words[i]);
        widest = fmaxf(widest, text_width(text, 1, words[i]) / text_height(text));
    }
    const float height = (float)fluids_height_em(world);
    LegendLayout layout = make_layout(text, frame, widest + 3.3F, height);
    float em = layout.em, x = layout.left + 0.8F * em;
    text_rectangle(text, layout.left, layout.top, layout.right, layout.bottom, 0.5F * em, layout.panel);
    for (int i = 0; i < world->fluid_count; i++) {
        float y = layout.top + (0.75F + 1.6F * (float)i) * em;
        text_rectangle(text, x, y, x + em, y + em, 0.5F * em, fluid_rgba(world->fluids[i].color));
        text_draw(text, x + 1.6F * em, y, 1, layout.ink, TEXT_LEFT, words[i]);
    }
    return height;
}

/* Draws parts below `top`, in letter heights. */
static float draw_parts(Text *text, const Frame *frame, float top)
{
    const float em = text_height(text);
    uint8_t rgb[3 * COLORMAP_SIZE];
    float widest = 0;
    for (int i = 0; i < frame->colors.part_count; i++)
        widest = fmaxf(widest, text_width(text, 1, frame->colors.parts[i].words) / em);
    const float gap = top > 0 ? 0.5F : 0, height = 1.6F * (float)frame->colors.part_count + 0.9F;
    const LegendLayout layout = make_layout(text, frame, widest + 3.3F, top + gap + height);
    const float x = layout.left + 0.8F * em, first = layout.bottom - (height - 0.75F) * em;
    text_rectangle(text, layout.left, layout.bottom - height * em, layout.right, layout.bottom, 0.5F * em,
                   layout.panel);
    const bool bent = colormap_fill_bent(view_colormap(frame->def), &frame->def->color_curve, rgb);
    for (int i = 0; i < frame->colors.part_count; i++) {
        const FramePart *part = &frame->colors.parts[i];
        const float y = first + 1.6F * (float)i * em;
        if (part->own)
            text_rectangle(text, x, y, x + em, y + em, 0.2F * em, fluid_rgba(part->color));
        else if (bent && !frame->colors.by_fluid)
            text_gradient(text, x, y, x + em, y + em, map_color(rgb, 0), map_color(rgb, 255));
        text_draw(text, x + 1.6F * em, y, 1, layout.ink, TEXT_LEFT, part->words);
    }
    return top + gap + height;
}

/* Draws the meaning of the colours; returns the height in letter heights. */
static float draw_colors(Text *text, const Frame *frame)
{
    if (frame->colors.none)
        return 0;
    if (!frame->colors.by_fluid)
        return draw_scalar(text, frame);
    return frame->world->fluid_count > 0 ? draw_fluids(text, frame) : 0;
}

/* Draws a line of text at x, y (pixels from the left and the top) in faint ink. */
static void draw_line(Text *text, const Frame *frame, float x, float y, const char *line)
{
    const LegendLayout layout = make_layout(text, frame, 0, 0);
    text_draw(text, x, y, 1, layout.faint, TEXT_LEFT, line);
}

/* The overlays' lines, from the lower left corner up, above the line of the time. */
static void draw_overlay_lines(Text *text, const Picture *picture)
{
    const float em = text_height(text), bottom = (float)picture->frame.height;
    OverlayLine lines[OVERLAY_KINDS_MAX];
    const int count = overlays_legend(picture->overlays, &picture->frame, lines);
    for (int i = 0; i < count; i++)
        draw_line(text, &picture->frame, em, bottom - (3.6F + 1.6F * (float)i) * em, lines[i].words);
}

/* Draws an arrow along gravity below `top`, in letter heights, unless gravity is towards the floor. Returns
   the lower end. */
static float draw_gravity(Text *text, const Picture *picture, float top)
{
    static const double MOST_UPRIGHT = 0.9998; /* cosine of one degree */
    static const char word[] = "gravity";
    const double *gravity = picture->gravity;
    const float *view = picture->frame.camera.view, em = text_height(text);
    const double size = sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    const uint32_t ink = make_layout(text, &picture->frame, 0, 0).faint;
    float way[2] = {0, 0};
    if (!(size > 0) || -gravity[1] > MOST_UPRIGHT * size)
        return top;
    for (int k = 0; k < 3; k++) {
        way[0] += (float)(view[4 * k] * gravity[k] / size);
        way[1] -= (float)(view[4 * k + 1] * gravity[k] / size);
    }
    const float right = (float)picture->frame.width - em, y = (top + 2.6F) * em;
    const float x = right - text_width(text, 1, word) - 1.4F * em;
    const float tip[2] = {x + em * way[0], y + em * way[1]};
    const float neck[2] = {x + 0.3F * em * way[0], y + 0.3F * em * way[1]};
    text_line(text, x - em * way[0], y - em * way[1], neck[0], neck[1], 0.14F * em, ink);
    text_triangle(text, (float[3]){tip[0], neck[0] - 0.3F * em * way[1], neck[0] + 0.3F * em * way[1]},
                  (float[3]){tip[1], neck[1] + 0.3F * em * way[0], neck[1] - 0.3F * em * way[0]}, ink);
    text_draw(text, right, y - 0.5F * em, 1, ink, TEXT_RIGHT, word);
    return top + 3.2F;
}

static void draw_legend(Text *text, const Picture *picture)
{
    const Frame *frame = &picture->frame;
    const float em = text_height(text);
    char label[40];
    snprintf(label, sizeof label, "%.2f s", picture->time);
    draw_line(text, frame, em, (float)frame->height - 2 * em, label);
    float bottom = draw_colors(text, frame);
    if (frame->colors.part_count > 0)
        bottom = draw_parts(text, frame, bottom);
    if (picture->note)
        bottom = draw_rows(text, frame, bottom + 0.5F, picture->note);
    bottom = draw_gravity(text, picture, bottom);
    if (bottom > 0)
        draw_curves(text, frame, bottom);
    draw_overlay_lines(text, picture);
}

/* In letter heights: around the words, and between the lines. */
static const float AROUND = 0.55F, BETWEEN = 0.35F;

/* The longest beginning of `words` that is at most `width` wide. */
static void cut_text(Text *text, float width, const char *words, char out[TITLE_SIZE])
{
    size_t length = strlen(words);
    snprintf(out, TITLE_SIZE, "%s", words);
    while (length > 0 && text_width(text, 1, out) > width) {
        length--;
        while (length > 0 && ((unsigned char)words[length] & 0xC0) == 0x80) /* inside a UTF-8 letter */
            length--;
        snprintf(out, TITLE_SIZE, "%.*s...", (int)fmin((double)length, TITLE_SIZE - 4), words);
    }
}

/* From the top of the picture to the bottom of the title, in letter heights. */
static float bottom_em(const Title *title)
{
    return 2 + 2 * AROUND + (*title->figures ? BETWEEN + 1 : 0);
}

int title_rows(const Title *title, int height)
{
    return *title->words ? (int)ceilf(bottom_em(title) * legend_text_pixels(height)) : 0;
}

/* Leaves room for the legend: wider text is cut and ends with "...". */
static void draw_title(Text *text, const Title *title, const Frame *frame)
{
    const uint32_t ink = legend_text_color(frame->def), faint = (ink & 0xffffff00) | 0xb0,
                   panel = legend_text_is_dark(frame->def) ? 0xffffffd0 : 0x101418c0;
    const float em = text_height(text), around = AROUND * em, x = em + around;
    const float legend = (float)legend_width_pixels(frame->def, frame->world, frame->height);
    const float capacity = (float)frame->width - legend - 2 * em - 2 * around;
    char words[TITLE_SIZE], figures[TITLE_SIZE];
    if (!*title->words || capacity <= 0)
        return;
    cut_text(text, capacity, title->words, words);
    cut_text(text, capacity, title->figures, figures);
    const float width = fmaxf(text_width(text, 1, words), text_width(text, 1, figures));
    text_rectangle(text, em, em, x + width + around, bottom_em(title) * em, 0.5F * em, panel);
    text_draw(text, x, em + around, 1, ink, TEXT_LEFT, words);
    text_draw(text, x, em + around + (1 + BETWEEN) * em, 1, faint, TEXT_LEFT, figures);
}

/* Draws the def's title, `view.title`, in the middle of the free lower edge; smaller if too wide. */
static void draw_caption(Text *text, const Frame *frame)
{
    static const float LARGE = 1.6F, LEAST = 0.5F;
    const char *words = frame->def->title;
    const uint32_t ink = legend_text_color(frame->def),
                   panel = legend_text_is_dark(frame->def) ? 0xffffffd0 : 0x101418c0;
    const float em = text_height(text), covered = fmaxf(frame->camera.centre[0], 0);
    const float capacity = (float)frame->width * (1 - covered) - 4 * em,
                wide = text_width(text, LARGE, words);
    if (!*words || capacity <= 0)
        return;
    const float scale = wide > capacity ? fmaxf(LARGE * capacity / wide, LEAST) : LARGE;
    const float middle = (0.5F + 0.5F * covered) * (float)frame->width, half = wide * scale / LARGE / 2;
    const float around = AROUND * em, bottom = (float)frame->height - 1.6F * em, top = bottom - scale * em;
    text_rectangle(text, middle - half - around, top - around, middle + half + around, bottom + around,
                   0.5F * em, panel);
    text_draw(text, middle, top, scale, ink, TEXT_CENTER, words);
}

bool has_letters(const ViewDef *def, const Title *title)
{
    return def->legend || *title->words || *def->title;
}

static bool words_wanted(const Picture *picture)
{
    return has_letters(picture->frame.def, picture->title);
}

static void draw_words(void *state, Picture *picture)
{
    const Frame *frame = &picture->frame;
    (void)state;
    text_begin(picture->text, frame->width, frame->height);
    if (frame->def->legend)
        draw_legend(picture->text, picture);
    draw_title(picture->text, picture->title, frame);
    draw_caption(picture->text, frame);
    text_end(picture->text);
}

const Effect effect_words = {
    .name = "words", .stage = STAGE_OVERLAY, .wanted = words_wanted, .draw = draw_words};
