#include "render/frame/passes.h"
#include "render/renderer.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One panel. */
typedef struct PanelView {
    Renderer *renderer;
    ViewDef def;
    WorldDef world;
} PanelView;

struct Panels {
    int count, width, height;
    int marked;          /* -1: none */
    double covered_left; /* fraction of the width */
    PanelRect places[PANELS_MAX];
    PanelView panels[PANELS_MAX];
};

/* Two equal parts of a length; an odd pixel goes to the line between. */
static void halve(int from, int length, int begin[2], int size[2])
{
    size[0] = size[1] = (length - PANELS_LINE) / 2;
    begin[0] = from;
    begin[1] = from + length - size[1];
}

/* Three panels below one another. */
static void stack(int width, int height, PanelRect places[PANELS_MAX])
{
    const int each = (height - 2 * PANELS_LINE) / 3, begin[3] = {0, (height - each) / 2, height - each};
    for (int i = 0; i < 3; i++)
        places[i] = (PanelRect){0, begin[i], width, each};
}

bool panels_layout(int count, int width, int height, PanelRect places[PANELS_MAX])
{
    int x[2], y[2], w[2], h[2];
    halve(0, width, x, w);
    halve(0, height, y, h);
    places[0] = (PanelRect){0, 0, width, height};
    for (int i = 0; count > 1 && i < count; i++) {
        const int column = count == 2 ? i : count == 3 ? i > 0 : i % 2;
        const int row = count == 3 ? i > 1 : i / 2;
        const bool whole = count == 2 || (count == 3 && i == 0);
        places[i] = (PanelRect){x[column], whole ? 0 : y[row], w[column], whole ? height : h[row]};
    }
    if (count == 3 && height > width)
        stack(width, height, places);
    for (int i = 0; i < count; i++)
        if (places[i].width < 1 || places[i].height < 1)
            return false;
    return true;
}

int panels_index_at(const PanelRect places[], int count, double x, double y)
{
    int nearest = 0;
    double least = INFINITY;
    for (int i = 0; i < count; i++) {
        const PanelRect *at = &places[i];
        const double dx = fmax(fmax(at->x - x, x - (at->x + at->width)), 0);
        const double dy = fmax(fmax(at->y - y, y - (at->y + at->height)), 0);
        if (dx + dy < least) {
            least = dx + dy;
            nearest = i;
        }
    }
    return nearest;
}

/* A single panel extends under the covered part of the picture; several panels lie beside. */
static bool place(int count, int width, int height, double covered_left, PanelRect places[PANELS_MAX],
                  Error *error)
{
    const int beside = count > 1 ? (int)lround(covered_left * width) : 0;
    if (!panels_layout(count, width - beside, height, places))
        return error_set(error, "a picture of %d x %d pixels has no room for %d panels; make it larger",
                         width - beside, height, count);
    for (int i = 0; i < count; i++)
        places[i].x += beside;
    return true;
}

Panels *panels_create(const Subject subjects[], int count, int width, int height, Error *error)
{
    Panels *panels = calloc(1, sizeof *panels);
    if (!panels) {
        error_set(error, "out of memory for %d pictures", count);
        return NULL;
    }
    *panels = (Panels){.count = count, .width = width, .height = height, .marked = -1};
    bool made = place(count, width, height, 0, panels->places, error);
    for (int i = 0; made && i < count; i++) {
        PanelView *panel = &panels->panels[i];
        panel->def = *subjects[i].def;
        panel->world = *subjects[i].world;
        panel->renderer = renderer_create(&panel->def, &panel->world, panels->places[i].width,
                                          panels->places[i].height, error);
        made = panel->renderer != NULL;
    }
    if (made)
        return panels;
    panels_destroy(panels);
    return NULL;
}

Renderer *panels_renderer(const Panels *panels, int index)
{
    return panels->panels[index].renderer;
}

void panels_set_presents(Panels *panels, bool presents)
{
    for (int i = 0; i < panels->count; i++)
        renderer_set_presents(panels_renderer(panels, i), presents && panels->count == 1);
}

void panels_destroy(Panels *panels)
{
    for (int i = 0; panels && i < panels->count; i++)
        renderer_destroy(panels->panels[i].renderer);
    free(panels);
}

void panels_set_marked(Panels *panels, int index)
{
    panels->marked = index;
}

void panels_set_continuous(Panels *panels, bool more)
{
    for (int i = 0; i < panels->count; i++)
        renderer_set_continuous(panels_renderer(panels, i), more);
}

bool panels_unfinished(const Panels *panels)
{
    bool any = false;
    for (int i = 0; i < panels->count; i++)
        any = any || renderer_unfinished(panels_renderer(panels, i));
    return any;
}

bool panels_can_improve(const Panels *panels)
{
    bool any = false, keeps = false;
    for (int i = 0; i < panels->count; i++) {
        any |= renderer_can_improve(panels_renderer(panels, i));
        keeps |= renderer_keeps_states(panels_renderer(panels, i));
    }
    return any && !keeps;
}

int panels_count(const Panels *panels)
{
    return panels->count;
}

const PanelRect *panels_rects(const Panels *panels)
{
    return panels->places;
}

bool panels_set_def(Panels *panels, int index, const ViewDef *def, const WorldDef *world, Error *error)
{
    PanelView *panel = &panels->panels[index];
    if (!renderer_set_def(panel->renderer, def, world, error))
        return false;
    panel->def = *def;
    panel->world = *world;
    return true;
}

bool panels_set_title(Panels *panels, int index, const Title *title, Error *error)
{
    return renderer_set_title(panels->panels[index].renderer, title, error);
}

/* Resizes all panels or none. */
static bool lay_out(Panels *panels, int width, int height, double covered_left, Error *error)
{
    PanelRect places[PANELS_MAX];
    Error none;
    if (!place(panels->count, width, height, covered_left, places, error))
        return false;
    for (int i = 0; i < panels->count; i++) {
        if (renderer_resize(panels->panels[i].renderer, places[i].width, places[i].height, error))
            continue;
        while (i-- > 0) /* back to the old sizes */
            renderer_resize(panels->panels[i].renderer, panels->places[i].width, panels->places[i].height,
                            &none);
        return false;
    }
    memcpy(panels->places, places, sizeof places);
    panels->width = width;
    panels->height = height;
    panels->covered_left = covered_left;
    return true;
}

bool panels_resize(Panels *panels, int width, int height, Error *error)
{
    return (width == panels->width && height == panels->height) ||
           lay_out(panels, width, height, panels->covered_left, error);
}

bool panels_set_covered(Panels *panels, double left, Error *error)
{
    return left == panels->covered_left || lay_out(panels, panels->width, panels->height, left, error);
}

void panels_set_late(Panels *panels, bool late)
{
    for (int i = 0; i < panels->count; i++)
        renderer_set_late(panels->panels[i].renderer, late);
}

bool panels_are_stale(const Panels *panels)
{
    bool stale = false;
    for (int i = 0; i < panels->count; i++)
        stale |= renderer_is_stale(panels->panels[i].renderer);
    return stale;
}

CoveredParts panels_legend(const Panels *panels, int index)
{
    const PanelRect *at = &panels->places[index];
    CoveredParts widest = {0};
    for (int i = 0; i < panels->count; i++) {
        const PanelView *panel = &panels->panels[i];
        widest = covered_by_both(widest, legend_room(&panel->def, &panel->world, at->width, at->height));
    }
    return widest;
}

static void cover(Panels *panels)
{
    for (int i = 0; i < panels->count; i++) {
        CoveredParts covered = panels_legend(panels, i);
        covered.left = panels->count > 1 ? 0 : panels->covered_left;
        renderer_set_covered(panels->panels[i].renderer, covered);
    }
}

/* The joint range of all states with a range of this scalar. */
static ScalarRange joint_range(const ParticleBuffers states[], int count, int scalar)
{
    ScalarRange joint = {.known = true};
    for (int i = 0; i < count; i++) {
        const ScalarRange *own = &states[i].range[scalar];
        if (!own->known || !own->any)
            continue;
        joint.low = joint.any ? fmin(joint.low, own->low) : own->low;
        joint.high = joint.any ? fmax(joint.high, own->high) : own->high;
        joint.least = joint.any ? fmin(joint.least, own->least) : own->least;
        joint.greatest = joint.any ? fmax(joint.greatest, own->greatest) : own->greatest;
        joint.any = true;
    }
    return joint;
}

/* Gives a scalar the same range in all panels with automatic ranges. */
static void join_ranges(ParticleBuffers states[], int count)
{
    for (int s = 0; s < SCALAR_COUNT; s++) {
        const ScalarRange joint = joint_range(states, count, s);
        for (int i = 0; i < count; i++)
            if (states[i].range[s].known)
                states[i].range[s] = joint;
    }
}

/* Takes data that another panel has derived from the same state. */
static void take_over(const ParticleBuffers *from, ParticleBuffers *to)
{
    const ParticleAttribute *a = &from->position, *b = &to->position;
    if (a->buffer != b->buffer || a->offset != b->offset || from->count != to->count ||
        from->step != to->step || from->time != to->time)
        return;
    for (int s = 0; s < SCALAR_COUNT; s++) {
        if (!to->scalar[s].buffer)
            to->scalar[s] = from->scalar[s];
        if (!to->range[s].known)
            to->range[s] = from->range[s];
    }
    for (int v = 0; v < VECTOR_COUNT; v++)
        if (!to->vector[v].buffer)
            to->vector[v] = from->vector[v];
}

size_t panels_derived_bytes(const Panels *panels, int index)
{
    return renderer_derived_bytes(panels->panels[index].renderer);
}

void panels_draw(Panels *panels, const ParticleBuffers *const states[], GlTimer *timer)
{
    ParticleBuffers with[PANELS_MAX];
    cover(panels);
    for (int i = 0; i < panels->count; i++) {
        with[i] = *states[i];
        for (int j = 0; j < i; j++)
            take_over(&with[j], &with[i]);
        if (panels->count > 1) /* a single panel derives when drawing */
            GL_STAGE(timer, STAGE_SCALARS)
            {
                renderer_derive(panels->panels[i].renderer, &with[i]);
            }
    }
    join_ranges(with, panels->count);
    for (int i = 0; i < panels->count; i++)
        renderer_draw(panels->panels[i].renderer, &with[i], timer);
}

void panels_add_state(Panels *panels, int index, const ParticleBuffers *state)
{
    renderer_add_state(panels->panels[index].renderer, state, NULL);
}

void panels_range(const Panels *panels, int index, double range[2])
{
    renderer_range(panels->panels[index].renderer, range);
}

void panels_curve_ranges(const Panels *panels, int index, double opacity[2], double size[2])
{
    renderer_curve_ranges(panels->panels[index].renderer, opacity, size);
}

/* sRGB colour of the line between panels. */
static void line_color(const Panels *panels, uint8_t rgb[3])
{
    const uint32_t ink = legend_text_color(&panels->panels[0].def);
    for (int k = 0; k < 3; k++)
        rgb[k] = (uint8_t)(ink >> (24 - 8 * k));
}

bool panels_read(const Panels *panels, uint8_t *rgb, Error *error)
{
    const size_t width = (size_t)panels->width, height = (size_t)panels->height;
    uint8_t line[3];
    line_color(panels, line);
    if (panels->count == 1) {
        renderer_read(panels->panels[0].renderer, rgb);
        return true;
    }
    uint8_t *one = malloc(3 * width * height); /* each panel is smaller than the picture */
    if (!one)
        return error_set(error, "out of memory for a picture of %d x %d", panels->width, panels->height);
    for (size_t i = 0; i < width * height; i++)
        memcpy(rgb + 3 * i, line, 3);
    for (int i = 0; i < panels->count; i++) {
        const PanelRect *at = &panels->places[i];
        const size_t row = 3 * (size_t)at->width;
        renderer_read(panels->panels[i].renderer, one);
        for (size_t y = 0; y < (size_t)at->height; y++)
            memcpy(rgb + 3 * (((size_t)at->y + y) * width + (size_t)at->x), one + y * row, row);
    }
    free(one);
    return true;
}

/* Fills a rectangle of the default framebuffer. */
static void fill(const Panels *panels, int x, int y, int width, int height)
{
    glScissor(x, panels->height - y - height, width, height);
    glClear(GL_COLOR_BUFFER_BIT);
}

static void draw_mark(const Panels *panels, const PanelRect *at)
{
    enum { THICK = 2 };
    glEnable(GL_SCISSOR_TEST);
    glClearColor(0.16F, 0.48F, 0.85F, 1);
    fill(panels, at->x, at->y, at->width, THICK);
    fill(panels, at->x, at->y + at->height - THICK, at->width, THICK);
    fill(panels, at->x, at->y, THICK, at->height);
    fill(panels, at->x + at->width - THICK, at->y, THICK, at->height);
    glDisable(GL_SCISSOR_TEST);
}

void panels_present(const Panels *panels)
{
    uint8_t line[3];
    line_color(panels, line);
    if (panels->count > 1) {
        const GLfloat color[4] = {line[0] / 255.0F, line[1] / 255.0F, line[2] / 255.0F, 1};
        glDisable(GL_FRAMEBUFFER_SRGB); /* the colour is encoded already */
        glDisable(GL_SCISSOR_TEST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glClearBufferfv(GL_COLOR, 0, color);
    }
    for (int i = 0; i < panels->count; i++) {
        const PanelRect *at = &panels->places[i];
        renderer_present(panels->panels[i].renderer, at->x, panels->height - at->y - at->height);
    }
    if (panels->count > 1 && panels->marked >= 0)
        draw_mark(panels, &panels->places[panels->marked]);
    glViewport(0, 0, panels->width, panels->height);
}
