/* The settings of the view pbsr: keys, names, and what follows from them for a layer. */
#include "render/views/pbsr/pbsr_private.h"
#include "sim/box/motion_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const PbsrDef pbsr_usual = {.repeat = 64, .budget = 40, .cell = 0.75, .points = 1.2e7, .seed = 1};

/* The layer of an empty list. */
static const PbsrLayer usual_layer = {
    .of = PBSR_SURFACE, .level = 0.5, .opacity = 0.4, .formula = "none", .file = "none", .axis = {0, 1, 0}};

static const char *const sampler_names[] = {
    [PBSR_SAMPLER_AUTO] = "auto", [PBSR_SAMPLER_WALK] = "walk", [PBSR_SAMPLER_TRIANGLES] = "triangles", NULL};

static const char *interpolation_name(int index)
{
    return index == PBSR_BY_ITSELF ? "auto"
                                   : volume_interpolation_name((VolumeInterpolation)(index - PBSR_BY_GRID));
}

const char *pbsr_layer_name(int index)
{
    static const char *const names[PBSR_SCALARS] = {
        [PBSR_SURFACE] = "surface", [PBSR_VOLUME] = "volume",   [PBSR_SLICE_X] = "slice_x",
        [PBSR_SLICE_Y] = "slice_y", [PBSR_SLICE_Z] = "slice_z", [PBSR_SPHERE] = "sphere",
        [PBSR_TORUS] = "torus",     [PBSR_GYROID] = "gyroid",   [PBSR_WAVE] = "wave",
        [PBSR_FORMULA] = "formula", [PBSR_SOLIDS] = "solids"};
    return index < PBSR_SCALARS ? names[index] : scalar_list[index - PBSR_SCALARS].name;
}

static const char *const method_names[] = {
    [PBSR_AUTO] = "auto", [PBSR_CPU] = "cpu", [PBSR_GPU] = "gpu", NULL};

static void layer_init(void *element, int index)
{
    (void)index;
    *(PbsrLayer *)element = usual_layer;
}

#define AT(field)    offsetof(PbsrDef, field)
#define LAYER(field) offsetof(PbsrLayer, field)

#define LAYER_ROWS(KIND, NAME, HELP) MOTION_ROWS("view.pbsr.layers[].motion[]", KIND, NAME, HELP)

/* clang-format off */
const Key pbsr_keys[] = {
    MAPPING("view.pbsr", "of the view pbsr: transparent layers of points, without sorting"),
    LIST("view.pbsr.layers", 0, 0, PBSR_LAYERS_MAX, AT(layers), AT(layer_count), PbsrLayer, layer_init,
         "surfaces, slices and volume, which may cross each other; none: the fluid's surface alone"),
    CHOICE("view.pbsr.layers[].of", L | KEY_INDEX, pbsr_layer_name, LAYER(of),
           "surface: the fluid's; volume: the fluid itself; slice_x, slice_y, slice_z: a plane across that axis; sphere, torus, gyroid, wave: such a surface about the middle of the box; formula: where one of your own has the level; solids: those of the scene, which are opaque without such a layer; a scalar: where it has the level. With a file surface, volume and slices are of its data"),
    TEXT("view.pbsr.layers[].formula", KEY_POINTER, FORMULA_SIZE, LAYER(formula), NULL,
         "with of: formula, of x, y and z, m, in the box's frame; numbers, pi, + - * / ^, sin cos tan exp log sqrt abs tanh sinh cosh, min(a, b), max(a, b); the surface ends at the box's sides"),
    FILE_TEXT("view.pbsr.layers[].file", 0, LAYER(file), NULL, "volume data that the layer is of instead of the fluid: its header, a small .yaml beside the raw values, found from the scene's folder; or points with normals, a .ply: 0.5 on the surface through them, 1 inside"),
    CHOICE("view.pbsr.layers[].interpolation", L | KEY_INDEX, interpolation_name, LAYER(interpolation), "of a file: between its values; auto: trilinear. Of the fluid's surface with sampler walk: between the values of the grid; auto: the sum over the particles themselves"),
    CHOICE_OF("view.pbsr.layers[].sampler", L | KEY_INDEX, sampler_names, LAYER(sampler), "how points come onto a surface. walk: by a Brownian walk on it, on the fluid on the sum over its particles; triangles: by marching cubes; auto: walk, and triangles on the fluid and on a formula of one's own"),
    VEC3("view.pbsr.layers[].position", L, "m", -1e6, 1e6, LAYER(position), "of slices and what is no fluid: moved by that, in the box's frame; no points of what is no fluid are made anew"),
    VEC3("view.pbsr.layers[].axis", L, "", -1000, 1000, LAYER(axis), "of slices and what is no fluid: what it is turned about, through its middle"),
    NUMBER("view.pbsr.layers[].angle", L, "degrees", -360, 360, LAYER(angle_deg), "of slices and what is no fluid: how far it is turned"),
    LIST("view.pbsr.layers[].motion", KEY_POINTER, 0, MOTIONS_MAX, LAYER(motions), LAYER(motion_count), Motion, NULL,
         "of slices and what is no fluid: how it moves in the box over simulated time; all together, turns about its middle"),
    MOTION_LIST(LAYER_ROWS)
    NUMBER("view.pbsr.layers[].level", L, "", -1e30, 1e30, LAYER(level),
           "of surface: of the field, which is 0.5 where a fluid ends at a plane; of a slice: its place on the axis, m, in the box's frame; of a scalar or a file: in its unit; of a formula: its value; m: radius of sphere and torus, period of gyroid, height of wave"),
    NUMBER("view.pbsr.layers[].opacity", L, "", 0, 1, LAYER(opacity),
           "of what is seen from the front, tilted it is more; of volume: of fluid one spacing deep, or of a file's greatest value as deep as its shortest side"),
    COLOR("view.pbsr.layers[].color", L, LAYER(color), NULL, "sRGB: [red, green, blue], each 0 to 1; black: what view.color_by says, of a formula where it is in the fluid; of a file: its values; of solids: their own"),
    INTEGER("view.pbsr.repeat", L, 1, 4096, AT(repeat), "sets of points that a picture is the mean of, once nothing moves: noise falls with its root"),
    INTEGER("view.pbsr.moving", L, 0, 4096, AT(moving), "the same while something moves in the window or in bench, and what each picture at rest adds; auto, 0: by the budget", .zero = "auto"),
    NUMBER("view.pbsr.budget", L | O, "ms", 0, 1e5, AT(budget), "of wall time for the sets of a picture, where moving is 0 and the CPU projects; the GPU has eight sets"),
    NUMBER("view.pbsr.cell", L | O, "spacings", 0, 10, AT(cell), "side of a cell of the grid on which layers are found"),
    NUMBER("view.pbsr.curved", L, "", 0, 100, AT(curved), "of the fluid's surfaces by triangles: where one is bent there are up to so many times as many points more, so that drops and rims stand out; density is 1 + curved min(h / R, 1) times what opacity says, with the support radius h and the radius of curvature R"),
    NUMBER("view.pbsr.edges", L, "", 0, 100, AT(edges), "of surfaces: where one is seen edge on there are so many times as many points more, so that outlines stand out; by theta from the normal density is 1 + edges (1 - cos theta)^4 times what opacity says"),
    NUMBER("view.pbsr.points", L, "", 1e5, 2e9, AT(points), "of a layer that does not change with the fluid the points that are kept, 24 bytes each: they are dealt to as many of the sets of repeat, at least one, which may have 48 million whatever this says; all solids share those of one layer"),
    CHOICE_OF("view.pbsr.method", L | KEY_INDEX | KEY_REBUILD, method_names, AT(method), "who strews and projects points, and walks on the surfaces of formulas; auto: the CPU on a software driver, whose memory is the CPU's, else the GPU"),
    INTEGER("view.pbsr.seed", L, 0, 1000000000, AT(seed), "of the points: the same gives the same picture"),
    KEYS_END,
};
/* clang-format on */

const ViewGrade pbsr_grades[] = {
    {"view.pbsr.repeat", {"4", "16", "64", "256"}, NULL, NULL, true},
    {"view.pbsr.cell", {"2", "1.5", "1", "0.75", "0.5"}, NULL, NULL, false},
    {0},
};

int pbsr_files(const ViewDef *def, ViewFile files[VIEW_FILES_MAX])
{
    PbsrDef *own = pbsr_def(def);
    int count = 0;
    for (int i = 0; i < own->layer_count; i++) {
        PbsrLayer *layer = &own->layers[i];
        if (!pbsr_is_of_file(layer))
            continue;
        ViewFile *file = &files[count++];
        *file = (ViewFile){.name = layer->file, .data = &layer->data};
        snprintf(file->key, sizeof file->key, "pbsr.layers[%d].file", i);
        if (layer->of > PBSR_SLICE_Z)
            file->wrong = "of a file a layer is a surface, volume, slice_x, slice_y or slice_z; leave `file` "
                          "out for what is of the fluid or a formula";
    }
    return count;
}

bool pbsr_is_of_file(const PbsrLayer *layer)
{
    return formula_given(layer->file);
}

VolumeInterpolation pbsr_interpolation(const PbsrLayer *layer)
{
    return layer->interpolation == PBSR_BY_ITSELF
               ? VOLUME_TRILINEAR
               : (VolumeInterpolation)(layer->interpolation - PBSR_BY_GRID);
}

bool pbsr_is_rigid(const PbsrLayer *layer)
{
    return pbsr_is_of_file(layer) || (layer->of >= PBSR_SPHERE && layer->of <= PBSR_FORMULA);
}

bool pbsr_is_slice(const PbsrLayer *layer)
{
    return !pbsr_is_rigid(layer) && layer->of >= PBSR_SLICE_X && layer->of <= PBSR_SLICE_Z;
}

bool pbsr_has_color(const PbsrLayer *layer)
{
    return layer->color[0] > 0 || layer->color[1] > 0 || layer->color[2] > 0;
}

bool pbsr_takes_fluid_colors(const PbsrLayer *layer)
{
    return pbsr_is_rigid(layer) && !pbsr_is_of_file(layer) && !pbsr_has_color(layer);
}

int pbsr_layers(const PbsrDef *def, PbsrLayer layers[PBSR_LAYERS_MAX])
{
    layers[0] = usual_layer;
    memcpy(layers, def->layers, (size_t)def->layer_count * sizeof *layers);
    return def->layer_count > 0 ? def->layer_count : 1;
}

/* Rotation about an axis by an angle: O. Rodrigues, 1840. */
void rigid_rotation(const PbsrLayer *said, double turn[3][3])
{
    const double *a = said->axis, length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double angle = length > 0 ? said->angle_deg * M_PI / 180 : 0, by = length > 0 ? 1 / length : 0;
    const double n[3] = {a[0] * by, a[1] * by, a[2] * by}, c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turn[i][k] = (1 - c) * n[i] * n[k] + (i == k ? c : 0);
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, m = (i + 2) % 3;
        turn[i][k] -= s * n[m];
        turn[k][i] += s * n[m];
    }
}

/* Adds the motions: as solid_pose of a solid. */
static void move_layer(PbsrLayer *layer, double time)
{
    const double *axis = layer->axis,
                 length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double half = length > 0 ? layer->angle_deg * M_PI / 360 : 0,
                 by = length > 0 ? sin(half) / length : 0;
    const double own[4] = {by * axis[0], by * axis[1], by * axis[2], cos(half)};
    BoxState pose;
    double *turn = pose.orientation;
    box_state_at(layer->motions, layer->motion_count, 0, time, &pose);
    quat_multiply(turn, own, turn);
    for (int k = 0; k < 3; k++) {
        layer->position[k] += pose.position[k];
        layer->axis[k] = turn[k];
    }
    layer->angle_deg =
        360 / M_PI * atan2(sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]), turn[3]);
}

int pbsr_layers_at(const PbsrDef *def, double time, PbsrLayer layers[PBSR_LAYERS_MAX])
{
    const int count = pbsr_layers(def, layers);
    for (int i = 0; i < count; i++)
        if (layers[i].motion_count > 0)
            move_layer(&layers[i], time);
    return count;
}

uint64_t pbsr_scalars(const PbsrDef *def)
{
    uint64_t scalars = 0;
    for (int i = 0; i < def->layer_count; i++)
        if (def->layers[i].of >= PBSR_SCALARS)
            scalars |= SCALAR_BIT(def->layers[i].of - PBSR_SCALARS);
    return scalars;
}
