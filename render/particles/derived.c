#include "render/particles/particles.h"

#include "shaders/derived/derived_bindings.h"
#include "shaders/shared/bindings.h"
#include "sim/def.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

_Static_assert(SCALAR_COUNT <= 64 && VECTOR_COUNT <= 32, "a bit for each in ParticleWants");

/* A formula for shaders/derived/derived.comp. Variables: `place` and `velocity` of the particle.
   `carried`: the scalar `carries`. `three`: three scalars from `threes` on. frame_velocity and frame_turn:
   velocity and turning of the box, in its axes. With `near_too`: `gradient` (of the velocity) and `slope`
   (of the scalar read); `near`: number of neighbours in the support radius; `trapped`: speed of the
   neighbours' approach. Foam has `sums` over neighbours, and `filled`: the fluid fraction of the kernel. */
typedef struct DerivedFormula {
    const char *value;   /* NULL: already in the state */
    unsigned attributes; /* PARTICLE_VELOCITY, or 0 */
    int carries;         /* a Scalar of the state, or NOTHING */
    bool near_too;       /* needs neighbours; excludes `threes` */
    int threes;          /* the first of three Scalars of the state, or 0 */
    bool births;         /* needs id and births */
    bool meets;          /* `trapped` is defined; needs `near_too` and the velocity */
} DerivedFormula;

enum { NOTHING = -1 };

/* The fraction of the kernel that is fluid, with walls mirrored, where foam is seen. A particle in a flat
   surface, half a spacing below, has 0.74; the next layer has 1. A particle in the box's corner has 0.83:
   images beyond two walls are left out. A single drop has 0.12, a pair 0.18, a sheet of one layer 0.4. */
static const float AIR_BOUNDS[4] = {0.2F, 0.4F, 0.75F, 0.83F};

static const DerivedFormula scalar_recipes[SCALAR_COUNT] = {
    /* used if the state has births by id, not per particle */
    [SCALAR_BORN] = {"born_of(i)", 0, NOTHING, false, .births = true},
    [SCALAR_AGE] = {"age_since(carried)", 0, SCALAR_BORN, false},
    [SCALAR_VELOCITY_X] = {"velocity.x", PARTICLE_VELOCITY, NOTHING, false},
    [SCALAR_VELOCITY_Y] = {"velocity.y", PARTICLE_VELOCITY, NOTHING, false},
    [SCALAR_VELOCITY_Z] = {"velocity.z", PARTICLE_VELOCITY, NOTHING, false},
    [SCALAR_ACCELERATION] = {"length(three)", 0, NOTHING, false, SCALAR_ACCELERATION_X},
    /* per volume: comparable between particle sizes, and a field for slices */
    [SCALAR_KINETIC_ENERGY] = {"0.5 * carried * dot(velocity, velocity)", PARTICLE_VELOCITY, SCALAR_DENSITY,
                               false},
    [SCALAR_VORTICITY] = {"two_dimensions != 0u ? curl(gradient).z : length(curl(gradient))",
                          PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_VORTICITY_X] = {"curl(gradient).x", PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_VORTICITY_Y] = {"curl(gradient).y", PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_VORTICITY_Z] = {"curl(gradient).z", PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_DIVERGENCE] = {"gradient[0].x + gradient[1].y + gradient[2].z", PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_STRAIN_RATE] = {"strain_rate(gradient)", PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_EDDY_VISCOSITY] = {"eddy_viscosity(gradient, i)", PARTICLE_VELOCITY, NOTHING, true},
    [SCALAR_TRAPPED_AIR] = {"trapped", PARTICLE_VELOCITY, NOTHING, true, .meets = true},
    [SCALAR_PRESSURE_GRADIENT] = {"length(slope)", 0, SCALAR_PRESSURE, true},
    [SCALAR_PRESSURE_GRADIENT_X] = {"slope.x", 0, SCALAR_PRESSURE, true},
    [SCALAR_PRESSURE_GRADIENT_Y] = {"slope.y", 0, SCALAR_PRESSURE, true},
    [SCALAR_PRESSURE_GRADIENT_Z] = {"slope.z", 0, SCALAR_PRESSURE, true},
    [SCALAR_NEIGHBOURS] = {"near", 0, NOTHING, true},
};

static const DerivedFormula vector_recipes[VECTOR_COUNT] = {
    [VECTOR_VORTICITY] = {"vec4(curl(gradient), 0.0)", PARTICLE_VELOCITY, NOTHING, true},
    [VECTOR_PRESSURE_GRADIENT] = {"vec4(slope, 0.0)", 0, SCALAR_PRESSURE, true},
    [VECTOR_BOX_VELOCITY] = {"vec4(frame_velocity + cross(frame_turn, place), 0.0)", 0, NOTHING, false},
    [VECTOR_FRICTION_BEFORE] = {"vec4(three, 0.0)", 0, NOTHING, false, SCALAR_FRICTION_BEFORE_X},
    [VECTOR_ACCELERATION] = {"vec4(three, 0.0)", 0, NOTHING, false, SCALAR_ACCELERATION_X},
};

/* Of derived_foam: two numbers per particle. */
static const DerivedFormula foam_recipe = {"foam_inputs(turbulence_of(sums, gradient), filled)",
                                           PARTICLE_VELOCITY, NOTHING, .near_too = true};

/* ---- inputs ---- */

static unsigned reads(const DerivedFormula *recipe)
{
    const unsigned threes = recipe->threes ? 7U * PARTICLE_SCALAR(recipe->threes) : 0;
    return recipe->attributes | threes | (recipe->births ? PARTICLE_ID : 0) |
           (recipe->carries == NOTHING ? 0 : PARTICLE_SCALAR(recipe->carries));
}

unsigned particle_wants_attributes(const ParticleWants *wants)
{
    unsigned attributes = wants->attributes;
    for (int s = 0; s < SCALAR_COUNT; s++)
        if (wants->scalars & SCALAR_BIT(s))
            attributes |= s == SCALAR_FLUID        ? PARTICLE_FLUID
                          : s < SCALAR_STATE_COUNT ? PARTICLE_SCALAR(s)
                                                   : reads(&scalar_recipes[s]);
    for (int v = 0; v < VECTOR_COUNT; v++)
        if (wants->vectors & VECTOR_BIT(v))
            attributes |= v == VECTOR_VELOCITY ? PARTICLE_VELOCITY : reads(&vector_recipes[v]);
    return attributes & PARTICLE_SCALAR(SCALAR_BORN) ? attributes | PARTICLE_ID : attributes;
}

/* SCALAR_BIT; includes the births if any recipe reads the births. */
static uint64_t wanted_scalars(const ParticleWants *wants)
{
    return wants->scalars | (particle_wants_attributes(wants) & PARTICLE_SCALAR(SCALAR_BORN));
}

static bool has(const DerivedFormula *recipe, const ParticleBuffers *particles)
{
    for (int k = 0; recipe->threes && k < 3; k++)
        if (!particles->scalar[recipe->threes + k].buffer)
            return false;
    if (recipe->births && !(particles->births && particles->id.buffer))
        return false;
    return (!(recipe->attributes & PARTICLE_VELOCITY) || particles->velocity.buffer) &&
           (recipe->carries == NOTHING || particles->scalar[recipe->carries].buffer);
}

/* ---- programs ---- */

static bool compile(unsigned *program, const char *file, const char *name, const char *defines, Error *error)
{
    char label[64];
    if (*program)
        return true;
    snprintf(label, sizeof label, "derived %s", name);
    *program = program_create(label, (const char *const[]){file, NULL}, defines, error);
    return *program != 0;
}

static const char *reads_defines(const DerivedFormula *recipe)
{
    const bool moves = recipe->attributes & PARTICLE_VELOCITY, carries = recipe->carries != NOTHING;
    return moves && carries ? "#define VELOCITIES 1\n#define CARRIED 1\n"
           : moves          ? "#define VELOCITIES 1\n"
           : carries        ? "#define CARRIED 1\n"
           : recipe->threes ? "#define THREES 1\n"
           : recipe->births ? "#define BIRTHS 1\n"
                            : "";
}

/* The packed neighbour data for a recipe: velocities or a scalar, never both. NULL: positions only. */
static DerivedPack *pack_of(Derived *derived, const DerivedFormula *recipe)
{
    const bool moves = recipe->attributes & PARTICLE_VELOCITY;
    return recipe->near_too && reads(recipe) ? &derived->pack[moves ? 0 : 1] : NULL;
}

static bool follow_neighbourhood(Derived *derived, Error *error)
{
    derived->sorts = derived->sorts || neighbourhood_create(&derived->neighbourhood, error);
    if (!derived->sorts)
        neighbourhood_destroy(&derived->neighbourhood);
    return derived->sorts;
}

static bool follow_near(Derived *derived, const DerivedFormula *recipe, Error *error)
{
    DerivedPack *pack = pack_of(derived, recipe);
    return (!recipe->near_too || follow_neighbourhood(derived, error)) &&
           (!pack ||
            compile(&pack->program, "derived/derived_pack.comp", "pack", reads_defines(recipe), error));
}

static bool follow(Derived *derived, unsigned *program, const DerivedFormula *recipe, const char *name,
                   const char *type, Error *error)
{
    char defines[256];
    if (!recipe->value)
        return true;
    snprintf(defines, sizeof defines, "#define VALUE_TYPE %s\n#define VALUE %s\n%s%s", type, recipe->value,
             recipe == &foam_recipe ? "#define NEAR 1\n#define FOAM 1\n"
             : recipe->meets        ? "#define NEAR 1\n#define MEETS 1\n"
             : recipe->near_too     ? "#define NEAR 1\n"
                                    : "",
             reads_defines(recipe));
    return follow_near(derived, recipe, error) &&
           compile(program, "derived/derived.comp", name, defines, error);
}

bool derived_update(Derived *derived, const ParticleWants *wants, Error *error)
{
    for (int s = 0; s < SCALAR_COUNT; s++)
        if ((wanted_scalars(wants) & SCALAR_BIT(s)) &&
            !follow(derived, &derived->scalar_program[s], &scalar_recipes[s], scalar_list[s].name, "float",
                    error))
            return false;
    for (int v = 0; v < VECTOR_COUNT; v++)
        if ((wants->vectors & VECTOR_BIT(v)) &&
            !follow(derived, &derived->vector_program[v], &vector_recipes[v], vector_list[v].name, "vec4",
                    error))
            return false;
    if (wants->foam && !follow(derived, &derived->foam_program, &foam_recipe, "foam", "vec2", error))
        return false;
    return !wants->neighbours || follow_neighbourhood(derived, error);
}

void derived_destroy(Derived *derived)
{
    for (int s = 0; s < SCALAR_COUNT; s++)
        glDeleteProgram(derived->scalar_program[s]);
    for (int v = 0; v < VECTOR_COUNT; v++)
        glDeleteProgram(derived->vector_program[v]);
    glDeleteProgram(derived->foam_program);
    for (int p = 0; p < 2; p++) {
        glDeleteProgram(derived->pack[p].program);
        glDeleteTextures(1, &derived->pack[p].texels);
        glDeleteBuffers(1, &derived->pack[p].buffer);
    }
    glDeleteBuffers(SCALAR_COUNT, derived->scalar_buffer);
    glDeleteBuffers(VECTOR_COUNT, derived->vector_buffer);
    glDeleteBuffers(1, &derived->births);
    glDeleteBuffers(1, &derived->foam_buffer);
    neighbourhood_destroy(&derived->neighbourhood);
    *derived = (Derived){0};
}

/* ---- memory ---- */

static void give_back(unsigned *buffer, size_t *capacity)
{
    glDeleteBuffers(1, buffer);
    *buffer = 0;
    *capacity = 0;
}

static bool needs_near(const ParticleWants *wants, const DerivedPack *pack, Derived *derived)
{
    for (int s = 0; s < SCALAR_COUNT; s++)
        if ((wants->scalars & SCALAR_BIT(s)) && scalar_recipes[s].near_too &&
            (!pack || pack_of(derived, &scalar_recipes[s]) == pack))
            return true;
    for (int v = 0; v < VECTOR_COUNT; v++)
        if ((wants->vectors & VECTOR_BIT(v)) && vector_recipes[v].near_too &&
            (!pack || pack_of(derived, &vector_recipes[v]) == pack))
            return true;
    return wants->foam && (!pack || pack_of(derived, &foam_recipe) == pack);
}

void derived_release(Derived *derived, const ParticleWants *wants)
{
    for (int s = 0; s < SCALAR_COUNT; s++)
        if (!(wanted_scalars(wants) & SCALAR_BIT(s)))
            give_back(&derived->scalar_buffer[s], &derived->scalar_capacity[s]);
    if (!wants->foam)
        give_back(&derived->foam_buffer, &derived->foam_capacity);
    for (int v = 0; v < VECTOR_COUNT; v++)
        if (!(wants->vectors & VECTOR_BIT(v)))
            give_back(&derived->vector_buffer[v], &derived->vector_capacity[v]);
    for (int p = 0; p < 2; p++)
        if (!needs_near(wants, &derived->pack[p], derived)) {
            glDeleteTextures(1, &derived->pack[p].texels);
            derived->pack[p].texels = 0;
            give_back(&derived->pack[p].buffer, &derived->pack[p].capacity);
        }
    if (derived->sorts && !wants->neighbours && !needs_near(wants, NULL, derived)) {
        neighbourhood_destroy(&derived->neighbourhood);
        derived->sorts = false;
    }
    derived->lacks = NULL;
}

size_t derived_bytes(const Derived *derived)
{
    size_t bytes = 8 * derived->foam_capacity;
    for (int s = 0; s < SCALAR_COUNT; s++)
        bytes += 4 * derived->scalar_capacity[s];
    for (int v = 0; v < VECTOR_COUNT; v++)
        bytes += 16 * derived->vector_capacity[v];
    for (int p = 0; p < 2; p++)
        bytes += 16 * derived->pack[p].capacity;
    return bytes;
}

/* ---- the pass ---- */

/* |W'(r)| / r = moment_scale (1 - r/h)^3 for Wendland's C2 kernel n (1 - q)^4 (1 + 4 q) / h^d. */
static float moment_scale(double h, bool flat)
{
    static const double pi = 3.14159265358979323846;
    return (float)(flat ? 20 * 7 / pi / pow(h, 4) : 20 * 21 / (2 * pi) / pow(h, 5));
}

static void set_frame(unsigned program, const BoxState *box)
{
    double velocity[3], turn[3];
    quat_rotate_inverse(box->orientation, box->velocity, velocity);
    quat_rotate_inverse(box->orientation, box->angular_velocity, turn);
    glProgramUniform3f(program, FRAME_VELOCITY_AT, (float)velocity[0], (float)velocity[1],
                       (float)velocity[2]);
    glProgramUniform3f(program, FRAME_TURN_AT, (float)turn[0], (float)turn[1], (float)turn[2]);
}

static void set_space(unsigned program, const DerivedSpace *space, const ParticleBuffers *particles)
{
    float period[3];
    for (int k = 0; k < 3; k++)
        period[k] = space->periodic[k] ? (float)particles->box_size[k] : 0;
    glProgramUniform1f(program, KERNEL_REACH_AT, (float)particles->support_radius);
    glProgramUniform1f(program, MOMENT_SCALE_AT, moment_scale(particles->support_radius, space->flat));
    glProgramUniform1ui(program, TWO_DIMENSIONS_AT, space->flat);
    glProgramUniform3f(program, PERIOD_AT, period[0], period[1], period[2]);
    glProgramUniform1f(program, NOW_AT, (float)particles->time);
    set_frame(program, &particles->box);
}

static void bind(unsigned program, const DerivedFormula *recipe, const ParticleBuffers *particles,
                 unsigned to)
{
    const ParticleAttribute *velocity = &particles->velocity;
    particle_bind(program, particles, recipe->carries == NOTHING ? SCALAR_SPEED : (Scalar)recipe->carries);
    if (recipe->attributes & PARTICLE_VELOCITY) {
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, VELOCITIES_STORAGE, velocity->buffer,
                          (GLintptr)velocity->offset, (GLsizeiptr)(particles->count * velocity->stride));
        glProgramUniform1ui(program, VELOCITY_STRIDE_AT, (GLuint)(velocity->stride / 4));
    }
    for (int k = 0; recipe->threes && k < 3; k++)
        particle_bind_one((unsigned)(THREES_STORAGE + k), &particles->scalar[recipe->threes + k],
                          particles->count, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, DERIVED_STORAGE, to);
}

static void run(const Derived *derived, unsigned program, const DerivedFormula *recipe, size_t count)
{
    if (recipe->near_too) {
        neighbourhood_run(&derived->neighbourhood, program);
        return;
    }
    glUseProgram(program);
    glUniform1ui(GRID_PARTICLES_AT, (GLuint)count);
    work_run(count);
}

/* Returns false if the GPU has no memory: then there is no buffer, and `lacks` is set to the label. */
static bool reserve(Derived *derived, unsigned *buffer, size_t *capacity, size_t count, size_t stride,
                    const char *label)
{
    if (count <= *capacity)
        return true;
    *capacity = work_capacity(*capacity, count);
    if (work_buffer_try(buffer, *capacity * stride, label))
        return true;
    *capacity = 0;
    derived->lacks = label;
    return false;
}

/* State of a fill. */
typedef struct DerivedJob {
    Derived *derived;
    const DerivedSpace *space;
    const ParticleBuffers *particles;
    unsigned packed[2]; /* content of each pack, PARTICLE_*; 0: empty */
    bool sorted;        /* the grid is of `particles` */
} DerivedJob;

static bool reserve_pack(Derived *derived, DerivedPack *pack, size_t count)
{
    if (count <= pack->capacity)
        return true;
    if (!reserve(derived, &pack->buffer, &pack->capacity, count, 16, "neighbours of particles"))
        return false;
    glDeleteTextures(1, &pack->texels);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &pack->texels);
    glTextureBuffer(pack->texels, GL_RGBA32F, pack->buffer);
    return true;
}

/* Sorts the particles if needed and packs the neighbour data, once for all recipes with the same inputs. */
static bool prepare_near(DerivedJob *making, const DerivedFormula *recipe)
{
    Derived *derived = making->derived;
    DerivedPack *pack = pack_of(derived, recipe);
    unsigned *packed = pack ? &making->packed[pack - derived->pack] : NULL;
    if (!making->sorted)
        neighbourhood_forget(&derived->neighbourhood);
    neighbourhood_build(&derived->neighbourhood, making->particles);
    making->sorted = true;
    if (!pack)
        return true;
    if (*packed != reads(recipe)) {
        if (!reserve_pack(derived, pack, making->particles->count))
            return false;
        bind(pack->program, recipe, making->particles, pack->buffer);
        neighbourhood_run(&derived->neighbourhood, pack->program);
        *packed = reads(recipe);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindTextureUnit(OTHERS_UNIT, pack->texels);
    return true;
}

/* The birth table goes to the GPU for each picture that reads births: emissions are few compared with
   particles. */
static void bind_births(Derived *derived, unsigned program, const ParticleBuffers *particles)
{
    const Births *births = particles->births;
    const Birth none = {0};
    if (!derived->births) {
        glCreateBuffers(1, &derived->births);
        glObjectLabel(GL_BUFFER, derived->births, -1, "births");
    }
    glNamedBufferData(derived->births, (GLsizeiptr)((births->count ? births->count : 1) * sizeof none),
                      births->count ? births->of : &none, GL_STREAM_DRAW);
    particle_bind_one(IDS_STORAGE, &particles->id, particles->count, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIRTHS_STORAGE, derived->births);
    glProgramUniform1ui(program, BIRTHS_COUNT_AT, (GLuint)births->count);
}

static ParticleAttribute make(DerivedJob *making, const DerivedFormula *recipe, unsigned program,
                              unsigned buffer, size_t stride)
{
    if (recipe->near_too && !prepare_near(making, recipe))
        return (ParticleAttribute){0};
    set_space(program, making->space, making->particles);
    bind(program, recipe, making->particles, buffer);
    if (recipe->births)
        bind_births(making->derived, program, making->particles);
    run(making->derived, program, recipe, making->particles->count);
    return (ParticleAttribute){buffer, 0, stride};
}

static bool due(bool wanted, unsigned program, const DerivedFormula *recipe, const ParticleBuffers *particles)
{
    return wanted && program && particles->count > 0 && has(recipe, particles);
}

static void set_walls(unsigned program, const DerivedJob *making)
{
    float low[3], high[3];
    for (int k = 0; k < 3; k++) {
        const bool walled = !making->space->periodic[k] && !(making->space->flat && k == 2);
        const double size = making->particles->box_size[k];
        low[k] = walled ? (float)(k == 1 ? 0 : -size / 2) : -1e9F;
        high[k] = walled ? (float)(k == 1 ? size : size / 2) : 1e9F;
    }
    glProgramUniform3f(program, WALLED_LOW_AT, low[0], low[1], low[2]);
    glProgramUniform3f(program, WALLED_HIGH_AT, high[0], high[1], high[2]);
}

/* Returns buffer 0 if there is no memory. */
static ParticleAttribute make_scalar(DerivedJob *making, Scalar scalar)
{
    Derived *derived = making->derived;
    const DerivedFormula *recipe = &scalar_recipes[scalar];
    const unsigned program = derived->scalar_program[scalar];
    unsigned *buffer = &derived->scalar_buffer[scalar];
    if (!reserve(derived, buffer, &derived->scalar_capacity[scalar], making->particles->count, 4,
                 scalar_list[scalar].name))
        return (ParticleAttribute){0};
    return make(making, recipe, program, *buffer, 4);
}

ParticleAttribute derived_foam(Derived *derived, const DerivedSpace *space, const ParticleBuffers *particles,
                               double slowest, unsigned old_foam)
{
    DerivedJob making = {derived, space, particles, {0}, true}; /* of the picture's state */
    const unsigned program = derived->foam_program;
    if (!due(true, program, &foam_recipe, particles) ||
        !reserve(derived, &derived->foam_buffer, &derived->foam_capacity, particles->count, 8, "foam"))
        return (ParticleAttribute){0};
    set_walls(program, &making);
    glProgramUniform1f(program, SLOWEST_AT, (float)slowest);
    glProgramUniform4f(program, AIR_BOUNDS_AT, AIR_BOUNDS[0], AIR_BOUNDS[1], AIR_BOUNDS[2], AIR_BOUNDS[3]);
    glProgramUniform1ui(program, FOAM_KNOWN_AT, old_foam != 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OLD_FOAM_STORAGE,
                     old_foam ? old_foam : particles->position.buffer);
    return make(&making, &foam_recipe, program, derived->foam_buffer, 8);
}

void derived_fill(Derived *derived, const ParticleWants *wants, const DerivedSpace *space,
                  ParticleBuffers *particles)
{
    DerivedJob making = {derived, space, particles, {0}, false};
    const size_t count = particles->count;
    for (int s = 0; s < SCALAR_COUNT; s++) {
        const unsigned program = derived->scalar_program[s];
        if (particles->scalar[s].buffer ||
            !due(wanted_scalars(wants) & SCALAR_BIT(s), program, &scalar_recipes[s], particles))
            continue;
        particles->scalar[s] = make_scalar(&making, (Scalar)s);
    }
    if (wants->vectors & VECTOR_BIT(VECTOR_VELOCITY))
        particles->vector[VECTOR_VELOCITY] = particles->velocity;
    for (int v = 0; v < VECTOR_COUNT; v++) {
        const unsigned program = derived->vector_program[v];
        if (particles->vector[v].buffer ||
            !due(wants->vectors & VECTOR_BIT(v), program, &vector_recipes[v], particles))
            continue;
        if (!reserve(derived, &derived->vector_buffer[v], &derived->vector_capacity[v], count, 16,
                     vector_list[v].name))
            continue;
        particles->vector[v] = make(&making, &vector_recipes[v], program, derived->vector_buffer[v], 16);
    }
}
