#include "render/views/pbsr/pbsr_private.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* "surface 120 of head": the level is in the file's unit, which is unknown. */
static void words_of_file(const PbsrLayer *said, char words[LAYER_TEXT_SIZE])
{
    const char *slash = strrchr(said->file, '/'), *file = slash ? slash + 1 : said->file;
    const char *dot = strrchr(file, '.'), *name = pbsr_layer_name(said->of);
    const int length = (int)(dot && dot > file ? dot - file : (ptrdiff_t)strlen(file));
    const bool slice = said->of >= PBSR_SLICE_X && said->of <= PBSR_SLICE_Z;
    snprintf(words, LAYER_TEXT_SIZE, "%s %.4g%s of %.*s", name, said->level, slice ? " m" : "",
             length < 32 ? length : 32, file);
}

static bool is_moved(const PbsrLayer *said)
{
    const double *at = said->position;
    return at[0] != 0 || at[1] != 0 || at[2] != 0 || said->angle_deg != 0 || said->motion_count > 0;
}

void layer_text(const PbsrLayer *said, char words[LAYER_TEXT_SIZE])
{
    const char *name = pbsr_layer_name(said->of);
    const bool usual = said->of == PBSR_SURFACE && said->level == 0.5;
    if (pbsr_is_of_file(said))
        words_of_file(said, words);
    else if (said->of == PBSR_VOLUME || said->of == PBSR_SOLIDS || usual)
        snprintf(words, LAYER_TEXT_SIZE, "%s", name);
    else if (said->of == PBSR_SURFACE)
        snprintf(words, LAYER_TEXT_SIZE, "%s at %.4g", name, said->level);
    else if (said->of >= PBSR_SLICE_X && said->of <= PBSR_SLICE_Z)
        snprintf(words, LAYER_TEXT_SIZE, "%s at %.4g m%s", name, said->level,
                 is_moved(said) ? ", moved" : "");
    else if (said->of == PBSR_FORMULA)
        snprintf(words, LAYER_TEXT_SIZE, "%.40s = %.4g", said->formula, said->level);
    else if (said->of < PBSR_SCALARS)
        snprintf(words, LAYER_TEXT_SIZE, "%s %.4g m", name, said->level);
    else {
        const char *unit = scalar_unit((Scalar)(said->of - PBSR_SCALARS));
        snprintf(words, LAYER_TEXT_SIZE, "%s %.4g%s%s", name, said->level, *unit ? " " : "", unit);
    }
}

/* Text collected so far. */
typedef struct TextBuffer {
    char *text;
    size_t size, used;
} TextBuffer;

static void __attribute__((format(printf, 2, 3))) add(TextBuffer *words, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int added = vsnprintf(words->text + words->used, words->size - words->used, format, list);
    va_end(list);
    words->used += added > 0 ? (size_t)added : 0;
    if (words->used >= words->size)
        words->used = words->size - 1;
}

static const char *part_from(const TextBuffer *words)
{
    return words->used > 0 ? "; " : "";
}

/* True if no part of the layer is in the fluid, or the level is reached nowhere. */
static bool is_missing(const LayerPieces *layer, const RigidLayer *rigid)
{
    if (layer->on_gpu && layer->there)
        return false;
    for (size_t i = 0; i < layer->point_count; i++)
        if (layer->point[i].inside >= 0)
            return false;
    return rigid->sets == 0 && rigid->pieces.point_count == 0;
}

/* Layer numbers start at 1. */
static void add_part(TextBuffer *words, int number, const char *name, double opacity, double part)
{
    if (part < 1)
        add(words, "%slayer %d, %s, is %.2g opaque where it is nearest, not %.2g", part_from(words), number,
            name, 1 - pow(1 - fmin(opacity, OPACITY_MOST), part), opacity);
}

/* Adds the sampler's note about its points. */
static void add_note(TextBuffer *words, int number, const char *name, const RigidLayer *rigid)
{
    if (rigid->sets > 0 && rigid->note[0])
        add(words, "%slayer %d, %s: %s", part_from(words), number, name, rigid->note);
}

/* Adds notes about a fluid layer with a walk. */
static void add_walk(TextBuffer *words, int number, const PbsrLayer *said, const FluidWalk *walk)
{
    char name[LAYER_TEXT_SIZE];
    layer_text(said, name);
    if (walk->why && said->opacity > 0)
        add(words, "%slayer %d, %s, is of triangles: %s", part_from(words), number, name, walk->why);
    else if (walk->walks)
        add_part(words, number, name, said->opacity, rigid_layer_fraction(&walk->rigid));
    add_note(words, number, name, &walk->rigid);
}

/* All solids form one layer: the solid with the lowest part decides. */
static void add_solids(TextBuffer *words, int number, const PbsrLayer *said, const SolidLayers *solids)
{
    double part = 1;
    if (solids->count == 0)
        add(words, "%snothing of layer %d, solids: the scene has none", part_from(words), number);
    for (int i = 0; i < solids->count; i++) {
        const RigidLayer *rigid = &solids->rigid[i];
        if (rigid->trouble.message[0] && rigid->sets == 0)
            add(words, "%ssolid %d is not in layer %d: %s", part_from(words), i + 1, number,
                rigid->trouble.message);
        part = fmin(part, rigid_layer_fraction(rigid));
        add_note(words, number, "solids", rigid);
    }
    add_part(words, number, "solids", said->opacity, part);
}

static void add_layer(TextBuffer *words, int number, const PbsrLayer *said, const LayerPieces *layer,
                      const RigidLayer *rigid, bool walks)
{
    char name[LAYER_TEXT_SIZE];
    const double part = fmin(rigid_layer_fraction(rigid), walks ? 1 : layer_part(layer_pieces(rigid, layer)));
    layer_text(said, name);
    if (!(said->opacity > 0))
        return; /* invisible as requested */
    if (rigid->trouble.message[0] && rigid->sets == 0 && rigid->pieces.point_count == 0)
        add(words, "%sno layer %d, %s: %s", part_from(words), number, name, rigid->trouble.message);
    else if (is_missing(layer, rigid))
        add(words, "%snothing of layer %d, %s", part_from(words), number, name);
    else
        add_part(words, number, name, said->opacity, part);
    add_note(words, number, name, rigid);
}

/* Reports keys of the scene without effect. */
static void add_idle(TextBuffer *words, int number, const PbsrLayer *said, double curved)
{
    const double *at = said->position, *axis = said->axis;
    const bool moved = at[0] != 0 || at[1] != 0 || at[2] != 0, turned = said->angle_deg != 0;
    if ((moved || turned || said->motion_count > 0) && !pbsr_is_rigid(said) && !pbsr_is_slice(said))
        add(words, "%sposition, angle and motion of layer %d have no effect: it stays where it is in the box",
            part_from(words), number);
    else if (turned && axis[0] == 0 && axis[1] == 0 && axis[2] == 0)
        add(words, "%slayer %d is not turned: its axis is [0, 0, 0]", part_from(words), number);
    if (formula_given(said->formula) && (said->of != PBSR_FORMULA || pbsr_is_of_file(said)))
        add(words, "%sformula of layer %d has no effect: it is no layer of: formula", part_from(words),
            number);
    if (said->sampler == PBSR_SAMPLER_WALK && !fluid_walk_wanted(said) &&
        (!pbsr_is_rigid(said) || data_pieces_wanted(said)))
        add(words, "%ssampler of layer %d has no effect: its points fall on it at random", part_from(words),
            number);
    if (curved > 0 && (pbsr_is_rigid(said) || said->of == PBSR_SOLIDS || fluid_walk_wanted(said)))
        add(words, "%scurved has no effect on layer %d: it is no surface of the fluid by triangles",
            part_from(words), number);
    if (said->interpolation != PBSR_BY_ITSELF && !pbsr_is_of_file(said) && !fluid_walk_by_grid(said))
        add(words,
            said->of == PBSR_SURFACE
                ? "%sinterpolation of layer %d has no effect: it is no walk on the fluid's surface; set sampler: walk"
                : "%sinterpolation of layer %d has no effect: it is of no file, and no walk on the fluid's surface",
            part_from(words), number);
}

/* Kept points in GPU memory have no colours from the fluid. */
static void add_grey(TextBuffer *words, int number, const PbsrLayer *said)
{
    char name[LAYER_TEXT_SIZE];
    layer_text(said, name);
    if (pbsr_takes_fluid_colors(said) && said->opacity > 0)
        add(words, "%slayer %d, %s, is grey: the fluid's colours are the CPU's, with view.pbsr.method: cpu",
            part_from(words), number, name);
}

size_t layers_describe_missing(const DrawnLayers *drawn, char *text, size_t size)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    TextBuffer words = {text, size, 0};
    text[0] = '\0';
    pbsr_layers(drawn->def, said);
    for (int i = 0; i < drawn->layers->count; i++)
        if (said[i].of != PBSR_SOLIDS)
            add_layer(&words, i + 1, &said[i], &drawn->layers->layers[i], &drawn->rigid[i],
                      drawn->walks[i].walks);
        else if (said[i].opacity > 0 && i == solid_layers_number(drawn->def))
            add_solids(&words, i + 1, &said[i], drawn->solids);
        else if (said[i].opacity > 0)
            add(&words, "%snothing of layer %d, solids: they are in layer %d", part_from(&words), i + 1,
                solid_layers_number(drawn->def) + 1);
    for (int i = 0; i < drawn->def->layer_count; i++)
        add_idle(&words, i + 1, &said[i], drawn->def->curved);
    for (int i = 0; drawn->by_gpu && i < drawn->def->layer_count; i++)
        add_grey(&words, i + 1, &said[i]);
    for (int i = 0; i < drawn->layers->count; i++)
        add_walk(&words, i + 1, &said[i], &drawn->walks[i]);
    if (drawn->sets < drawn->def->repeat)
        add(&words, "%s%d sets, not %d: more points of a layer are not kept (view.pbsr.points)",
            part_from(&words), drawn->sets, drawn->def->repeat);
    if (drawn->uncounted)
        add(&words, "%sno memory to count points", part_from(&words));
    if (drawn->overlay_depth_missing)
        add(&words, "%slines and arrows lie behind all layers: the GPU has no memory for their depths",
            part_from(&words));
    if (drawn->layers->fluid.enlarged > 1)
        add(&words, "%scells of %.3g spacings, not %.3g, of which there would be too many", part_from(&words),
            drawn->layers->fluid.enlarged * drawn->def->cell, drawn->def->cell);
    return words.used;
}
