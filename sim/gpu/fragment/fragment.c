/* The backend fragment: its table of operations, and the passes of a substep. */
#include "sim/gpu/fragment/fragment.h"

#include "sim/base/key_rows.h"
#include "sim/box/box.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void draw(Fragment *f, FragmentPass pass, const unsigned *targets, int count)
{
    gl_state_keep(&f->caller_state);
    fragment_draw(f, pass, targets, count, f->width, f->height);
    gl_state_restore(&f->caller_state);
}

/* Called around all passes of a step, so that the context's state is queried once. */
static void fragment_enter(void *state)
{
    Fragment *f = state;
    gl_state_keep(&f->caller_state);
}

static void fragment_leave(void *state)
{
    Fragment *f = state;
    gl_state_restore(&f->caller_state);
}

static void set_drift(const Fragment *f, const BoxStep *step)
{
    const FragmentPass pass = FRAGMENT_DRIFT;
    const GLuint program = f->program[pass];
    glProgramUniform3fv(program, fragment_uniform(f, pass, FRAGMENT_rotation), 3, step->rotation[0]);
    fragment_set3(f, pass, FRAGMENT_omega0, step->omega0);
    fragment_set3(f, pass, FRAGMENT_omega1, step->omega1);
    fragment_set3(f, pass, FRAGMENT_shift, step->shift);
    fragment_set3(f, pass, FRAGMENT_velocity_change, step->velocity_change);
    fragment_set1(f, pass, FRAGMENT_dt, step->dt);
    glProgramUniform1i(program, fragment_uniform(f, pass, FRAGMENT_still), step->still ? 1 : 0);
}

static void fragment_drift(void *state, const BoxStep *step)
{
    Fragment *f = state;
    set_drift(f, step);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_HELD, f->held[0]);
    draw(f, FRAGMENT_DRIFT, (const unsigned[]){f->position[1], f->velocity[1], f->held[1]}, 3);
    fragment_swap(f->position);
    fragment_swap(f->velocity);
    fragment_swap(f->held);
}

static void sample_neighbours(const Fragment *f)
{
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_BUCKETS, f->buckets);
}

static void density(Fragment *f)
{
    sample_neighbours(f);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    draw(f, FRAGMENT_DENSITY, (const unsigned[]){f->fields, f->near, f->moving},
         f->constants->viscous ? 3 : 2);
}

static void force(Fragment *f, const ApparentGravity *gravity, float dt)
{
    fragment_set1(f, FRAGMENT_FORCE, FRAGMENT_dt, dt);
    fragment_set3(f, FRAGMENT_FORCE, FRAGMENT_apparent_origin, gravity->origin);
    fragment_set3(f, FRAGMENT_FORCE, FRAGMENT_apparent_alpha, gravity->alpha);
    fragment_set3(f, FRAGMENT_FORCE, FRAGMENT_apparent_omega, gravity->omega);
    sample_neighbours(f);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_NEAR, f->near);
    fragment_sample(FRAGMENT_SAMPLE_MOVING, f->moving);
    draw(f, FRAGMENT_FORCE, &f->acceleration, 1);
}

static void fragment_pass(void *state, const Pass *pass, const PassInput *input)
{
    if (pass->stage == STAGE_DENSITY)
        density(state);
    else
        force(state, input->apparent, input->dt);
}

static void fragment_kick(void *state, const float gravity[3], float dt)
{
    Fragment *f = state;
    fragment_set3(f, FRAGMENT_KICK, FRAGMENT_gravity, gravity);
    fragment_set1(f, FRAGMENT_KICK, FRAGMENT_dt, dt);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_ACCELERATION, f->acceleration);
    draw(f, FRAGMENT_KICK, &f->velocity[1], 1);
    fragment_swap(f->velocity);
    fragment_watch_gather(f, gravity, dt);
}

static void fragment_touch(void *state, const FingerStep *finger)
{
    Fragment *f = state;
    const GLuint program = f->program[FRAGMENT_TOUCH];
    const float *at = finger->at, *v = finger->velocity;
    glProgramUniform4f(program, fragment_uniform(f, FRAGMENT_TOUCH, FRAGMENT_finger_at), at[0], at[1], at[2],
                       finger->inverse_radius2);
    glProgramUniform4f(program, fragment_uniform(f, FRAGMENT_TOUCH, FRAGMENT_finger_velocity), v[0], v[1],
                       v[2], finger->grip);
    fragment_set1(f, FRAGMENT_TOUCH, FRAGMENT_finger_kick, finger->kick);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    draw(f, FRAGMENT_TOUCH, &f->velocity[1], 1);
    fragment_swap(f->velocity);
}

#define AT(field) offsetof(FragmentDef, field)

/* clang-format off */
static const Key keys[] = {
    INTEGER("solver.grid_layers", 0, 0, 63, AT(grid_layers),
            "layers of its grid, four particles a cell each; 0: as many as a lattice at rest needs, 7 at support 2.1; 1: paper 003's"),
    INTEGER("solver.lost_limit", 0, 0, 2000000000, AT(lost_limit),
            "so many particles may find no place in the grid in a step; more end the run"),
    KEYS_END,
};
/* clang-format on */

static void fragment_destroy(void *state)
{
    Fragment *f = state;
    fragment_textures_destroy(f);
    for (int p = 0; p < FRAGMENT_PASS_COUNT; p++)
        glDeleteProgram(f->program[p]);
    free(f);
}

/* Size of a texture for `count` texels, wide rather than high: software renderers share tiles of 64 x 64
   among their threads, and a narrow texture has few tiles. */
static void shape_for(size_t count, int *bits, int *width, int *height)
{
    enum { ROWS = 8, BITS = 12, ROWS_MOST = 16384, BITS_MOST = 14 }; /* GL 4.5 guarantees 16384 x 16384 */
    *bits = 3;
    while ((count >> *bits > ROWS && *bits < BITS) || (count >> *bits >= ROWS_MOST && *bits < BITS_MOST))
        ++*bits;
    *width = 1 << *bits;
    *height = (int)((count + (size_t)*width - 1) >> *bits);
}

/* "compute or cpu": further backends that support the def, the newest first. */
static void others_that_can(const WorldDef *def, char names[64])
{
    const Backend *const *list = backend_list();
    int count = 0, used = 0;
    while (list[count])
        count++;
    names[0] = '\0';
    while (count-- > 0) {
        const Backend *other = list[count];
        if (other != &backend_fragment && (!other->can || other->can(def, NULL)) && used < 64)
            used += snprintf(names + used, (size_t)(64 - used), "%s%s", used > 0 ? " or " : "", other->name);
    }
}

static bool lacks(const WorldDef *def, const char *what, bool asked, Error *error)
{
    char others[64];
    if (!asked)
        return false;
    others_that_can(def, others);
    return !error_set(error, "backend fragment has no %s; use backend %s", what, others);
}

static bool lacks_a_term(const WorldDef *def, Error *error)
{
    for (const Term *const *term = shared_terms; *term; term++)
        if (lacks(def, (*term)->words, (*term)->named(def), error))
            return true;
    return false;
}

FragmentDef *fragment_def(const WorldDef *def)
{
    return backend_def(def, &backend_fragment);
}

/* A lattice has at most ceil(support)^dimensions particles per cell. */
int fragment_layers(const WorldDef *def)
{
    const int given = fragment_def(def)->grid_layers;
    const double most = pow(ceil(def->support), def->dimensions);
    return given > 0 ? given : (int)ceil(most / 4);
}

static void fragment_to_raise(const void *state, char text[128])
{
    const Fragment *f = state;
    char limit[32];
    number_grouped(f->lost_limit, limit);
    snprintf(text, 128, "solver.grid_layers (%d) or solver.lost_limit (%s)", f->layers, limit);
}

static bool fragment_can(const WorldDef *def, Error *error)
{
    const FragmentDef *own = fragment_def(def);
    if (own->grid_layers < 0 || own->lost_limit < 0)
        return error_set(error, "grid_layers and lost_limit must not be negative");
    bool viscous = false, tense = false;
    for (int f = 0; f < def->fluid_count; f++) {
        viscous |= fluid_viscosity_most(&def->fluids[f]) > 0;
        tense |= def->fluids[f].surface_tension > 0;
    }
    char method[NAME_SIZE + 8];
    snprintf(method, sizeof method, "method %s", def->method);
    return !lacks(def, method, !fragment_has(method_find(def->method)), error) &&
           !lacks(def, "columns of a method's own", columns_save_own(method_find(def->method)->columns),
                  error) &&
           !lacks(def, "periodic sides", def->periodic[0] || def->periodic[1] || def->periodic[2], error) &&
           !lacks(def, "solids", def->solid_count > 0, error) &&
           !lacks(def, def->pours ? "pouring" : "emitters", flow_emits(def), error) &&
           !lacks(def, "drains", def->drain_count > 0, error) &&
           !lacks(def, "no-slip walls", viscous && def->wall_slip == SLIP_NONE, error) &&
           !lacks(def, "surface tension", tense && def->tension_model != TENSION_NONE, error) &&
           !lacks_a_term(def, error);
}

static bool fits(const Fragment *f, Error *error)
{
    GLint side = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    if (f->count > FRAGMENT_COUNT_MOST)
        return error_set(error,
                         "backend fragment holds up to %d particles, whose ids its depth buffer keeps "
                         "exactly, not %zu; use a larger spacing or backend compute",
                         FRAGMENT_COUNT_MOST, f->count);
    if (f->width > side || f->height > side || f->bucket_width > side || f->bucket_height > side)
        return error_set(error,
                         "%zu particles and %zu cells need textures larger than the %d x %d texels that "
                         "this driver allows; use a larger spacing",
                         f->count, f->constants->cells.count, side, side);
    if (f->layers > FRAGMENT_LAYERS_MOST)
        return error_set(error, "backend fragment has up to %d layers; solver.grid_layers is %d",
                         FRAGMENT_LAYERS_MOST, f->layers);
    return true;
}

/* Never (0) if a list of all particles exceeds the size of a buffer texture. */
static int order_every(const Fragment *f)
{
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return f->count <= (size_t)texels ? FRAGMENT_ORDER_EVERY : 0;
}

static bool fill(Fragment *f, const InitialState *initial, Error *error)
{
    return fragment_textures_create(f, error) && fragment_programs_create(f, error) &&
           (fragment_set_particles(f, initial) || error_set(error, "no memory for %zu particles", f->count));
}

static void *fragment_create(const Constants *constants, const WorldDef *def, const InitialState *initial,
                             size_t capacity, Error *error)
{
    (void)capacity;
    if (epoxy_gl_version() < 45) {
        error_set(error, "backend fragment needs OpenGL 4.5, and there is %d.%d", epoxy_gl_version() / 10,
                  epoxy_gl_version() % 10);
        return NULL;
    }
    Fragment *f = calloc(1, sizeof *f);
    if (!f) {
        error_set(error, "no memory");
        return NULL;
    }
    f->constants = constants;
    f->count = initial->count;
    f->layers = fragment_layers(def);
    f->flush = strstr((const char *)glGetString(GL_RENDERER), "zink") != NULL;
    f->lost_limit = (size_t)fragment_def(def)->lost_limit;
    shape_for(f->count, &f->bits, &f->width, &f->height);
    shape_for(constants->cells.count, &f->bucket_bits, &f->bucket_width, &f->bucket_height);
    if (!fits(f, error)) {
        free(f);
        return NULL;
    }
    f->order_every = order_every(f);
    if (!fill(f, initial, error)) {
        fragment_destroy(f);
        return NULL;
    }
    return f;
}

static bool fragment_adapt(void *state, Error *error)
{
    Fragment *f = state;
    char constant_lines[FRAGMENT_CONSTANTS_MAX];
    fragment_constants(f, constant_lines);
    if (!fragment_terms_create(f, error))
        return false;
    if (strcmp(constant_lines, f->constant_lines) != 0)
        return fragment_programs_create(f, error);
    fragment_set_fluids(f);
    return true;
}

static void fragment_vary(void *state)
{
    fragment_set_fluids(state);
}

static bool fragment_reload(void *state, Error *error)
{
    return fragment_programs_create(state, error);
}

const Backend backend_fragment = {
    .name = "fragment",
    .keys = keys,
    .to_raise = fragment_to_raise,
    .gpu = true,
    .scalars = UINT32_C(1) << SCALAR_LOST,
    .help = "fragment shaders on the GPU, after Harada 2007: methods with such shaders, without solids",
    .can = fragment_can,
    .create = fragment_create,
    .destroy = fragment_destroy,
    .adapt = fragment_adapt,
    .vary = fragment_vary,
    .reload = fragment_reload,
    .enter = fragment_enter,
    .leave = fragment_leave,
    .drift = fragment_drift,
    .grid = fragment_grid,
    .run = fragment_pass,
    .kick = fragment_kick,
    .touch = fragment_touch,
    .watch = fragment_watch,
    .mark = fragment_mark,
    .back = fragment_back,
    .share = fragment_share,
    .sums = fragment_sums,
    .read = fragment_read,
    .gauge = fragment_gauge,
    .gauged = fragment_gauged,
    .energy = fragment_energy,
    .save = fragment_save,
    .load = fragment_load,
    .info = fragment_info,
};
