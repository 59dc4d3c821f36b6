#include "render/pbsr/layer_words.h"

#include "render/pbsr/data_pieces.h"
#include "render/pbsr/opacity.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* "surface 120 of head": the level is in the file's unit, which is unknown. */
static void words_of_file(const PbsrLayer *said, char words[LAYER_WORDS_SIZE])
{
    const char *slash = strrchr(said->file, '/'), *file = slash ? slash + 1 : said->file;
    const char *dot = strrchr(file, '.'), *name = pbsr_layer_name(said->of);
    const int length = (int)(dot && dot > file ? dot - file : (ptrdiff_t)strlen(file));
    const bool slice = said->of >= PBSR_SLICE_X && said->of <= PBSR_SLICE_Z;
    snprintf(words, LAYER_WORDS_SIZE, "%s %.4g%s of %.*s", name, said->level, slice ? " m" : "",
             length < 32 ? length : 32, file);
}

void layer_words(const PbsrLayer *said, char words[LAYER_WORDS_SIZE])
{
    const char *name = pbsr_layer_name(said->of);
    const bool usual = said->of == PBSR_SURFACE && said->level == 0.5;
    if (pbsr_of_file(said))
        words_of_file(said, words);
    else if (said->of == PBSR_VOLUME || said->of == PBSR_SOLIDS || usual)
        snprintf(words, LAYER_WORDS_SIZE, "%s", name);
    else if (said->of == PBSR_SURFACE)
        snprintf(words, LAYER_WORDS_SIZE, "%s at %.4g", name, said->level);
    else if (said->of >= PBSR_SLICE_X && said->of <= PBSR_SLICE_Z)
        snprintf(words, LAYER_WORDS_SIZE, "%s at %.4g m", name, said->level);
    else if (said->of < PBSR_SCALARS)
        snprintf(words, LAYER_WORDS_SIZE, "%s %.4g m", name, said->level);
    else {
        const char *unit = scalar_unit((Scalar)(said->of - PBSR_SCALARS));
        snprintf(words, LAYER_WORDS_SIZE, "%s %.4g%s%s", name, said->level, *unit ? " " : "", unit);
    }
}

/* Text collected so far. */
typedef struct Words {
    char *text;
    size_t size, used;
} Words;

static void __attribute__((format(printf, 2, 3))) add(Words *words, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int added = vsnprintf(words->text + words->used, words->size - words->used, format, list);
    va_end(list);
    words->used += added > 0 ? (size_t)added : 0;
    if (words->used >= words->size)
        words->used = words->size - 1;
}

static const char *part_from(const Words *words)
{
    return words->used > 0 ? "; " : "";
}

/* True if no part of the layer is in the fluid, or the level is reached nowhere. */
static bool is_missing(const Layer *layer, const StillLayer *still)
{
    for (size_t i = 0; i < layer->point_count; i++)
        if (layer->point[i].inside >= 0)
            return false;
    return still->sets == 0 && still->pieces.point_count == 0;
}

/* Layer numbers start at 1. */
static void add_part(Words *words, int number, const char *name, double opacity, double part)
{
    if (part < 1)
        add(words, "%slayer %d, %s, is %.2g opaque where it is nearest, not %.2g", part_from(words), number,
            name, 1 - pow(1 - fmin(opacity, OPACITY_MOST), part), opacity);
}

/* Adds the sampler's note about its points. */
static void add_note(Words *words, int number, const char *name, const StillLayer *still)
{
    if (still->sets > 0 && still->note[0])
        add(words, "%slayer %d, %s: %s", part_from(words), number, name, still->note);
}

/* Adds notes about a fluid layer with a walk. */
static void add_walk(Words *words, int number, const PbsrLayer *said, const FluidWalk *walk)
{
    char name[LAYER_WORDS_SIZE];
    layer_words(said, name);
    if (walk->why && said->opacity > 0)
        add(words, "%slayer %d, %s, is of triangles: %s", part_from(words), number, name, walk->why);
    else if (walk->walks)
        add_part(words, number, name, said->opacity, still_layer_part(&walk->still));
    add_note(words, number, name, &walk->still);
}

/* All solids form one layer: the solid with the lowest part decides. */
static void add_solids(Words *words, int number, const PbsrLayer *said, const SolidLayers *solids)
{
    double part = 1;
    if (solids->count == 0)
        add(words, "%snothing of layer %d, solids: the scene has none", part_from(words), number);
    for (int i = 0; i < solids->count; i++) {
        const StillLayer *still = &solids->still[i];
        if (still->trouble.message[0] && still->sets == 0)
            add(words, "%ssolid %d is not in layer %d: %s", part_from(words), i + 1, number,
                still->trouble.message);
        part = fmin(part, still_layer_part(still));
        add_note(words, number, "solids", still);
    }
    add_part(words, number, "solids", said->opacity, part);
}

static void add_layer(Words *words, int number, const PbsrLayer *said, const Layer *layer,
                      const StillLayer *still, bool walks)
{
    char name[LAYER_WORDS_SIZE];
    const double part = fmin(still_layer_part(still), walks ? 1 : layer_part(layer_pieces(still, layer)));
    layer_words(said, name);
    if (!(said->opacity > 0))
        return; /* invisible as requested */
    if (still->trouble.message[0] && still->sets == 0 && still->pieces.point_count == 0)
        add(words, "%sno layer %d, %s: %s", part_from(words), number, name, still->trouble.message);
    else if (is_missing(layer, still))
        add(words, "%snothing of layer %d, %s", part_from(words), number, name);
    else
        add_part(words, number, name, said->opacity, part);
    add_note(words, number, name, still);
}

/* Reports keys of the scene without effect. */
static void add_idle(Words *words, int number, const PbsrLayer *said, double curved)
{
    const double *at = said->position, *axis = said->axis;
    const bool moved = at[0] != 0 || at[1] != 0 || at[2] != 0, turned = said->angle_deg != 0;
    if ((moved || turned) && !pbsr_still(said))
        add(words, "%sposition and angle of layer %d have no effect: it stays where it is in the box",
            part_from(words), number);
    else if (turned && axis[0] == 0 && axis[1] == 0 && axis[2] == 0)
        add(words, "%slayer %d is not turned: its axis is [0, 0, 0]", part_from(words), number);
    if (said->sampler == PBSR_SAMPLER_WALK && !fluid_walk_said(said) &&
        (!pbsr_still(said) || data_pieces_are(said)))
        add(words, "%ssampler of layer %d has no effect: its points fall on it at random", part_from(words),
            number);
    if (curved > 0 && (pbsr_still(said) || said->of == PBSR_SOLIDS || fluid_walk_said(said)))
        add(words, "%scurved has no effect on layer %d: it is no surface of the fluid by triangles",
            part_from(words), number);
    if (said->interpolation != PBSR_BY_ITSELF && !pbsr_of_file(said) && !fluid_walk_by_grid(said))
        add(words,
            said->of == PBSR_SURFACE
                ? "%sinterpolation of layer %d has no effect: it is no walk on the fluid's surface; set sampler: walk"
                : "%sinterpolation of layer %d has no effect: it is of no file, and no walk on the fluid's surface",
            part_from(words), number);
}

/* Kept points in GPU memory have no colours from the fluid. */
static void add_grey(Words *words, int number, const PbsrLayer *said)
{
    char name[LAYER_WORDS_SIZE];
    layer_words(said, name);
    if (pbsr_painted(said) && said->opacity > 0)
        add(words, "%slayer %d, %s, is grey: the fluid's colours are the CPU's, with view.pbsr.method: cpu",
            part_from(words), number, name);
}

size_t layers_lack(const LayersDrawn *drawn, char *text, size_t size)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    Words words = {text, size, 0};
    text[0] = '\0';
    pbsr_layers(drawn->def, said);
    for (int i = 0; i < drawn->layers->count; i++)
        if (said[i].of != PBSR_SOLIDS)
            add_layer(&words, i + 1, &said[i], &drawn->layers->layers[i], &drawn->still[i],
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
    if (drawn->over_lacks)
        add(&words, "%slines and arrows lie behind all layers: the GPU has no memory for their depths",
            part_from(&words));
    if (drawn->layers->fluid.enlarged > 1)
        add(&words, "%scells of %.3g spacings, not %.3g, of which there would be too many", part_from(&words),
            drawn->layers->fluid.enlarged * drawn->def->cell, drawn->def->cell);
    return words.used;
}
